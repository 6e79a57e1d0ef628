#include "train/network/policy_onnx.h"

#include <gtest/gtest.h>

#include <opencv2/dnn.hpp>

namespace stride {
namespace {

const network::PolicyNames kNames{
    {"hip_flexion_r", "hip_flexion_l", "pelvis", "phase_sin", "phase_cos"}, {"r", "l"}, 3};

template <typename Scalar>
network::Policy<Scalar> some_policy(network::Activation activation, bool layer_norm,
                                    std::vector<int> hidden) {
  Random random(3);
  network::Policy<Scalar> policy{
      .actor = network::Mlp<Scalar>({.inputs = 5,
                                     .outputs = 2,
                                     .hidden = std::move(hidden),
                                     .activation = activation,
                                     .output = network::Activation::sigmoid,
                                     .layer_norm = layer_norm}),
      .normaliser = network::Normaliser(environment::mirror_by_name(kNames.features))};
  policy.actor.initialise(random, 1);
  for (Scalar& p : policy.actor.parameters()) p += static_cast<Scalar>(0.3 * normal(random));
  for (int i = 0; i < 50; ++i)
    policy.normaliser.add(Eigen::VectorXd{
        {normal(random), 2 + normal(random), 9 + 3 * normal(random), normal(random), 7}});
  policy.normaliser.publish();
  return policy;
}

/// Largest difference between our actions and OpenCV's, over random observations, some of which
/// are so far out that the normaliser clips them.
template <typename Scalar>
double difference(const network::Policy<Scalar>& policy) {
  const std::string bytes = network::to_onnx(policy, kNames);
  cv::dnn::Net net = cv::dnn::readNetFromONNX(bytes.data(), bytes.size());
  Random random(5);
  typename network::Mlp<Scalar>::Workspace work;
  double largest = 0;
  for (int i = 0; i < 100; ++i) {
    Eigen::VectorXd input(5);
    cv::Mat features(1, 5, CV_32F);
    for (int k = 0; k < 5; ++k)
      input[k] = features.at<float>(k) = static_cast<float>(20 * normal(random));
    net.setInput(features);
    const cv::Mat actions = net.forward();
    const Eigen::VectorXd expected = policy.act(input, work);
    for (int k = 0; k < 2; ++k)
      largest = std::max(largest, std::abs(double(actions.at<float>(k)) - expected[k]));
  }
  return largest;
}

TEST(PolicyOnnx, OpenCvActsAsWeDoWhateverTheActivation) {
  for (const network::Activation activation :
       {network::Activation::linear, network::Activation::relu, network::Activation::elu,
        network::Activation::tanh, network::Activation::sigmoid})
    for (const bool layer_norm : {false, true}) {
      SCOPED_TRACE(std::string(network::name(activation)) + (layer_norm ? ", layer norm" : ""));
      EXPECT_LT(difference(some_policy<float>(activation, layer_norm, {7, 6})), 2e-5);
      EXPECT_LT(difference(some_policy<double>(activation, layer_norm, {7, 6})), 2e-5);
    }
  EXPECT_LT(difference(some_policy<float>(network::Activation::elu, true, {})), 2e-5);
}

TEST(PolicyOnnx, OpenCvMirrorsAsWeDo) {
  network::Policy<float> policy = some_policy<float>(network::Activation::tanh, false, {7, 6});
  policy.symmetry = environment::right_leg_ahead(kNames.features, kNames.actions);
  EXPECT_LT(difference(policy), 2e-5);
}

TEST(PolicyOnnx, NamesItsFeaturesAndActions) {
  const std::string bytes =
      network::to_onnx(some_policy<float>(network::Activation::elu, true, {4}), kNames);
  EXPECT_NE(bytes.find("hip_flexion_r,hip_flexion_l,pelvis,phase_sin,phase_cos"),
            std::string::npos);
  EXPECT_NE(bytes.find("action_repeat"), std::string::npos);
}

}  // namespace
}  // namespace stride
