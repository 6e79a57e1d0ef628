#include "extract/pose/tflite/sparse.h"

#include <algorithm>
#include <cstdint>

namespace stride::tflite {
namespace {

/// The numbers of a union SparseIndexVector: 32, 16 or 8 bits, of the given type tag.
std::vector<int> index_vector(const FlatTable& dimension, int tag_field, int field) {
  const auto tag = dimension.scalar<std::uint8_t>(tag_field, 0);
  const std::optional<FlatTable> table = dimension.table(field);
  require(table.has_value() && tag >= 1 && tag <= 3, "sparse indices of kind {}: must be 1 to 3",
          tag);
  std::vector<int> indices;
  const FlatVector vector = table->vector(0, tag == 1 ? 4 : tag == 2 ? 2 : 1);
  for (std::size_t i = 0; i < vector.size(); ++i)
    indices.push_back(tag == 1   ? vector.scalar<std::int32_t>(i)
                      : tag == 2 ? vector.scalar<std::uint16_t>(i)
                                 : vector.scalar<std::uint8_t>(i));
  return indices;
}

/// One dimension in the order in which the values are stored.
struct Level {
  bool dense = true;
  int size = 0;                        // in the shape
  std::size_t step = 1;                // of the unpacked tensor
  std::vector<int> segments, indices;  // CSR
};

struct Unpacking {
  const std::vector<Level>& levels;
  const std::vector<float>& values;
  const std::string& name;
  std::vector<float>& result;

  /// Unpacks what lies under `position` of a level, into the place `offset`.
  void unpack(std::size_t depth, std::size_t position, std::size_t offset) {
    if (depth == levels.size()) {
      require(position < values.size(), "sparse tensor {}: value {} of {}", name, position,
              values.size());
      result[offset] = values[position];
      return;
    }
    const Level& level = levels[depth];
    if (level.dense) {
      const auto size = static_cast<std::size_t>(level.size);
      for (std::size_t i = 0; i < size; ++i)
        unpack(depth + 1, position * size + i, offset + i * level.step);
      return;
    }
    require(position + 1 < level.segments.size(), "sparse tensor {}: row {} of {}", name, position,
            level.segments.size());
    for (int k = level.segments[position]; k < level.segments[position + 1]; ++k) {
      const int i = level.indices[static_cast<std::size_t>(k)];
      require(i >= 0 && i < level.size, "sparse tensor {}: index {} of a size of {}", name, i,
              level.size);
      unpack(depth + 1, static_cast<std::size_t>(k),
             offset + static_cast<std::size_t>(i) * level.step);
    }
  }
};

}  // namespace

std::vector<float> densified(const FlatTable& sparsity, const Shape& shape,
                             const std::vector<float>& values, const std::string& name) {
  const std::vector<int> order = sparsity.vector(0, 4).scalars<int>();
  const FlatVector dimensions = sparsity.vector(2, 4);
  require(sparsity.vector(1, 4).empty(), "sparse tensor {}: blocks are not supported", name);
  require(order.size() == shape.size() && dimensions.size() == shape.size(),
          "sparse tensor {}: {} dimensions are described, it has {}", name, dimensions.size(),
          shape.size());
  std::vector<Level> levels;
  std::vector<bool> seen(shape.size());
  for (std::size_t k = 0; k < order.size(); ++k) {
    const auto axis = static_cast<std::size_t>(order[k]);
    require(axis < shape.size() && !seen[axis], "sparse tensor {}: dimension {} twice, or beyond",
            name, order[k]);
    seen[axis] = true;
    const FlatTable dimension = dimensions.table(k);
    Level level;
    level.size = shape[axis];
    for (std::size_t a = axis + 1; a < shape.size(); ++a)
      level.step *= static_cast<std::size_t>(shape[a]);
    level.dense = dimension.scalar<std::int8_t>(0, 0) == 0;
    if (level.dense) {
      require(dimension.scalar<std::int32_t>(1, 0) == level.size,
              "sparse tensor {}: dimension {} is not {}", name, axis, level.size);
    } else {
      level.segments = index_vector(dimension, 2, 3);
      level.indices = index_vector(dimension, 4, 5);
      require(std::ranges::is_sorted(level.segments) && level.segments.size() > 1 &&
                  level.segments.front() == 0 &&
                  static_cast<std::size_t>(level.segments.back()) == level.indices.size(),
              "sparse tensor {}: the rows of dimension {} do not follow one another", name, axis);
    }
    levels.push_back(std::move(level));
  }
  std::vector<float> result(elements(shape));
  Unpacking{levels, values, name, result}.unpack(0, 0, 0);
  return result;
}

}  // namespace stride::tflite
