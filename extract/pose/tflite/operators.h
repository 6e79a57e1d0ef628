#pragma once

#include <optional>

#include "extract/pose/tflite/flatbuffer.h"
#include "extract/pose/tflite/graph.h"
#include "extract/pose/tflite/tensors.h"

namespace stride::tflite {

/// One operator of a TensorFlow Lite graph: `code` is its number in the schema's BuiltinOperator,
/// `table` its Operator. Nothing for those that only unpack a constant, which `tensors` then knows
/// under its new name. Throws Error naming the operator and what is wrong with it.
std::optional<Node> node_of(int code, const FlatTable& table, TfliteTensors& tensors);

}  // namespace stride::tflite
