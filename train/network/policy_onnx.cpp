#include "train/network/policy_onnx.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "extract/pose/onnx_writer.h"

namespace stride::network {
namespace {

const char* operation_of(Activation activation) {
  switch (activation) {
    case Activation::linear:
      return "Identity";
    case Activation::relu:
      return "Relu";
    case Activation::elu:
      return "Elu";
    case Activation::tanh:
      return "Tanh";
    case Activation::sigmoid:
      return "Sigmoid";
  }
  return "";
}

/// Builds an ONNX graph, a chain of operations on rows [1, n].
class Graph {
 public:
  OnnxModel model = {};

  /// Adds an operation on the named values; returns the name of its result.
  std::string add(const std::string& op, const std::vector<std::string>& inputs,
                  decltype(OnnxNode::attributes) attributes = {}) {
    std::string result = fmt::format("{}.{}", model.nodes.size(), op);
    model.nodes.push_back({op, inputs, {result}, std::move(attributes)});
    return result;
  }

  std::string affine(const std::string& x, const std::string& name, const Eigen::MatrixXd& weight,
                     const Eigen::VectorXd& bias) {
    const std::string w = constant(name + ".weight", {weight.rows(), weight.cols()}, weight);
    const std::string b = constant(name + ".bias", {bias.size()}, bias);
    return add("Gemm", {x, w, b}, {{"transB", std::int64_t{1}}});
  }

  /// `op` on x and a row of constants.
  std::string with_row(const std::string& op, const std::string& x, const std::string& name,
                       const Eigen::VectorXd& values) {
    return add(op, {x, constant(name, {1, values.size()}, values)});
  }

 private:
  std::string constant(const std::string& name, std::vector<std::int64_t> shape,
                       const Eigen::MatrixXd& values) {
    OnnxTensor tensor{name, std::move(shape), {}};
    for (const double value : values.transpose().reshaped())  // row by row
      tensor.values.push_back(static_cast<float>(value));
    model.constants.push_back(std::move(tensor));
    return name;
  }
};

/// The matrix M with M x the mirror image of x.
Eigen::MatrixXd matrix_of(const environment::Mirror& mirror) {
  const auto n = static_cast<Eigen::Index>(mirror.source.size());
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(n, n);
  for (Eigen::Index i = 0; i < n; ++i)
    matrix(i, mirror.source[static_cast<std::size_t>(i)]) =
        mirror.sign[static_cast<std::size_t>(i)];
  return matrix;
}

/// x, or its mirror image where the left leg is ahead in `features`: (1 − m) x + m (mirrored x)
/// with m = 0 or 1, a row, since OpenCV 4.6 multiplies no row by a number. m is the difference of
/// the hips, so large that clipping it to [0, 1] leaves nothing between.
std::string mirrored_if_left_is_ahead(Graph& graph, const environment::RightLegAhead& symmetry,
                                      const environment::Mirror& mirror, const std::string& name,
                                      const std::string& x, const std::string& features) {
  constexpr double kLarge = 1e30;
  const auto n = static_cast<Eigen::Index>(mirror.source.size());
  const auto inputs = static_cast<Eigen::Index>(symmetry.features.source.size());
  Eigen::MatrixXd left_less_right = Eigen::MatrixXd::Zero(n, inputs);
  left_less_right.col(symmetry.hip_l).setConstant(kLarge);
  left_less_right.col(symmetry.hip_r).setConstant(-kLarge);
  const std::string difference =
      graph.affine(features, name + ".left_ahead", left_less_right, Eigen::VectorXd::Zero(n));
  const std::string m = graph.add("Clip", {difference}, {{"min", 0.0f}, {"max", 1.0f}});
  const std::string not_m = graph.with_row(
      "Add", graph.with_row("Mul", m, name + ".minus_one", Eigen::VectorXd::Constant(n, -1)),
      name + ".one", Eigen::VectorXd::Ones(n));
  const std::string image =
      graph.affine(x, name + ".mirror", matrix_of(mirror), Eigen::VectorXd::Zero(n));
  return graph.add("Add", {graph.add("Mul", {not_m, x}), graph.add("Mul", {m, image})});
}

/// Parameters of layer i by their name in the policy's file.
template <typename Scalar>
Eigen::MatrixXd parameters(const Mlp<Scalar>& mlp, std::size_t i, const std::string& name) {
  for (const auto& block : mlp.blocks())
    if (block.name == fmt::format("{}.{}", i, name))
      return mlp.parameters()
          .segment(block.offset, block.rows * block.columns)
          .reshaped(block.rows, block.columns)
          .template cast<double>();
  return {};
}

/// An affine map and its layer normalisation. OpenCV 4.6 supports neither means of rows nor
/// division by a scalar. So the mean over the neurons is subtracted from the parameters of the map,
/// which is equivalent, and the variance is the product of the squares with a matrix of 1/n.
template <typename Scalar>
std::string normalised_layer(Graph& graph, const Mlp<Scalar>& mlp, std::size_t i, std::string x) {
  Eigen::MatrixXd weight = parameters(mlp, i, "weight");
  Eigen::VectorXd bias = parameters(mlp, i, "bias");
  const Eigen::Index n = bias.size();
  weight.rowwise() -= weight.colwise().mean().eval();
  bias.array() -= bias.mean();
  const std::string layer = std::to_string(i);
  x = graph.affine(x, layer, weight, bias);
  const std::string variance =
      graph.affine(graph.add("Mul", {x, x}), layer + ".variance",
                   Eigen::MatrixXd::Constant(n, n, 1.0 / static_cast<double>(n)),
                   Eigen::VectorXd::Constant(n, kVarianceFloor));
  x = graph.add("Div", {x, graph.add("Sqrt", {variance})});
  x = graph.with_row("Mul", x, layer + ".norm.scale", parameters(mlp, i, "norm.scale"));
  return graph.with_row("Add", x, layer + ".norm.shift", parameters(mlp, i, "norm.shift"));
}

}  // namespace

template <typename Scalar>
std::string to_onnx(const Policy<Scalar>& policy, const PolicyNames& names) {
  const MlpShape& shape = policy.actor.shape();
  Graph graph;
  const auto limit = static_cast<float>(Normaliser::kLimit);
  std::string x = "features";
  if (policy.symmetry)
    x = mirrored_if_left_is_ahead(graph, *policy.symmetry, policy.symmetry->features, "seen", x,
                                  "features");
  x = graph.with_row("Sub", x, "mean", policy.normaliser.mean());
  x = graph.with_row("Mul", x, "inverse_sd", policy.normaliser.inverse_sd());
  x = graph.add("Clip", {x}, {{"min", -limit}, {"max", limit}});
  const std::size_t last = shape.hidden.size();
  for (std::size_t i = 0; i <= last; ++i) {
    if (shape.layer_norm && i < last)
      x = normalised_layer(graph, policy.actor, i, x);
    else
      x = graph.affine(x, std::to_string(i), parameters(policy.actor, i, "weight"),
                       parameters(policy.actor, i, "bias"));
    x = graph.add(operation_of(i == last ? shape.output : shape.activation), {x});
  }
  if (policy.symmetry)
    x = mirrored_if_left_is_ahead(graph, *policy.symmetry, policy.symmetry->actions, "done", x,
                                  "features");

  OnnxModel& model = graph.model;
  model.nodes.back().outputs = {"actions"};
  model.name = "policy";
  model.inputs = {{"features", {1, shape.inputs}}};
  model.outputs = {{"actions", {1, shape.outputs}}};
  model.metadata = {{"features", fmt::format("{}", fmt::join(names.features, ","))},
                    {"actions", fmt::format("{}", fmt::join(names.actions, ","))},
                    {"action_repeat", fmt::format("{}", names.action_repeat)}};
  model.description =
      "A policy of stride: features as observed, in SI units, in the order that the metadata "
      "names; actions are excitations of muscles";
  return to_onnx(model);
}

template std::string to_onnx(const Policy<float>&, const PolicyNames&);
template std::string to_onnx(const Policy<double>&, const PolicyNames&);

}  // namespace stride::network
