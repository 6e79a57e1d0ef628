#include "extract/pose/tflite/tensors.h"

#include <fmt/ranges.h>

#include <Eigen/Core>
#include <cstdint>

#include "extract/pose/tflite/sparse.h"

namespace stride::tflite {
namespace {

constexpr std::size_t kMostElements = std::size_t{1} << 26;  // of a tensor, and of all constants
constexpr int kMostSize = 1 << 20;
enum TensorType : std::int8_t { kFloat32 = 0, kFloat16 = 1, kInt32 = 2 };  // of the schema

std::vector<float> floats_of(std::string_view bytes, std::int8_t type, const std::string& name) {
  require(type == kFloat32 || type == kFloat16,
          "tensor {} has numbers of type {}: must be floats of 32 or 16 bits", name, type);
  const std::size_t width = type == kFloat32 ? 4 : 2;
  std::vector<float> values(bytes.size() / width);
  for (std::size_t i = 0; i < values.size(); ++i)
    values[i] = type == kFloat32 ? read_scalar<float>(bytes, 4 * i)
                                 : static_cast<float>(Eigen::numext::bit_cast<Eigen::half>(
                                       read_scalar<std::uint16_t>(bytes, 2 * i)));
  return values;
}

}  // namespace

TfliteTensors::TfliteTensors(const FlatTable& model, const FlatTable& subgraph)
    : tensors_(subgraph.vector(0, 4)), buffers_(model.vector(4, 4)) {
  for (std::size_t i = 0; i < tensors_.size(); ++i) {
    const FlatTable tensor = tensors_.table(i);
    names_.emplace_back(tensor.string(3));
    const Shape shape = tensor.vector(0, 4).scalars<int>();
    bool fits = shape.size() <= 6;
    std::size_t product = 1;
    for (std::size_t k = 0; fits && k < shape.size(); ++k) {
      fits = shape[k] >= 1 && shape[k] <= kMostSize;
      if (fits) product *= static_cast<std::size_t>(shape[k]);
      fits = fits && product <= kMostElements;
    }
    require(fits, "tensor {} is {}: must have at most 6 sizes, each at least 1, and 2^26 elements",
            names_.back(), shape);
    shapes_.push_back(shape);
  }
}

void TfliteTensors::check(int tensor) const {
  require(tensor >= 0 && tensor < size(), "damaged: tensor {} of {}", tensor, size());
}

const Shape& TfliteTensors::shape(int tensor) const {
  check(tensor);
  return shapes_[static_cast<std::size_t>(tensor)];
}

const std::string& TfliteTensors::name(int tensor) const {
  check(tensor);
  return names_[static_cast<std::size_t>(tensor)];
}

std::string_view TfliteTensors::data(int tensor) const {
  check(tensor);
  const auto buffer = tensors_.table(static_cast<std::size_t>(tensor)).scalar<std::uint32_t>(2, 0);
  return buffers_.table(buffer).vector(0, 1).bytes();
}

bool TfliteTensors::is_constant(int tensor) const {
  return renamed_.contains(tensor) || !data(tensor).empty();
}

void TfliteTensors::rename_constant(int from, int to) {
  require(is_constant(from), "tensor {} is unpacked, but is no constant", name(from));
  require(shape(from) == shape(to), "tensor {} is {}, unpacked {}", name(from), shape(from),
          shape(to));
  const auto first = renamed_.find(from);
  renamed_[to] = first == renamed_.end() ? from : first->second;
}

const std::vector<float>& TfliteTensors::floats(int tensor) {
  const auto first = renamed_.find(tensor);
  const int source = first == renamed_.end() ? tensor : first->second;
  const auto known = floats_.find(source);
  return known != floats_.end() ? known->second
                                : floats_.emplace(source, read(source)).first->second;
}

std::vector<float> TfliteTensors::read(int tensor) {
  const FlatTable table = tensors_.table(static_cast<std::size_t>(tensor));
  const std::size_t expected = elements(shape(tensor));
  unpacked_ += expected;
  require(unpacked_ <= kMostElements, "has more than 2^26 weights");
  std::vector<float> values =
      floats_of(data(tensor), table.scalar<std::int8_t>(1, kFloat32), name(tensor));
  if (const auto sparsity = table.table(6))
    values = densified(*sparsity, shape(tensor), values, name(tensor));
  require(values.size() == expected, "tensor {} is {}, but has {} numbers", name(tensor),
          shape(tensor), values.size());
  return values;
}

std::vector<int> TfliteTensors::integers(int tensor) const {
  const std::string_view bytes = data(tensor);
  const auto type = tensors_.table(static_cast<std::size_t>(tensor)).scalar<std::int8_t>(1, 0);
  require(type == kInt32 && bytes.size() == 4 * elements(shape(tensor)),
          "tensor {} must be constant integers of 32 bits", name(tensor));
  std::vector<int> values(bytes.size() / 4);
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = read_scalar<int>(bytes, 4 * i);
  return values;
}

}  // namespace stride::tflite
