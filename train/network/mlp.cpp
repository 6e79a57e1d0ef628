#include "train/network/mlp.h"

#include <fmt/format.h>

#include <array>
#include <utility>

#include "extract/io/error.h"

namespace stride::network {
namespace {

constexpr std::array kActivations{
    std::pair{Activation::linear, "linear"}, std::pair{Activation::relu, "relu"},
    std::pair{Activation::elu, "elu"}, std::pair{Activation::tanh, "tanh"},
    std::pair{Activation::sigmoid, "sigmoid"}};

/// Eigen splits long products by the sizes of the caches that it finds, and so the order of their
/// sums. With these sizes everywhere, the same bytes come out everywhere.
constexpr int kL1 = 32 << 10, kL2 = 512 << 10, kL3 = 16 << 20;
[[maybe_unused]] const bool kCachesAreFixed = (Eigen::setCpuCacheSizes(kL1, kL2, kL3), true);

template <typename Matrix>
void activate(Activation activation, Matrix& x) {
  using Scalar = typename Matrix::Scalar;
  switch (activation) {
    case Activation::linear:
      break;
    case Activation::relu:
      x = x.cwiseMax(Scalar(0));
      break;
    case Activation::elu:
      x = x.cwiseMax(Scalar(0)) + (x.cwiseMin(Scalar(0)).array().exp() - Scalar(1)).matrix();
      break;
    case Activation::tanh:
      x = x.array().tanh();
      break;
    case Activation::sigmoid:
      x = x.array().logistic();
      break;
  }
}

/// delta ← gradient ∘ f′, with f′ expressed by the activation's output y.
template <typename Matrix, typename Gradient>
void derive(Activation activation, const Matrix& y, const Gradient& gradient, Matrix& delta) {
  using Scalar = typename Matrix::Scalar;
  switch (activation) {
    case Activation::linear:
      delta = gradient;
      break;
    case Activation::relu:
      delta = (y.array() > Scalar(0)).select(gradient, Scalar(0));
      break;
    case Activation::elu:
      delta = gradient.array() * (y.array().min(Scalar(0)) + Scalar(1));
      break;
    case Activation::tanh:
      delta = gradient.array() * (Scalar(1) - y.array().square());
      break;
    case Activation::sigmoid:
      delta = gradient.array() * y.array() * (Scalar(1) - y.array());
      break;
  }
}

/// What layer i is given.
template <typename Matrix>
Eigen::Ref<const Matrix> input_of(std::size_t i, const Eigen::Ref<const Matrix>& input,
                                  const std::vector<Matrix>& output) {
  return i == 0 ? input : Eigen::Ref<const Matrix>(output[i - 1]);
}

}  // namespace

std::string_view name(Activation activation) {
  return kActivations[static_cast<std::size_t>(activation)].second;
}

Activation activation(std::string_view text) {
  for (const auto& [value, known] : kActivations)
    if (text == known) return value;
  throw Error(fmt::format("activation '{}': must be linear, relu, elu, tanh or sigmoid", text));
}

template <typename Scalar>
Mlp<Scalar>::Mlp(const MlpShape& shape) : shape_(shape) {
  Eigen::Index size = 0;
  const auto place = [&size](Eigen::Index count) { return std::exchange(size, size + count); };
  int inputs = shape.inputs;
  for (std::size_t i = 0; i <= shape.hidden.size(); ++i) {
    const bool last = i == shape.hidden.size();
    Layer layer{};
    layer.inputs = inputs;
    layer.outputs = last ? shape.outputs : shape.hidden[i];
    layer.weight = place(Eigen::Index{layer.inputs} * layer.outputs);
    layer.bias = place(layer.outputs);
    const bool normalise = shape.layer_norm && !last;
    layer.scale = normalise ? place(layer.outputs) : -1;
    layer.shift = normalise ? place(layer.outputs) : -1;
    layer.activation = last ? shape.output : shape.activation;
    layers_.push_back(layer);
    inputs = layer.outputs;
  }
  parameters_ = Vector::Zero(size);
}

template <typename Scalar>
std::vector<typename Mlp<Scalar>::Block> Mlp<Scalar>::blocks() const {
  std::vector<Block> blocks;
  for (std::size_t i = 0; i < layers_.size(); ++i) {
    const Layer& layer = layers_[i];
    blocks.push_back({fmt::format("{}.weight", i), layer.weight, layer.outputs, layer.inputs});
    blocks.push_back({fmt::format("{}.bias", i), layer.bias, layer.outputs, 1});
    if (layer.scale < 0) continue;
    blocks.push_back({fmt::format("{}.norm.scale", i), layer.scale, layer.outputs, 1});
    blocks.push_back({fmt::format("{}.norm.shift", i), layer.shift, layer.outputs, 1});
  }
  return blocks;
}

template <typename Scalar>
void Mlp<Scalar>::initialise(Random& random, double last_range) {
  for (std::size_t i = 0; i < layers_.size(); ++i) {
    const Layer& layer = layers_[i];
    const double range = i + 1 == layers_.size() ? last_range : 1 / std::sqrt(layer.inputs);
    const Eigen::Index end = layer.bias + layer.outputs;
    for (Eigen::Index k = layer.weight; k < end; ++k)
      parameters_[k] = static_cast<Scalar>(range * (2 * uniform(random) - 1));
    if (layer.scale < 0) continue;
    parameters_.segment(layer.scale, layer.outputs).setOnes();
    parameters_.segment(layer.shift, layer.outputs).setZero();
  }
}

template <typename Scalar>
const typename Mlp<Scalar>::Matrix& Mlp<Scalar>::forward(const Eigen::Ref<const Matrix>& input,
                                                         Workspace& workspace) const {
  workspace.output.resize(layers_.size());
  workspace.normalised.resize(layers_.size());
  workspace.inverse_sd.resize(layers_.size());
  for (std::size_t i = 0; i < layers_.size(); ++i) {
    const Layer& layer = layers_[i];
    const Eigen::Map<const Matrix> weight(parameters_.data() + layer.weight, layer.outputs,
                                          layer.inputs);
    Matrix& y = workspace.output[i];
    y.resize(layer.outputs, input.cols());
    y.noalias() = weight * input_of<Matrix>(i, input, workspace.output);
    y.colwise() += parameters_.segment(layer.bias, layer.outputs);
    if (layer.scale >= 0) {
      Matrix& x = workspace.normalised[i];
      Vector& inverse_sd = workspace.inverse_sd[i];
      x.resize(y.rows(), y.cols());
      inverse_sd.resize(y.cols());
      const auto scale = parameters_.segment(layer.scale, layer.outputs);
      const auto shift = parameters_.segment(layer.shift, layer.outputs);
      for (Eigen::Index s = 0; s < y.cols(); ++s) {
        x.col(s) = y.col(s).array() - y.col(s).mean();
        const Scalar variance = x.col(s).squaredNorm() / Scalar(layer.outputs);
        inverse_sd[s] = Scalar(1) / std::sqrt(variance + Scalar(kVarianceFloor));
        x.col(s) *= inverse_sd[s];
        y.col(s) = x.col(s).cwiseProduct(scale) + shift;
      }
    }
    activate(layer.activation, y);
  }
  return workspace.output.back();
}

template <typename Scalar>
void Mlp<Scalar>::backward(const Eigen::Ref<const Matrix>& input,
                           const Eigen::Ref<const Matrix>& output_gradient, Workspace& workspace,
                           Vector* gradient, bool by_input) const {
  workspace.delta.resize(layers_.size());
  if (gradient != nullptr) gradient->resize(parameters_.size());
  for (std::size_t i = layers_.size(); i-- > 0;) {
    const Layer& layer = layers_[i];
    Matrix& delta = workspace.delta[i];
    const Matrix& y = workspace.output[i];
    if (i + 1 == layers_.size())
      derive(layer.activation, y, output_gradient, delta);
    else  // delta holds ∂L/∂y, put there by the layer above
      derive(layer.activation, y, delta, delta);

    if (layer.scale >= 0) {
      const Matrix& x = workspace.normalised[i];
      const auto scale = parameters_.segment(layer.scale, layer.outputs);
      if (gradient != nullptr) {
        gradient->segment(layer.scale, layer.outputs) = delta.cwiseProduct(x).rowwise().sum();
        gradient->segment(layer.shift, layer.outputs) = delta.rowwise().sum();
      }
      for (Eigen::Index s = 0; s < delta.cols(); ++s) {
        auto d = delta.col(s);
        d = d.cwiseProduct(scale);
        const Scalar mean = d.mean(), slope = d.dot(x.col(s)) / Scalar(layer.outputs);
        d = workspace.inverse_sd[i][s] * (d.array() - mean - x.col(s).array() * slope);
      }
    }

    if (gradient != nullptr) {
      Eigen::Map<Matrix> weight(gradient->data() + layer.weight, layer.outputs, layer.inputs);
      weight.noalias() = delta * input_of<Matrix>(i, input, workspace.output).transpose();
      gradient->segment(layer.bias, layer.outputs) = delta.rowwise().sum();
    }
    if (i == 0 && !by_input) return;
    const Eigen::Map<const Matrix> weight(parameters_.data() + layer.weight, layer.outputs,
                                          layer.inputs);
    Matrix& below = i == 0 ? workspace.input_gradient : workspace.delta[i - 1];
    below.resize(layer.inputs, delta.cols());
    below.noalias() = weight.transpose() * delta;
  }
}

template class Mlp<float>;
template class Mlp<double>;

}  // namespace stride::network
