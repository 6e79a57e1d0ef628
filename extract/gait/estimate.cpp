#include <limits>
#include <map>
#include <optional>

#include "extract/gait/regression.h"
#include "extract/gait_prior.h"

namespace stride {
namespace {

using Eigen::Vector2d;

constexpr std::size_t kMostTogether = 250;  // observations of a part in one regression

/// Places of the pelvis, each computed once.
class PelvisPath {
 public:
  explicit PelvisPath(const Regression& regression) : regression_(regression) {}
  Vector2d operator()(double time_s) {
    const auto [entry, is_new] = known_.try_emplace(time_s);
    if (is_new) entry->second = regression_.place(time_s, 0);
    return entry->second;
  }
  /// The part of a sample that is the pelvis'.
  Vector2d share_of(const Sample& s) {
    return s.is_way() ? Vector2d((*this)(s.time_s) - (*this)(s.since_s)) : (*this)(s.time_s);
  }

 private:
  const Regression& regression_;
  std::map<double, Vector2d> known_;
};

/// Samples of the same place or way, as one.
class Pool {
 public:
  void add(const Sample& s, const Vector2d& p_px) {
    Sum& sum = sums_[{s.time_s, s.is_way() ? s.since_s : s.time_s}];
    const Vector2d weight = s.variance_px2.cwiseInverse();
    sum.weight += weight;
    sum.weighted += weight.cwiseProduct(p_px);
  }
  std::vector<Sample> samples() const {
    std::vector<Sample> samples;
    for (const auto& [times, sum] : sums_) {
      Sample& s = samples.emplace_back();
      s.time_s = times.first;
      s.left = 0;
      s.p_px = sum.weighted.cwiseQuotient(sum.weight);
      s.variance_px2 = sum.weight.cwiseInverse();
      if (times.second != times.first) s.since_s = times.second;
    }
    return samples;
  }

 private:
  struct Sum {
    Vector2d weight = Vector2d::Zero(), weighted = Vector2d::Zero();
  };
  std::map<std::pair<double, double>, Sum> sums_;
};

std::optional<Regression> leg_regression(const Group& group, const GaitKernel& kernel,
                                         std::vector<Sample> samples, PelvisPath& pelvis,
                                         double size_px) {
  if (samples.empty()) return std::nullopt;
  for (Sample& s : samples) s.p_px -= pelvis.share_of(s);
  return Regression(kernel, centred(group, std::move(samples), size_px));
}

Estimates estimate_together(const GaitPrior& prior, const Observations& observations,
                            const std::vector<double>& times_s) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  Estimate absent;
  absent.p_px.setConstant(kNan);
  absent.variance_px2.setConstant(kNan);
  std::array<Estimate, kBodyPartCount> none;
  none.fill(absent);
  Estimates estimates(times_s.size(), none);

  const auto pelvis_samples = samples_of(kPelvis, observations, prior.origin_s);
  if (pelvis_samples.empty()) return estimates;
  Regression pelvis(prior.trunk, centred(kPelvis, pelvis_samples, prior.size_px));
  {
    // What the legs leave unexplained is the pelvis' too: one round of backfitting the sum of both
    // (a second one changes nothing that could be measured).
    PelvisPath path(pelvis);
    Pool pool;
    for (const Sample& s : pelvis_samples) pool.add(s, s.p_px);
    for (const Group& group : kLegGroups) {
      const auto legs = leg_regression(
          group, prior.legs, samples_of(group, observations, prior.origin_s), path, prior.size_px);
      if (!legs) continue;
      for (std::size_t i = 0; i < legs->samples().size(); ++i) {
        const Sample& s = legs->samples()[i];
        pool.add(s, path.share_of(s) + legs->residual_px(i));
      }
    }
    pelvis = Regression(prior.trunk, centred(kPelvis, pool.samples(), prior.size_px));
  }

  PelvisPath path(pelvis);
  for (std::size_t i = 0; i < times_s.size(); ++i)
    estimates[i][index(BodyPart::pelvis)] = pelvis.at(times_s[i] - prior.origin_s, 0);
  const auto add = [&](const Group& group, const GaitKernel& kernel) {
    const auto legs = leg_regression(group, kernel, samples_of(group, observations, prior.origin_s),
                                     path, prior.size_px);
    if (!legs) return;
    for (std::size_t i = 0; i < times_s.size(); ++i)
      for (int left = 0; left <= (group.paired() ? 1 : 0); ++left) {
        Estimate estimate = legs->at(times_s[i] - prior.origin_s, left);
        estimate.p_px += estimates[i][index(BodyPart::pelvis)].p_px;
        estimate.variance_px2 += estimates[i][index(BodyPart::pelvis)].variance_px2;
        estimates[i][index(left ? group.left : group.right)] = estimate;
      }
  };
  for (const Group& group : kLegGroups) add(group, prior.legs);
  add(kHead, prior.trunk);
  return estimates;
}

/// Observations in a range of times.
Observations between(const Observations& observations, double from_s, double to_s) {
  Observations some;
  for (int i = 0; i < kBodyPartCount; ++i)
    for (const Observation& o : observations[i])
      if (o.time_s >= from_s && o.time_s <= to_s) some[i].push_back(o);
  return some;
}

}  // namespace

Estimates estimate(const GaitPrior& prior, const Observations& observations,
                   const std::vector<double>& times_s) {
  std::size_t most = 0;
  for (const auto& part : observations) most = std::max(most, part.size());
  if (most <= kMostTogether) return estimate_together(prior, observations, times_s);

  // Cubic cost: a long clip goes in windows of two strides that see three more on either side.
  const double window_s = 2 * prior.legs.period_s, margin_s = 3 * prior.legs.period_s;
  Estimates estimates;
  for (std::size_t i = 0; i < times_s.size();) {
    std::size_t end = i;
    while (end < times_s.size() && times_s[end] < times_s[i] + window_s) ++end;
    const std::vector<double> window(times_s.begin() + static_cast<long>(i),
                                     times_s.begin() + static_cast<long>(end));
    const Observations seen =
        between(observations, window.front() - margin_s, window.back() + margin_s);
    const Estimates part = estimate_together(prior, seen, window);
    estimates.insert(estimates.end(), part.begin(), part.end());
    i = end;
  }
  return estimates;
}

}  // namespace stride
