#include <limits>
#include <map>
#include <optional>

#include "extract/tracking/gaussian_process/gait_prior.h"
#include "extract/tracking/gaussian_process/hyperparameters.h"
#include "extract/tracking/gaussian_process/regression.h"

namespace stride::gaussian_process {
namespace {

using Eigen::Vector2d;

constexpr std::size_t kMostTogether = 250;  // observations of a part in one regression

/// Pelvis positions at given times and at the times of all observations.
class PelvisPath {
 public:
  PelvisPath(const Regression& pelvis, const Observations& observations, double origin_s,
             const std::vector<double>& times_s = {}) {
    for (const double time_s : times_s) known_[time_s];
    for (const auto& part : observations)
      for (const Observation& o : part) {
        known_[o.time_s - origin_s];
        if (o.is_displacement()) known_[o.since_s - origin_s];
      }
    std::vector<double> all_s;
    for (const auto& [time_s, place] : known_) all_s.push_back(time_s);
    const std::vector<Vector2d> places = pelvis.places(all_s, 0);
    auto place = places.begin();
    for (auto& [time_s, known] : known_) known = *place++;
  }

  const Vector2d& operator()(double time_s) const { return known_.at(time_s); }

  /// The pelvis' contribution to a sample.
  Vector2d share_of(const Sample& s) const {
    return s.is_displacement() ? Vector2d((*this)(s.time_s) - (*this)(s.since_s))
                               : (*this)(s.time_s);
  }

 private:
  std::map<double, Vector2d> known_;
};

/// Merges samples of the same position or displacement.
class Pool {
 public:
  void add(const Sample& s, const Vector2d& p_px) {
    Sum& sum = sums_[{s.time_s, s.is_displacement() ? s.since_s : s.time_s}];
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
                                         std::vector<Sample> samples, const PelvisPath& pelvis,
                                         double size_px) {
  if (samples.empty()) return std::nullopt;
  for (Sample& s : samples) s.p_px -= pelvis.share_of(s);
  return Regression(kernel, centred(group, std::move(samples), size_px));
}

Estimates estimate_together(const GaitPrior& prior, const Observations& observations,
                            const std::vector<double>& times_s, bool with_variance) {
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
    // The residuals of the legs belong to the pelvis too: one round of backfitting. A second round
    // has no measurable effect.
    const PelvisPath path(pelvis, observations, prior.origin_s);
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

  std::vector<double> own_s;  // relative to the origin
  for (const double time_s : times_s) own_s.push_back(time_s - prior.origin_s);
  const PelvisPath path(pelvis, observations, prior.origin_s);
  const auto of = [&](const Regression& regression, int left) {
    if (with_variance) return regression.estimates(own_s, left);
    std::vector<Estimate> result;
    for (const Vector2d& place : regression.places(own_s, left))
      result.push_back({place, Vector2d::Zero()});
    return result;
  };
  const std::vector<Estimate> pelvis_estimates = of(pelvis, 0);
  for (std::size_t i = 0; i < times_s.size(); ++i)
    estimates[i][index(BodyPart::pelvis)] = pelvis_estimates[i];
  const auto add = [&](const Group& group, const GaitKernel& kernel) {
    const auto legs = leg_regression(group, kernel, samples_of(group, observations, prior.origin_s),
                                     path, prior.size_px);
    if (!legs) return;
    for (int left = 0; left <= (group.paired() ? 1 : 0); ++left) {
      const std::vector<Estimate> relative = of(*legs, left);
      for (std::size_t i = 0; i < times_s.size(); ++i) {
        Estimate& estimate = estimates[i][index(left ? group.left : group.right)];
        estimate.p_px = pelvis_estimates[i].p_px + relative[i].p_px;
        estimate.variance_px2 = pelvis_estimates[i].variance_px2 + relative[i].variance_px2;
      }
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

/// −log likelihood of knees and ankles relative to the pelvis, without constants.
double negative_log_likelihood(const GaitPrior& prior, const Observations& observations) {
  const Regression pelvis(
      prior.trunk,
      centred(kPelvis, samples_of(kPelvis, observations, prior.origin_s), prior.size_px));
  const PelvisPath path(pelvis, observations, prior.origin_s);
  double sum = 0;
  for (const Group& group : {kLegGroups[0], kLegGroups[1]})
    if (const auto legs =
            leg_regression(group, prior.legs, samples_of(group, observations, prior.origin_s), path,
                           prior.size_px))
      sum += legs->negative_log_likelihood();
  return sum;
}

/// The middle of a long clip: as much as one regression takes.
Observations middle_of(const Observations& observations, double origin_s) {
  double reach_s = 0;  // from the origin
  for (const auto& part : observations)
    for (const Observation& o : part) reach_s = std::max(reach_s, std::abs(o.time_s - origin_s));
  Observations some = observations;
  const auto most = [&] {
    std::size_t size = 0;
    for (const auto& part : some) size = std::max(size, part.size());
    return size;
  };
  while (most() > kMostTogether) {
    reach_s *= std::min(0.9, static_cast<double>(kMostTogether) / static_cast<double>(most()));
    some = between(some, origin_s - reach_s, origin_s + reach_s);
  }
  return some;
}

}  // namespace

GaitPrior with_period_of(const GaitPrior& prior, const Observations& all) {
  if (!prior.legs.periodic) return prior;
  const Observations observations = middle_of(all, prior.origin_s);
  GaitPrior best = prior;
  double least = negative_log_likelihood(best, observations);
  for (double step = 0.01; step > 0.0005; step /= 2)
    descend(
        best, least, 1 + step, 4,
        [](GaitPrior& next, double factor) {
          next.legs.period_s *= factor;
          next.trunk.period_s *= factor;
        },
        [&](const GaitPrior& next) { return negative_log_likelihood(next, observations); });
  return best;
}

Estimates estimate(const GaitPrior& prior, const Observations& observations,
                   const std::vector<double>& times_s, bool with_variance) {
  std::size_t most = 0;
  for (const auto& part : observations) most = std::max(most, part.size());
  if (most <= kMostTogether) return estimate_together(prior, observations, times_s, with_variance);

  // The cost is cubic, so a long clip is estimated in windows of two strides, each with the
  // observations of three more strides on either side.
  const double window_s = 2 * prior.legs.period_s, margin_s = 3 * prior.legs.period_s;
  Estimates estimates;
  for (std::size_t i = 0; i < times_s.size();) {
    std::size_t end = i;
    while (end < times_s.size() && times_s[end] < times_s[i] + window_s) ++end;
    const std::vector<double> window(times_s.begin() + static_cast<long>(i),
                                     times_s.begin() + static_cast<long>(end));
    const Observations seen =
        between(observations, window.front() - margin_s, window.back() + margin_s);
    const Estimates part = estimate_together(prior, seen, window, with_variance);
    estimates.insert(estimates.end(), part.begin(), part.end());
    i = end;
  }
  return estimates;
}

}  // namespace stride::gaussian_process
