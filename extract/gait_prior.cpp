#include "extract/gait_prior.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <optional>

namespace stride {
namespace {

using Eigen::MatrixXd;
using Eigen::Vector2d;
using Eigen::VectorXd;

constexpr std::size_t kMostTogether = 250;  // observations of a part in one regression
constexpr std::size_t kMostFitted = 40;     // clicks of a part that the kernels are fitted to

/// One or two body parts that are modelled together: a joint of both legs, or a part of the trunk.
struct Group {
  BodyPart right, left;  // the same for the trunk
  bool paired() const { return right != left; }
};

constexpr Group kPelvis{BodyPart::pelvis, BodyPart::pelvis};
constexpr std::array kLegGroups{
    Group{BodyPart::knee_r, BodyPart::knee_l}, Group{BodyPart::ankle_r, BodyPart::ankle_l},
    Group{BodyPart::toe_r, BodyPart::toe_l}, Group{BodyPart::hip_r, BodyPart::hip_l}};
constexpr Group kHead{BodyPart::head, BodyPart::head};

/// An observation of a group: `left` 0 or 1.
struct Sample {
  double time_s;
  int left;
  Vector2d p_px, variance_px2;
  double since_s = std::numeric_limits<double>::quiet_NaN();

  bool is_way() const { return !std::isnan(since_s); }
};

constexpr double kJitter = 1e-9;  // of the largest variance, against rounding

double periodic(double lag_s, double period_s, double roughness) {
  const double s = std::sin(std::numbers::pi * lag_s / period_s);
  return std::exp(-2 * s * s / (roughness * roughness));
}

double matern52(double lag, double length) {
  const double a = std::sqrt(5.0) * std::abs(lag) / length;
  return (1 + a + a * a / 3) * std::exp(-a);
}

/// Covariance of the integral of Brownian motion started at time 0 in either direction: its
/// regression curve is the cubic smoothing spline.
double integrated_walk(double t, double u) {
  if (t * u <= 0) return 0;
  const double a = std::min(std::abs(t), std::abs(u)), b = std::max(std::abs(t), std::abs(u));
  return a * a * (b / 2 - a / 6);
}

/// Covariance in units of the group's variance; times from the prior's origin.
struct Covariance {
  GaitKernel k;
  bool paired;
  double drift = 0;  // variance of the trunk's path, the camera's drift with it

  double operator()(double t, int t_left, double u, int u_left) const {
    const double lag = t - u, strides = lag / k.period_s;
    const double coherence =
        std::exp(-strides * strides / (2 * k.coherence_strides * k.coherence_strides));
    const double asymmetric =
        k.asymmetry * k.asymmetry * coherence * periodic(lag, k.period_s, k.roughness);
    if (!paired)
      return k.amplitude * k.amplitude *
                 (coherence * periodic(lag, k.period_s / 2, k.roughness) + asymmetric) +
             drift * (k.residual * k.residual * integrated_walk(t / k.period_s, u / k.period_s) +
                      10 * (1 + t * u / (k.period_s * k.period_s)));
    double sum = 4 + coherence * periodic(lag + 0.5 * k.period_s * (t_left - u_left), k.period_s,
                                          k.roughness);
    if (t_left == u_left)
      sum += 0.5 + asymmetric + k.residual * k.residual * matern52(strides, k.residual_strides);
    return sum;
  }
};

struct GroupData {
  Group group;
  std::vector<Sample> samples;
  Vector2d mean_px, scale_px;  // scale: standard deviation of the motion that repeats
  Vector2d drift;              // of the trunk: variance of its path, in units of the scale
};

/// How far a trunk moves about its path: a fraction of the leg. Were its scale taken from the
/// clicks, a camera's drift would pass for motion that repeats wherever the clicks' spacing allows.
constexpr double kTrunkSway = 0.015, kTrunkBob = 0.08, kDrift = 1.0;

GroupData centred(Group group, std::vector<Sample> samples, double size_px) {
  GroupData data{group, std::move(samples), Vector2d::Zero(), Vector2d::Zero(), Vector2d::Zero()};
  const auto places =
      std::ranges::count_if(data.samples, [](const Sample& s) { return !s.is_way(); });
  const double n = std::max(1.0, static_cast<double>(places));
  for (const Sample& s : data.samples)
    if (!s.is_way()) data.mean_px += s.p_px / n;
  for (Sample& s : data.samples) {
    if (s.is_way()) continue;
    s.p_px -= data.mean_px;
    data.scale_px += s.p_px.cwiseAbs2() / n;
  }
  if (group.paired()) {
    data.scale_px = data.scale_px.cwiseSqrt().cwiseMax(1);
  } else {
    data.scale_px = size_px * Vector2d(kTrunkSway, kTrunkBob);
    data.drift = (size_px * kDrift / data.scale_px.array()).square();
  }
  return data;
}

std::vector<Sample> samples_of(Group group, const Observations& observations, double origin_s) {
  std::vector<Sample> samples;
  for (const Observation& o : observations[index(group.right)])
    samples.push_back({o.time_s - origin_s, 0, o.p_px, o.variance_px2, o.since_s - origin_s});
  if (group.paired())
    for (const Observation& o : observations[index(group.left)])
      samples.push_back({o.time_s - origin_s, 1, o.p_px, o.variance_px2, o.since_s - origin_s});
  return samples;
}

/// Covariance of a place at a time with a sample.
double covariance_with(const Covariance& c, double time_s, int left, const Sample& s) {
  const double with_end = c(time_s, left, s.time_s, s.left);
  return s.is_way() ? with_end - c(time_s, left, s.since_s, s.left) : with_end;
}

MatrixXd covariance_matrix(const Covariance& covariance, const std::vector<Sample>& samples) {
  const auto n = static_cast<Eigen::Index>(samples.size());
  MatrixXd matrix(n, n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const Sample& s = samples[i];
    for (Eigen::Index j = 0; j <= i; ++j) {
      double c = covariance_with(covariance, s.time_s, s.left, samples[j]);
      if (s.is_way()) c -= covariance_with(covariance, s.since_s, s.left, samples[j]);
      matrix(i, j) = matrix(j, i) = c;
    }
  }
  return matrix;
}

VectorXd coordinate(const GroupData& data, int axis) {
  VectorXd y(static_cast<Eigen::Index>(data.samples.size()));
  for (Eigen::Index i = 0; i < y.size(); ++i)
    y(i) = data.samples[i].p_px[axis] / data.scale_px[axis];
  return y;
}

/// The covariance of each coordinate; the same for both unless the trunk drifts.
std::array<Covariance, 2> covariances(const GaitKernel& kernel, const GroupData& data) {
  const bool paired = data.group.paired();
  return {Covariance{kernel, paired, data.drift.x()}, Covariance{kernel, paired, data.drift.y()}};
}

std::array<MatrixXd, 2> covariance_matrices(const GaitKernel& kernel, const GroupData& data) {
  const auto [x, y] = covariances(kernel, data);
  const MatrixXd first = covariance_matrix(x, data.samples);
  return {first, data.group.paired() ? first : covariance_matrix(y, data.samples)};
}

/// Joints clicked on the same frames have the same covariance.
bool same_times(const GroupData& a, const GroupData& b) {
  return std::ranges::equal(a.samples, b.samples, [](const Sample& s, const Sample& t) {
    return s.time_s == t.time_s && s.left == t.left;
  });
}

/// −log of the probability of the samples, without constants.
double surprise(const GaitKernel& kernel, const std::vector<GroupData>& groups) {
  double sum = 0;
  std::array<MatrixXd, 2> matrices;
  const GroupData* before = nullptr;
  for (const GroupData& data : groups) {
    if (before == nullptr || !same_times(*before, data))
      matrices = covariance_matrices(kernel, data);
    before = &data;
    for (int axis = 0; axis < 2; ++axis) {
      MatrixXd noisy = matrices[axis];
      noisy.diagonal().array() += std::pow(kernel.noise_px / data.scale_px[axis], 2) +
                                  kJitter * noisy.diagonal().maxCoeff();
      const Eigen::LLT<MatrixXd> factor(noisy);
      if (factor.info() != Eigen::Success) return std::numeric_limits<double>::infinity();
      const VectorXd white = factor.matrixL().solve(coordinate(data, axis));
      const auto lower = factor.matrixLLT().diagonal();
      sum += 0.5 * white.squaredNorm() + lower.array().log().sum();
    }
  }
  return sum;
}

/// A hyperparameter: where it is expected (log-normal) for legs and trunk, and allowed.
struct Expected {
  double value, spread;
};
struct Hyperparameter {
  double GaitKernel::*member;
  Expected legs, trunk;
  double low, high;
};
constexpr std::array kHyperparameters{
    Hyperparameter{&GaitKernel::period_s, {0.75, 0.25}, {0.75, 0.25}, 0.4, 2.2},
    Hyperparameter{&GaitKernel::amplitude, {1, 1}, {1, 0.4}, 0.02, 20},
    Hyperparameter{&GaitKernel::roughness, {0.75, 0.25}, {1.0, 0.3}, 0.2, 2},
    Hyperparameter{&GaitKernel::coherence_strides, {20, 1}, {20, 1}, 1, 100},
    Hyperparameter{&GaitKernel::asymmetry, {0.2, 0.7}, {0.2, 0.7}, 0.01, 1},
    Hyperparameter{&GaitKernel::residual, {0.1, 1}, {0.5, 1}, 0.01, 20},
    Hyperparameter{&GaitKernel::residual_strides, {0.15, 0.3}, {0.15, 0.3}, 0.05, 0.6},
    Hyperparameter{&GaitKernel::noise_px, {0.7, 0.7}, {0.7, 0.7}, 0.05, 20}};

double cost(const GaitKernel& kernel, const std::vector<GroupData>& groups) {
  double sum = 0;
  const bool legs = groups.front().group.paired();
  for (const Hyperparameter& h : kHyperparameters) {
    const double value = kernel.*h.member;
    if (value < h.low || value > h.high) return std::numeric_limits<double>::infinity();
    const Expected& expected = legs ? h.legs : h.trunk;
    sum += 0.5 * std::pow(std::log(value / expected.value) / expected.spread, 2);
  }
  return sum + surprise(kernel, groups);
}

struct Fitted {
  GaitKernel kernel;
  double cost;
};

/// Pattern search in the logarithms, one hyperparameter after another.
Fitted refined(Fitted best, const std::vector<GroupData>& groups, int rounds) {
  const bool legs = groups.front().group.paired();
  double step = 1.8;
  for (int round = 0; round < rounds; ++round, step = std::sqrt(step))
    for (const Hyperparameter& h : kHyperparameters) {
      const bool is_period = h.member == &GaitKernel::period_s;
      if (is_period && !legs) continue;  // the trunk takes the legs'
      const double factor = is_period ? 1 + 0.02 * (step - 1) : step;
      for (const double f : {factor, 1 / factor}) {
        Fitted next = best;
        int moves = 0;
        for (; moves < 3; ++moves) {
          next.kernel.*h.member *= f;
          next.cost = cost(next.kernel, groups);
          if (next.cost >= best.cost) break;
          best = next;
        }
        if (moves > 0) break;
      }
    }
  return best;
}

/// Between clicks of one side. A stride that hardly more than one click saw cannot be told from
/// others.
double median_spacing_s(const std::vector<Sample>& samples) {
  std::vector<double> spacings;
  for (std::size_t i = 1; i < samples.size(); ++i)
    if (samples[i].left == samples[i - 1].left)
      spacings.push_back(samples[i].time_s - samples[i - 1].time_s);
  if (spacings.empty()) return 0;
  const auto middle = spacings.begin() + static_cast<long>(spacings.size() / 2);
  std::ranges::nth_element(spacings, middle);
  return *middle;
}

/// The best kernels of a scan over the period, refined: the likelihood has a peak at every alias of
/// the clicks' spacing.
Fitted fitted(const std::vector<GroupData>& groups) {
  std::vector<Fitted> scan;
  const double shortest_s = std::clamp(1.6 * median_spacing_s(groups.front().samples), 0.4, 1.2);
  for (double period_s = shortest_s; period_s < 1.7; period_s *= 1.015) {
    GaitKernel kernel;
    kernel.period_s = period_s;
    scan.push_back({kernel, cost(kernel, groups)});
  }
  std::vector<Fitted> peaks;
  for (std::size_t i = 0; i < scan.size(); ++i)
    if ((i == 0 || scan[i].cost <= scan[i - 1].cost) &&
        (i + 1 == scan.size() || scan[i].cost < scan[i + 1].cost))
      peaks.push_back(scan[i]);
  const auto cheaper = [](const Fitted& a, const Fitted& b) { return a.cost < b.cost; };
  std::ranges::sort(peaks, cheaper);
  if (peaks.size() > 6) peaks.resize(6);
  for (Fitted& peak : peaks) peak = refined(peak, groups, 1);
  std::ranges::sort(peaks, cheaper);
  if (peaks.size() > 2) peaks.resize(2);
  for (Fitted& peak : peaks) peak = refined(peak, groups, 4);
  return *std::ranges::min_element(peaks, cheaper);
}

/// Every sample relative to the pelvis at its time.
std::vector<Sample> relative(std::vector<Sample> samples, const std::vector<Vector2d>& pelvis_px) {
  for (std::size_t i = 0; i < samples.size(); ++i) samples[i].p_px -= pelvis_px[i];
  return samples;
}

/// Regression of one group at times (from the origin), for one side.
struct Regression {
  GroupData data;
  std::array<Covariance, 2> covariance;
  std::array<Eigen::LLT<MatrixXd>, 2> factor;
  std::array<VectorXd, 2> weights;

  Regression(const GaitKernel& kernel, GroupData group_data)
      : data(std::move(group_data)), covariance(covariances(kernel, data)) {
    auto matrices = covariance_matrices(kernel, data);
    for (int axis = 0; axis < 2; ++axis) {
      MatrixXd& noisy = matrices[axis];
      const double unit = data.scale_px[axis] * data.scale_px[axis];
      for (Eigen::Index i = 0; i < noisy.rows(); ++i)
        noisy(i, i) += data.samples[i].variance_px2[axis] / unit + kJitter * noisy(i, i);
      factor[axis].compute(noisy);
      weights[axis] = factor[axis].solve(coordinate(data, axis));
    }
  }

  Vector2d place(double time_s, int left) const {
    Vector2d p_px;
    VectorXd c;
    for (int axis = 0; axis < 2; ++axis) {
      if (axis == 0 || !data.group.paired()) c = with_samples(covariance[axis], time_s, left);
      p_px[axis] = data.mean_px[axis] + data.scale_px[axis] * c.dot(weights[axis]);
    }
    return p_px;
  }

  Estimate at(double time_s, int left) const {
    Estimate estimate;
    VectorXd c;
    for (int axis = 0; axis < 2; ++axis) {
      if (axis == 0 || !data.group.paired()) c = with_samples(covariance[axis], time_s, left);
      const double scale = data.scale_px[axis];
      estimate.p_px[axis] = data.mean_px[axis] + scale * c.dot(weights[axis]);
      const double own = covariance[axis](time_s, left, time_s, left);
      const VectorXd white = factor[axis].matrixL().solve(c);
      estimate.variance_px2[axis] = std::max(0.0, scale * scale * (own - white.squaredNorm()));
    }
    return estimate;
  }

  /// Sample i minus what the regression makes of it.
  Vector2d residual_px(std::size_t i) const {
    Vector2d residual;
    for (int axis = 0; axis < 2; ++axis)
      residual[axis] = data.samples[i].variance_px2[axis] / data.scale_px[axis] *
                       weights[axis](static_cast<Eigen::Index>(i));
    return residual;
  }

  VectorXd with_samples(const Covariance& function, double time_s, int left) const {
    VectorXd c(static_cast<Eigen::Index>(data.samples.size()));
    for (Eigen::Index i = 0; i < c.size(); ++i)
      c(i) = covariance_with(function, time_s, left, data.samples[i]);
    return c;
  }
};

std::vector<Sample> with_noise(std::vector<Sample> samples, double noise_px) {
  for (Sample& s : samples) s.variance_px2.setConstant(noise_px * noise_px);
  return samples;
}

std::vector<Vector2d> pelvis_at(const Regression& pelvis, const std::vector<Sample>& samples) {
  std::vector<Vector2d> points;
  points.reserve(samples.size());
  for (const Sample& s : samples) {
    points.push_back(pelvis.at(s.time_s, 0).p_px);
    if (s.is_way()) points.back() -= pelvis.at(s.since_s, 0).p_px;
  }
  return points;
}

std::vector<GroupData> leg_data(const Observations& clicks, double origin_s,
                                const Regression& pelvis, double size_px) {
  std::vector<GroupData> groups;
  for (const Group& group : kLegGroups) {
    if (groups.size() == 2) break;  // knees and ankles say enough
    const auto samples = samples_of(group, clicks, origin_s);
    if (samples.size() >= 4)
      groups.push_back(centred(group, relative(samples, pelvis_at(pelvis, samples)), size_px));
  }
  return groups;
}

/// Fewer clicks where there are many, as of a detector: enough for the kernels, at most ten a
/// second or so, from the middle of the clip.
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

/// Rms distance of knees, ankles and toes from the pelvis clicked at the same time.
double leg_size_px(const Observations& clicks) {
  double squared = 0;
  int n = 0;
  for (const Observation& pelvis : clicks[index(BodyPart::pelvis)])
    for (const Group& group : kLegGroups)
      for (const BodyPart part : {group.right, group.left})
        for (const Observation& o : clicks[index(part)])
          if (part != BodyPart::hip_r && part != BodyPart::hip_l && o.time_s == pelvis.time_s) {
            squared += (o.p_px - pelvis.p_px).squaredNorm();
            ++n;
          }
  return n > 0 ? std::max(std::sqrt(squared / n), 10.0) : 90;
}

}  // namespace

GaitPrior fit_gait_prior(const Observations& all_clicks) {
  const Observations clicks = thinned(all_clicks);
  GaitPrior prior;
  double first = std::numeric_limits<double>::infinity(), last = -first;
  for (const auto& part : clicks)
    for (const Observation& o : part) {
      first = std::min(first, o.time_s);
      last = std::max(last, o.time_s);
    }
  prior.origin_s = (first + last) / 2;

  prior.size_px = leg_size_px(clicks);

  // The pelvis at first by a nearly free spline, then by the period that the legs show.
  prior.trunk.residual = 1;
  const auto pelvis = samples_of(kPelvis, clicks, prior.origin_s);
  const auto pelvis_regression = [&] {
    return Regression(prior.trunk,
                      centred(kPelvis, with_noise(pelvis, prior.trunk.noise_px), prior.size_px));
  };
  auto legs = leg_data(clicks, prior.origin_s, pelvis_regression(), prior.size_px);
  if (legs.empty()) return prior;
  Fitted fit = fitted(legs);
  prior.trunk = GaitKernel();
  prior.trunk.period_s = fit.kernel.period_s;
  const std::vector<GroupData> trunk{centred(kPelvis, pelvis, prior.size_px)};
  prior.trunk = refined({prior.trunk, cost(prior.trunk, trunk)}, trunk, 5).kernel;
  legs = leg_data(clicks, prior.origin_s, pelvis_regression(), prior.size_px);
  prior.legs = refined({fit.kernel, cost(fit.kernel, legs)}, legs, 4).kernel;
  prior.trunk.period_s = prior.legs.period_s;
  return prior;
}

namespace {

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
      for (std::size_t i = 0; i < legs->data.samples.size(); ++i) {
        const Sample& s = legs->data.samples[i];
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
