#pragma once

#include <string>
#include <vector>

#include "extract/pose/tflite/flatbuffer.h"
#include "extract/pose/tflite/graph.h"

namespace stride::tflite {

/// A tensor whose zeros were left out, with them: `sparsity` is TensorFlow Lite's
/// SparsityParameters without blocks, each dimension dense or compressed rows (CSR). `name` is the
/// tensor's, for messages. Throws Error where indices leave the shape or the values.
std::vector<float> densified(const FlatTable& sparsity, const Shape& shape,
                             const std::vector<float>& values, const std::string& name);

}  // namespace stride::tflite
