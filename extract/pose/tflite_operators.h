#pragma once

#include <optional>

#include "extract/pose/flatbuffer.h"
#include "extract/pose/tflite.h"
#include "extract/pose/tflite_tensors.h"

namespace stride::pose {

/// One operator of a TensorFlow Lite graph: `code` is its number in the schema's BuiltinOperator,
/// `table` its Operator. Nothing for those that only unpack a constant, which `tensors` then knows
/// under its new name. Throws Error naming the operator and what is wrong with it.
std::optional<Node> node_of(int code, const FlatTable& table, TfliteTensors& tensors);

}  // namespace stride::pose
