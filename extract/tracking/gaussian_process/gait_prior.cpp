#include "extract/tracking/gaussian_process/gait_prior.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "extract/tracking/gaussian_process/hyperparameters.h"
#include "extract/tracking/gaussian_process/joint.h"
#include "extract/tracking/gaussian_process/regression.h"

namespace stride::gaussian_process {
namespace {

using Eigen::Vector2d;

constexpr std::size_t kMostFitted = 40;  // clicks of a part that the kernels are fitted to

std::vector<Sample> with_noise(std::vector<Sample> samples, double noise_px) {
  for (Sample& s : samples) s.variance_px2.setConstant(noise_px * noise_px);
  return samples;
}

/// Positions relative to the pelvis at the same times.
std::vector<Sample> relative(std::vector<Sample> samples, const Regression& pelvis) {
  std::vector<double> times_s;
  for (const Sample& s : samples) times_s.push_back(s.time_s);
  const std::vector<Vector2d> pelvis_px = pelvis.places(times_s, 0);
  for (std::size_t i = 0; i < samples.size(); ++i) samples[i].p_px -= pelvis_px[i];
  return samples;
}

Regression pelvis_regression(const GaitPrior& prior, const Observations& clicks) {
  const auto samples = samples_of(kPelvis, clicks, prior.origin_s);
  return {prior.trunk, centred(kPelvis, with_noise(samples, prior.trunk.noise_px), prior.size_px)};
}

/// Knees and ankles relative to the pelvis; more parts add little.
std::vector<GroupData> leg_data(const GaitPrior& prior, const Observations& clicks) {
  const Regression pelvis = pelvis_regression(prior, clicks);
  std::vector<GroupData> groups;
  for (const Group& group : kLegGroups) {
    if (groups.size() == 2) break;
    const auto samples = samples_of(group, clicks, prior.origin_s);
    if (samples.size() >= 4)
      groups.push_back(centred(group, relative(samples, pelvis), prior.size_px));
  }
  return groups;
}

JointData joint_data(const GaitPrior& prior, const Observations& clicks) {
  JointData data{centred(kPelvis, samples_of(kPelvis, clicks, prior.origin_s), prior.size_px),
                 leg_data(prior, clicks)};
  for (GroupData& group : data.legs) {
    const auto places = samples_of(group.group, clicks, prior.origin_s);
    for (std::size_t i = 0; i < places.size(); ++i)
      group.samples[i].p_px = places[i].p_px - data.pelvis.mean_px - group.mean_px;
  }
  return data;
}

/// A subset of many clicks, as from a detector: about ten a second from the middle of the clip
/// suffice for the kernels.
Observations thinned(const Observations& clicks) {
  Observations few;
  for (int i = 0; i < kBodyPartCount; ++i) {
    for (const Observation& o : clicks[i])
      if (clicks[i].size() <= kMostFitted || few[i].empty() ||
          o.time_s > few[i].back().time_s + 0.06)
        few[i].push_back(o);
    if (few[i].size() <= kMostFitted) continue;
    const auto skip = static_cast<long>((few[i].size() - kMostFitted) / 2);
    few[i].erase(few[i].begin(), few[i].begin() + skip);
    few[i].resize(kMostFitted);
  }
  return few;
}

/// Rms distance of knees, ankles and toes from the pelvis on the same frame.
double leg_size_px(const Observations& clicks) {
  double squared = 0;
  int n = 0;
  for (const Observation& pelvis : clicks[index(BodyPart::pelvis)])
    for (const Group& group : kLegGroups)
      for (const BodyPart part : {group.right, group.left})
        for (const Observation& o : clicks[index(part)])
          if (row(part).prompt == Prompt::always && o.time_s == pelvis.time_s) {
            squared += (o.p_px - pelvis.p_px).squaredNorm();
            ++n;
          }
  return n > 0 ? std::max(std::sqrt(squared / n), 10.0) : 90;
}

/// +1 if the runner faces right, −1 left, because knees bend forward; 0 if no whole leg was
/// clicked.
int facing(const Observations& clicks) {
  const auto at = [&](BodyPart part, double time_s) -> const Vector2d* {
    for (const Observation& o : clicks[index(part)])
      if (o.time_s == time_s) return &o.p_px;
    return nullptr;
  };
  double forward = 0;
  for (const Observation& pelvis : clicks[index(BodyPart::pelvis)])
    for (const auto& [knee_part, ankle_part] : {std::pair(BodyPart::knee_r, BodyPart::ankle_r),
                                                std::pair(BodyPart::knee_l, BodyPart::ankle_l)}) {
      const Vector2d *knee = at(knee_part, pelvis.time_s), *ankle = at(ankle_part, pelvis.time_s);
      if (knee == nullptr || ankle == nullptr) continue;
      const Vector2d up = pelvis.p_px - *ankle, shank = *knee - *ankle;
      forward += up.x() * shank.y() - up.y() * shank.x();
    }
  return (forward > 0) - (forward < 0);
}

/// Where the joint fit starts: the pelvis alone by a nearly free spline.
GaitPrior first_prior(const Observations& clicks) {
  GaitPrior prior;
  double first = std::numeric_limits<double>::infinity(), last = -first;
  for (const auto& part : clicks)
    for (const Observation& o : part) {
      first = std::min(first, o.time_s);
      last = std::max(last, o.time_s);
    }
  prior.origin_s = (first + last) / 2;
  prior.size_px = leg_size_px(clicks);
  prior.trunk.residual = 1;
  return prior;
}

}  // namespace

GaitPrior fit_passage_prior(const Observations& all_clicks) {
  const Observations clicks = thinned(all_clicks);
  GaitPrior prior = first_prior(clicks);
  for (GaitKernel* kernel : {&prior.legs, &prior.trunk}) {
    kernel->periodic = false;
    kernel->period_s = 1;
  }
  prior.legs.residual = 1;
  prior.legs.residual_strides = 0.25;
  if (leg_data(prior, clicks).empty()) return prior;
  return refined_together(prior, joint_data(prior, clicks), 3);
}

std::vector<GaitPrior> likely_gait_priors(const Observations& all_clicks,
                                          const PeriodBounds& bounds) {
  const Observations clicks = thinned(all_clicks);
  const GaitPrior prior = first_prior(clicks);
  const auto legs = leg_data(prior, clicks);
  if (legs.empty()) return {prior};
  std::vector<GaitPrior> likely;
  for (const Fitted& fit : fitted(legs, facing(clicks), bounds)) {
    GaitPrior own = prior;
    own.legs = fit.kernel;
    own.trunk = GaitKernel();
    own.trunk.period_s = own.legs.period_s;
    own.legs.noise_px /= std::numbers::sqrt2;  // a part of it was the noise of the pelvis
    own.trunk.noise_px = own.legs.noise_px;
    likely.push_back(refined_together(own, joint_data(own, clicks), 3));
  }
  return likely;
}

GaitPrior fit_gait_prior(const Observations& clicks, const PeriodBounds& bounds) {
  return likely_gait_priors(clicks, bounds).front();
}

}  // namespace stride::gaussian_process
