#include "extract/pose/tflite/read.h"

#include <algorithm>
#include <cstdint>
#include <optional>

#include "extract/pose/tflite/flatbuffer.h"
#include "extract/pose/tflite/operators.h"
#include "extract/pose/tflite/tensors.h"

namespace stride::tflite {
namespace {

/// The number of each operator in the schema's BuiltinOperator.
std::vector<int> operator_codes(const FlatTable& model) {
  std::vector<int> codes;
  const FlatVector tables = model.vector(1, 4);
  for (std::size_t i = 0; i < tables.size(); ++i)
    codes.push_back(std::max<int>(tables.table(i).scalar<std::int8_t>(0, 0),
                                  tables.table(i).scalar<std::int32_t>(3, 0)));
  return codes;
}

/// Every input is the network's, a constant, or was computed before.
void check_order(const Graph& graph) {
  std::vector<bool> known(graph.shapes.size());
  known[static_cast<std::size_t>(graph.input)] = true;
  for (const Node& node : graph.nodes) {
    for (const int input : node.inputs)
      require(known[static_cast<std::size_t>(input)], "{} is used before it is computed",
              graph.names[static_cast<std::size_t>(input)]);
    require(!known[static_cast<std::size_t>(node.output)], "{} is computed twice", node.name);
    known[static_cast<std::size_t>(node.output)] = true;
  }
  for (const int output : graph.outputs)
    require(known[static_cast<std::size_t>(output)] && output != graph.input,
            "the output {} is not computed", graph.names[static_cast<std::size_t>(output)]);
}

}  // namespace

Graph read_tflite(std::string_view content) {
  const FlatTable model = root_table(content, "TFL3");
  const FlatVector subgraphs = model.vector(2, 4);
  require(subgraphs.size() == 1, "has {} graphs: must have one", subgraphs.size());
  const FlatTable subgraph = subgraphs.table(0);
  const std::vector<int> codes = operator_codes(model);
  TfliteTensors tensors(model, subgraph);

  Graph graph;
  const FlatVector operators = subgraph.vector(3, 4);
  for (std::size_t i = 0; i < operators.size(); ++i) {
    const FlatTable table = operators.table(i);
    const auto code = table.scalar<std::uint32_t>(0, 0);
    require(code < codes.size(), "damaged: operator {} of {}", code, codes.size());
    if (std::optional<Node> node = node_of(codes[code], table, tensors))
      graph.nodes.push_back(std::move(*node));
  }
  graph.shapes = tensors.shapes();
  graph.names = tensors.names();
  const std::vector<int> inputs = subgraph.vector(1, 4).scalars<int>();
  require(inputs.size() == 1, "has {} inputs: must have one", inputs.size());
  graph.input = inputs.front();
  graph.outputs = subgraph.vector(2, 4).scalars<int>();
  require(tensors.shape(graph.input).size() == 4, "the input {} must have four sizes",
          tensors.name(graph.input));
  for (const int output : graph.outputs) tensors.shape(output);  // is there
  check_order(graph);
  return graph;
}

}  // namespace stride::tflite
