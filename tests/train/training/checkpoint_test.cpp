#include "train/training/checkpoint.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

#include "tests/support/temporary_folder.h"
#include "tests/support/throws.h"
#include "tests/train/support/point_mass.h"
#include "train/network/safetensors.h"

namespace stride {
namespace {

namespace fs = std::filesystem;

/// A training of a point mass in the middle of its episodes, and its checkpoint.
class Checkpoint : public ::testing::Test {
 protected:
  Checkpoint() {
    options_.run.environments = 2;
    options_.run.round = 2;
    options_.observation = {.centre = false, .derived = false, .activations = false};
    options_.agent.actor_hidden = options_.agent.critic_hidden = {3};
    options_.replay.capacity = 40;
    training::Training<float> training = start(options_);
    const network::Policy<float> policy = training::policy_of(training, options_);
    for (int slot = 0; slot < 2; ++slot)
      for (int i = 0; i < 2; ++i)
        training.explorers[static_cast<std::size_t>(slot)].decide(
            policy, training.buffer, training.buffer.record(i, slot),
            training.buffer.features(i, slot), training.buffer.action(i, slot));
    training.buffer.publish(2);
    training::save_checkpoint(training, folder_.path());
  }

  template <typename Scalar = float>
  static training::Training<Scalar> start(const training::TrainOptions& options) {
    return training::start_training<Scalar>(options, nullptr,
                                            [](int) { return std::make_unique<PointMass>(); });
  }

  /// The error for the checkpoint after `change`.
  template <typename Change>
  void expect_refused(const char* text, const fs::path& file, const Change& change) {
    SCOPED_TRACE(text);
    const network::Tensors whole = network::load_tensors(file);
    network::Tensors changed = whole;
    change(changed);
    network::save(changed, file);
    training::Training<float> training = start(options_);
    EXPECT_ERROR(training::load_checkpoint(training, folder_.path()), text);
    EXPECT_ERROR(training::load_checkpoint(training, folder_.path()), file.string());
    network::save(whole, file);
  }

  fs::path segment() const { return fs::directory_iterator(folder_ / "replay")->path(); }

  TemporaryFolder folder_;
  training::TrainOptions options_;
};

TEST_F(Checkpoint, OfAnotherVersionIsRefused) {
  const fs::path file = training::checkpoint_file(folder_.path());
  expect_refused("a stride checkpoint of version 1 or 2 is needed", file,
                 [](network::Tensors& t) { t.metadata["version"] = "3"; });
  expect_refused("'progress.updates' is missing", file,
                 [](network::Tensors& t) { t.tensors.erase("progress.updates"); });
  expect_refused("progress has 5 bytes", file, [](network::Tensors& t) {
    t.metadata["version"] = "1";
    t.put_bytes("progress", "short");
  });
}

TEST_F(Checkpoint, OfAnotherModelIsRefused) {
  training::TrainOptions wider = options_;
  wider.agent.actor_hidden = {4};
  training::Training<float> training = start(wider);
  EXPECT_ERROR(training::load_checkpoint(training, folder_.path()), "of another model");
  wider = options_;
  wider.agent.critics = 2;
  training::Training<float> two_critics = start(wider);
  EXPECT_ERROR(training::load_checkpoint(two_critics, folder_.path()), "'critic1' is missing");
  training::Training<double> other_precision = start<double>(options_);
  EXPECT_ERROR(training::load_checkpoint(other_precision, folder_.path()),
               "is of type F32, F64 is needed");
}

TEST_F(Checkpoint, WithNumbersThatAreNoneIsRefused) {
  expect_refused("'actor' holds a number that is not finite",
                 training::checkpoint_file(folder_.path()), [](network::Tensors& t) {
                   const float nan = NAN;
                   std::memcpy(t.tensors["actor"].bytes.data(), &nan, sizeof nan);
                 });
  expect_refused("holds what is no number", segment(), [](network::Tensors& t) {
    const float infinite = INFINITY;
    std::memcpy(t.tensors["features"].bytes.data(), &infinite, sizeof infinite);
  });
}

TEST_F(Checkpoint, WhosePartsDoNotFitIsRefused) {
  const fs::path file = training::checkpoint_file(folder_.path());
  const Eigen::VectorXf two{{1, 2}};
  expect_refused("'actor_adam.m' has 2 elements", file,
                 [&](network::Tensors& t) { t.put("actor_adam.m", two); });
  expect_refused("'slot1.perturbed' has 2 elements", file,
                 [&](network::Tensors& t) { t.put("slot1.perturbed", two); });
  expect_refused("rounds = -1", file,
                 [](network::Tensors& t) { t.put("rounds", std::int64_t{-1}); });
  expect_refused("random number generator cannot be read", file, [](network::Tensors& t) {
    std::string& bytes = t.tensors["random"].bytes;  // … which of its 312 numbers comes next
    std::string text = bytes.substr(0, bytes.find_last_of(' ')) + " 100000";
    t.put_bytes("random", text);
  });
  for (const char* bytes : {"actions", "outcome", "records"})
    expect_refused("of another run", segment(),
                   [&](network::Tensors& t) { t.put_bytes(bytes, "abc"); });
}

}  // namespace
}  // namespace stride
