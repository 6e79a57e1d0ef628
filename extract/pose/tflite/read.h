#pragma once

#include <string_view>

#include "extract/pose/tflite/graph.h"

namespace stride::tflite {

/// Reads a TensorFlow Lite file with one input of floats and a batch of one. Weights of 16 bits and
/// sparse ones are unpacked. Throws Error that names the byte, the operator, the tensor or the
/// shape if the file is damaged or asks for anything that Graph cannot say.
Graph read_tflite(std::string_view content);

}  // namespace stride::tflite
