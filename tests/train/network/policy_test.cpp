#include "train/network/policy.h"

#include <gtest/gtest.h>

#include "tests/support/temporary_folder.h"
#include "tests/support/throws.h"
#include "train/network/safetensors.h"

namespace stride {
namespace {

const std::vector<std::string> kFeatures{"hip_flexion_r", "hip_flexion_l", "pelvis"};
const std::vector<std::string> kActionNames{"push_r", "push_l"};

network::Policy<float> small_policy() {
  Random random(3);
  network::Policy<float> policy{
      .actor = network::Mlp<float>({.inputs = 3,
                                    .outputs = 2,
                                    .hidden = {5, 4},
                                    .activation = network::Activation::elu,
                                    .output = network::Activation::sigmoid,
                                    .layer_norm = true}),
      .normaliser = network::Normaliser(environment::mirror_by_name(kFeatures))};
  policy.actor.initialise(random, 1);
  for (float& p : policy.actor.parameters()) p += static_cast<float>(0.3 * normal(random));
  for (int i = 0; i < 50; ++i)
    policy.normaliser.add(
        Eigen::VectorXd{{normal(random), 2 + normal(random), 9 + 3 * normal(random)}});
  policy.normaliser.publish();
  return policy;
}

TEST(PolicyFile, GivesTheSameActions) {
  TemporaryFolder folder;
  const network::Policy<float> policy = small_policy();
  network::save_policy(policy, kFeatures, kActionNames, 3, folder / "agent.safetensors");
  const network::Policy<float> read =
      network::load_policy<float>(folder / "agent.safetensors", kFeatures, kActionNames);
  EXPECT_EQ(read.actor.parameters(), policy.actor.parameters());
  EXPECT_EQ(read.normaliser.mean(), policy.normaliser.mean());
  EXPECT_EQ(read.normaliser.inverse_sd(), policy.normaliser.inverse_sd());
}

TEST(PolicyFile, OfASymmetricPolicyMirrorsAfterReadingToo) {
  TemporaryFolder folder;
  const auto file = folder / "agent.safetensors";
  network::Policy<float> policy = small_policy();
  policy.symmetry = environment::right_leg_ahead(kFeatures, kActionNames);
  network::save_policy(policy, kFeatures, kActionNames, 3, file);
  EXPECT_EQ(network::load_tensors(file).meta("version"), "2");
  const auto read = network::load_policy<float>(file, kFeatures, kActionNames);
  network::Mlp<float>::Workspace work;
  const Eigen::Vector3d right_ahead(0.5, -0.1, 12), left_ahead(-0.1, 0.5, 12);
  const Eigen::VectorXd right = read.act(right_ahead, work), left = read.act(left_ahead, work);
  EXPECT_EQ(right, policy.act(right_ahead, work));
  EXPECT_EQ(left, policy.act(left_ahead, work));
  EXPECT_NE(right[0], right[1]) << "the test could not tell right from left";
  EXPECT_EQ(left[0], right[1]);
  EXPECT_EQ(left[1], right[0]);
}

/// The action by the documented formula, as another program would compute it.
TEST(PolicyFile, IsWhatItsDescriptionSays) {
  TemporaryFolder folder;
  const network::Policy<float> policy = small_policy();
  network::save_policy(policy, kFeatures, kActionNames, 3, folder / "agent.safetensors");
  const network::Tensors file = network::load_tensors(folder / "agent.safetensors");
  EXPECT_EQ(file.meta("features"), "hip_flexion_r,hip_flexion_l,pelvis");
  EXPECT_EQ(file.meta("action_repeat"), "3");
  Eigen::VectorXd mean(3), inverse_sd(3), x = Eigen::Vector3d(0.5, 1, 12);
  file.get("normaliser.mean", mean);
  file.get("normaliser.inverse_sd", inverse_sd);
  Eigen::VectorXf h =
      ((x - mean).cwiseProduct(inverse_sd)).cwiseMax(-10).cwiseMin(10).cast<float>();
  const int sizes[] = {3, 5, 4, 2};
  for (int layer = 0; layer < 3; ++layer) {
    const std::string name = "actor." + std::to_string(layer);
    Eigen::MatrixXf weight(sizes[layer + 1], sizes[layer]);
    Eigen::VectorXf bias(sizes[layer + 1]), scale = bias, shift = bias;
    file.get(name + ".weight", weight);
    file.get(name + ".bias", bias);
    h = (weight * h + bias).eval();
    if (layer == 2) break;
    file.get(name + ".norm.scale", scale);
    file.get(name + ".norm.shift", shift);
    const float m = h.mean(), variance = (h.array() - m).square().mean();
    h = ((h.array() - m) / std::sqrt(variance + 1e-5f) * scale.array() + shift.array()).matrix();
    for (float& v : h) v = v > 0 ? v : std::exp(v) - 1;
  }
  Eigen::MatrixXf input = x.cast<float>();
  policy.normaliser.apply(input);
  network::Mlp<float>::Workspace work;
  const Eigen::VectorXf action = policy.actor.forward(input, work).col(0);
  for (int i = 0; i < 2; ++i) EXPECT_NEAR(action[i], 1 / (1 + std::exp(-h[i])), 1e-5);
}

TEST(PolicyFile, OfOtherFeaturesOrAnotherPrecisionIsRefused) {
  TemporaryFolder folder;
  network::save_policy(small_policy(), kFeatures, kActionNames, 3, folder / "agent.safetensors");
  const auto file = folder / "agent.safetensors";
  EXPECT_ERROR(network::load_policy<float>(file, {"a", "b", "c"}, kActionNames),
               "its features are not those");
  EXPECT_ERROR(network::load_policy<float>(file, kFeatures, {"push"}), "its actions are not those");
  EXPECT_ERROR(network::load_policy<double>(file, kFeatures, kActionNames),
               "is of type F32, F64 is needed");
}

}  // namespace
}  // namespace stride
