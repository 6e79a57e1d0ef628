#pragma once

#include <string>

#include "train/network/policy.h"

namespace stride::network {

/// A policy as an ONNX file (opset 9, float32; OpenCV 4.6 reads it): input `features` [1, features]
/// as observed, output `actions` [1, actions] in [0, 1]; the normaliser is part of the graph. The
/// file's metadata names features and actions, separated by commas, and the action_repeat.
/// Operations: of a symmetric policy Gemm, Clip, Mul, Add (the mirror image of features and actions
/// where the left leg is ahead); Sub, Mul, Clip (the normaliser); of each layer Gemm, its
/// normalisation (Mul, Gemm, Sqrt, Div, Mul, Add), and Identity, Relu, Elu, Tanh or Sigmoid.
template <typename Scalar>
std::string to_onnx(const Policy<Scalar>& policy, const PolicyNames& names);

}  // namespace stride::network
