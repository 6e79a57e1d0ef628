#include "train/network/mlp.h"

#include <gtest/gtest.h>

#include "tests/support/throws.h"

namespace stride {
namespace {

using Net = network::Mlp<double>;

/// A loss with a gradient that is different for each output: Σ w ∘ y + ½ Σ y².
struct Loss {
  Net::Matrix w;
  double value(const Net::Matrix& y) const { return w.cwiseProduct(y).sum() + y.squaredNorm() / 2; }
  Net::Matrix gradient(const Net::Matrix& y) const { return w + y; }
};

Net::Matrix random_matrix(Random& random, int rows, int columns) {
  Net::Matrix m(rows, columns);
  for (double& v : m.reshaped()) v = normal(random);
  return m;
}

class MlpGradient : public ::testing::TestWithParam<network::MlpShape> {};

TEST_P(MlpGradient, AgreesWithFiniteDifferences) {
  Random random(7);
  Net net(GetParam());
  net.initialise(random, 0.5);
  net.parameters() += 0.1 * random_matrix(random, static_cast<int>(net.parameters().size()), 1);
  const Net::Matrix x = random_matrix(random, GetParam().inputs, 6);
  const Loss loss{random_matrix(random, GetParam().outputs, 6)};
  Net::Workspace work;
  Net::Vector gradient;
  const Net::Matrix y = net.forward(x, work);
  net.backward(x, loss.gradient(y), work, &gradient, true);
  const Net::Matrix input_gradient = work.input_gradient;

  const double h = 1e-6;
  const auto difference = [&](double& variable, const Net::Matrix& input) {
    const double at = variable;
    variable = at + h;
    const double above = loss.value(net.forward(input, work));
    variable = at - h;
    const double below = loss.value(net.forward(input, work));
    variable = at;
    return (above - below) / (2 * h);
  };
  for (Eigen::Index i = 0; i < net.parameters().size(); ++i)
    ASSERT_NEAR(gradient[i], difference(net.parameters()[i], x), 2e-7) << "parameter " << i;
  Net::Matrix moved = x;
  for (Eigen::Index i = 0; i < x.size(); ++i)
    ASSERT_NEAR(input_gradient.reshaped()[i], difference(moved.reshaped()[i], moved), 2e-7)
        << "input " << i;
}

INSTANTIATE_TEST_SUITE_P(
    Shapes, MlpGradient,
    ::testing::Values(
        network::MlpShape{
            5, 3, {7, 4}, network::Activation::elu, network::Activation::linear, false},
        network::MlpShape{
            5, 3, {7, 4}, network::Activation::elu, network::Activation::sigmoid, true},
        network::MlpShape{
            4, 1, {6, 6, 6}, network::Activation::tanh, network::Activation::linear, true},
        network::MlpShape{
            4, 2, {9, 5}, network::Activation::relu, network::Activation::sigmoid, false},
        network::MlpShape{
            3, 2, {}, network::Activation::relu, network::Activation::linear, false}));

TEST(Mlp, IsTheFormulaOfItsLayers) {
  Random random(3);
  Net net({3, 2, {4}, network::Activation::tanh, network::Activation::sigmoid, false});
  net.initialise(random, 1);
  const auto blocks = net.blocks();
  ASSERT_EQ(blocks.size(), 4u);
  const auto block = [&](int i) {
    return Eigen::Map<const Net::Matrix>(net.parameters().data() + blocks[i].offset, blocks[i].rows,
                                         blocks[i].columns);
  };
  const Net::Vector x = random_matrix(random, 3, 1);
  const Net::Vector h = (block(0) * x + block(1)).array().tanh();
  const Net::Vector z = block(2) * h + block(3);
  Net::Workspace work;
  const Net::Vector y = net.forward(x, work);
  for (int i = 0; i < 2; ++i) EXPECT_NEAR(y[i], 1 / (1 + std::exp(-z[i])), 1e-14);
}

TEST(Mlp, LayerNormGivesEachSampleMeanShiftAndDeviationScale) {
  Random random(5);
  Net net({6, 1, {50}, network::Activation::linear, network::Activation::linear, true});
  net.initialise(random, 1);
  for (const auto& block : net.blocks()) {
    auto values = net.parameters().segment(block.offset, block.rows * block.columns);
    if (block.name == "0.norm.scale") values.setConstant(3);
    if (block.name == "0.norm.shift") values.setConstant(-2);
  }
  Net::Workspace work;
  const Net::Matrix x = 100 * random_matrix(random, 6, 4);
  net.forward(x, work);
  for (int s = 0; s < 4; ++s) {
    const auto y = work.output[0].col(s).array();
    EXPECT_NEAR(y.mean(), -2, 1e-12);
    EXPECT_NEAR(std::sqrt((y - y.mean()).square().mean()), 3, 1e-6);
  }
}

TEST(Mlp, LayerNormMatchesRecordedNumbers) {
  // torch.nn.LayerNorm's formula, (x − E x)/√(Var x + 1e-5), of x = (1, 2, 4): mean 7/3, biased
  // variance 14/9.
  Net net({3, 3, {3}, network::Activation::linear, network::Activation::linear, true});
  net.parameters().setZero();
  for (const auto& block : net.blocks()) {
    Eigen::Map<Net::Matrix> m(net.parameters().data() + block.offset, block.rows, block.columns);
    if (block.name.ends_with("weight")) m.setIdentity();
    if (block.name.ends_with("scale")) m.setOnes();
  }
  Net::Workspace work;
  const Net::Vector y = net.forward(Eigen::Vector3d(1, 2, 4), work);
  EXPECT_NEAR(y[0], -1.0690415, 1e-6);
  EXPECT_NEAR(y[1], -0.2672604, 1e-6);
  EXPECT_NEAR(y[2], 1.3363019, 1e-6);
}

TEST(Mlp, AllocatesNothingOnceItHasSeenABatch) {
  Random random(1);
  network::Mlp<float> net(
      {112, 18, {128, 128}, network::Activation::elu, network::Activation::sigmoid, true});
  net.initialise(random, 1e-3);
  const network::Mlp<float>::Matrix x = network::Mlp<float>::Matrix::Random(112, 64);
  network::Mlp<float>::Workspace work;
  network::Mlp<float>::Vector gradient;
  const auto once = [&] {
    const auto& y = net.forward(x, work);
    net.backward(x, y, work, &gradient, true);
  };
  once();
  std::vector<const float*> before{gradient.data(), work.input_gradient.data()};
  for (const auto& m : work.output) before.push_back(m.data());
  for (const auto& m : work.delta) before.push_back(m.data());
  once();
  std::vector<const float*> after{gradient.data(), work.input_gradient.data()};
  for (const auto& m : work.output) after.push_back(m.data());
  for (const auto& m : work.delta) after.push_back(m.data());
  EXPECT_EQ(before, after);
}

TEST(Mlp, FloatAndDoubleAgree) {
  Random random(9), again(9);
  const network::MlpShape shape{
      10, 4, {32, 32}, network::Activation::elu, network::Activation::sigmoid, true};
  Net net(shape);
  network::Mlp<float> single(shape);
  net.initialise(random, 0.1);
  single.initialise(again, 0.1);
  const Net::Matrix x = random_matrix(random, 10, 8);
  Net::Workspace work;
  network::Mlp<float>::Workspace single_work;
  const network::Mlp<float>::Matrix narrow = x.cast<float>();
  EXPECT_LT((net.forward(x, work) - single.forward(narrow, single_work).cast<double>()).norm(),
            1e-5);
}

TEST(Mlp, AnUnknownActivationIsNamed) {
  EXPECT_ERROR(network::activation("selu"), "activation 'selu'");
}

}  // namespace
}  // namespace stride
