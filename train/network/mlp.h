#pragma once

#include <Eigen/Core>
#include <string>
#include <string_view>
#include <vector>

#include "extract/io/random.h"

namespace stride::network {

enum class Activation { linear, relu, elu, tanh, sigmoid };

std::string_view name(Activation activation);
/// Throws Error with the list of names.
Activation activation(std::string_view name);

struct MlpShape {
  int inputs = 0, outputs = 0;
  std::vector<int> hidden;  // neurons of each hidden layer
  Activation activation = Activation::relu;
  Activation output = Activation::linear;
  bool layer_norm = false;  // of each hidden layer, between its affine map and its activation
};

inline constexpr double kVarianceFloor = 1e-5;  // of the layer normalisation, PyTorch's value

/// A multilayer perceptron with gradients: affine maps, optional layer normalisation (Ba et al.
/// 2016), activation. A batch is a matrix with a column for each sample. All parameters are in one
/// vector, layer by layer: weight (outputs × inputs, column by column), bias, and scale and shift
/// of the normalisation. Float or double.
template <typename Scalar>
class Mlp {
 public:
  using Matrix = Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic>;
  using Vector = Eigen::Matrix<Scalar, Eigen::Dynamic, 1>;

  /// Intermediate results of forward() for backward(). Use one for each thread and batch size: it
  /// allocates only when the size of the batch changes.
  struct Workspace {
    std::vector<Matrix> output;      // of each layer, after its activation
    std::vector<Matrix> normalised;  // before scale and shift
    std::vector<Vector> inverse_sd;  // of each layer and sample
    std::vector<Matrix> delta;       // ∂L/∂(affine map) of each layer
    Matrix input_gradient;           // ∂L/∂input
  };

  /// A block of the parameters, for files: name such as `0.weight`, row and column count.
  struct Block {
    std::string name;
    Eigen::Index offset = 0, rows = 0, columns = 0;
  };

  explicit Mlp(const MlpShape& shape);

  const MlpShape& shape() const { return shape_; }
  Vector& parameters() { return parameters_; }
  const Vector& parameters() const { return parameters_; }
  std::vector<Block> blocks() const;

  /// Draws weights and biases uniformly from ±1/√inputs, those of the last layer from ±last_range
  /// (Lillicrap et al. 2016, Sec. 7). Scale 1, shift 0.
  void initialise(Random& random, double last_range);

  /// Returns outputs × batch, which stay valid in the workspace.
  const Matrix& forward(const Eigen::Ref<const Matrix>& input, Workspace& workspace) const;

  /// Backpropagates the loss gradient with respect to the output, `output_gradient`, after
  /// forward() of the same input. Sets `gradient`, unless null, to the gradient with respect to the
  /// parameters, and workspace.input_gradient to the one with respect to the input if `by_input`.
  void backward(const Eigen::Ref<const Matrix>& input,
                const Eigen::Ref<const Matrix>& output_gradient, Workspace& workspace,
                Vector* gradient, bool by_input) const;

 private:
  struct Layer {
    int inputs, outputs;
    Eigen::Index weight, bias, scale, shift;  // offsets; scale < 0: no normalisation
    Activation activation;
  };

  MlpShape shape_;
  std::vector<Layer> layers_;
  Vector parameters_;
};

extern template class Mlp<float>;
extern template class Mlp<double>;

}  // namespace stride::network
