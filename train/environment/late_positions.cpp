#include "train/environment/late_positions.h"

#include "extract/io/random.h"

namespace stride::environment {
namespace {

/// Places of the positions among the competition's 41: head, torso, toes and talus of both sides;
/// the pelvis lies between head and torso.
constexpr int kPlaces[] = {22, 23, 26, 27, 28, 29, 30, 31, 32, 33, 34, 35};
constexpr std::uint64_t kStream = 6;

}  // namespace

void LatePositions::start(std::uint64_t seed) {
  random_.seed(stream_seed(seed, kStream));
  remaining_ = 0;
  late_ = false;
  first_ = true;
  last_.resize(std::size(kPlaces));
}

void LatePositions::apply(Eigen::VectorXd& observation) {
  // After a cluster one row is on time, so that none is older than kLongest steps.
  if (!first_ && !late_ && uniform(random_) < kBegin)
    remaining_ = 1 + static_cast<int>(uniform_index(random_, kLongest));
  late_ = remaining_ > 0;
  if (late_) --remaining_;
  for (std::size_t i = 0; i < std::size(kPlaces); ++i) {
    double& now = observation[kPlaces[i]];
    double& before = last_[static_cast<Eigen::Index>(i)];
    if (late_)
      now = before;
    else
      before = now;
  }
  first_ = false;
}

}  // namespace stride::environment
