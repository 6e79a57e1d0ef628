#include "extract/tracking/gaussian_process/joint.h"

#include <Eigen/Cholesky>
#include <array>
#include <cmath>
#include <limits>
#include <map>

#include "extract/tracking/gaussian_process/hyperparameters.h"
#include "extract/tracking/gaussian_process/kernel.h"
#include "extract/tracking/gaussian_process/regression.h"

namespace stride::gaussian_process {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// The distinct times of all samples, and the index of each sample's times.
struct Times {
  Instants instants;
  std::vector<Index> of_sample;
};
Times times_of(const JointData& data) {
  Times times;
  std::map<double, Index> known;
  const auto add = [&](const GroupData& group) {
    for (const Sample& s : group.samples)
      times.of_sample.push_back(
          known.try_emplace(s.time_s, static_cast<Index>(known.size())).first->second);
  };
  add(data.pelvis);
  for (const GroupData& group : data.legs) add(group);
  times.instants.time_s.resize(static_cast<Index>(known.size()));
  times.instants.left.setZero(static_cast<Index>(known.size()));
  for (const auto& [time_s, i] : known) times.instants.time_s[i] = time_s;
  return times;
}

}  // namespace

double negative_log_likelihood(const GaitPrior& prior, const JointData& data) {
  const Times times = times_of(data);
  const auto n = static_cast<Index>(times.of_sample.size());
  std::vector<MatrixXd> own;  // of each joint, in units of its scale
  for (const GroupData& group : data.legs) own.push_back(covariance_matrices(prior.legs, group)[0]);
  double sum = 0;
  for (int axis = 0; axis < 2; ++axis) {
    const Covariance pelvis{prior.trunk, false, data.pelvis.drift[axis]};
    const MatrixXd of_pelvis =
        std::pow(data.pelvis.scale_px[axis], 2) * pelvis(times.instants, times.instants);
    MatrixXd all(n, n);
    for (Index j = 0; j < n; ++j)
      for (Index i = 0; i < n; ++i)
        all(i, j) = of_pelvis(times.of_sample[static_cast<std::size_t>(i)],
                              times.of_sample[static_cast<std::size_t>(j)]);
    VectorXd y(n);
    Index at = 0;
    const auto add = [&](const GroupData& group, double noise_px) {
      const auto m = static_cast<Index>(group.samples.size());
      for (const Sample& s : group.samples) y[at++] = s.p_px[axis];
      all.diagonal().segment(at - m, m).array() += noise_px * noise_px;
    };
    add(data.pelvis, prior.trunk.noise_px);
    for (std::size_t g = 0; g < data.legs.size(); ++g) {
      const Index m = own[g].rows();
      all.block(at, at, m, m) += std::pow(data.legs[g].scale_px[axis], 2) * own[g];
      add(data.legs[g], prior.legs.noise_px);
    }
    all.diagonal() *= 1 + kJitter;
    const Eigen::LLT<MatrixXd> factor(all);
    if (factor.info() != Eigen::Success) return std::numeric_limits<double>::infinity();
    sum += 0.5 * factor.matrixL().solve(y).squaredNorm() +
           factor.matrixLLT().diagonal().array().log().sum();
  }
  return sum;
}

GaitPrior refined_together(const GaitPrior& prior, const JointData& data, int rounds) {
  enum Kernels { legs = 1, trunk = 2, both = 3 };
  struct Hyperparameter {
    double GaitKernel::*member;
    Kernels kernels;
    int most_moves;
  };
  constexpr std::array kRefined{Hyperparameter{&GaitKernel::residual, trunk, 3},
                                Hyperparameter{&GaitKernel::amplitude, trunk, 3},
                                Hyperparameter{&GaitKernel::length_scale, trunk, 3},
                                Hyperparameter{&GaitKernel::residual, legs, 3},
                                Hyperparameter{&GaitKernel::residual_strides, legs, 3},
                                Hyperparameter{&GaitKernel::asymmetry, legs, 3},
                                Hyperparameter{&GaitKernel::length_scale, legs, 3},
                                Hyperparameter{&GaitKernel::noise_px, both, 6},
                                Hyperparameter{&GaitKernel::period_s, both, 3}};
  const auto cost = [&](const GaitPrior& p) {
    const double sum = improbability(p.legs, true) + improbability(p.trunk, false);
    return std::isfinite(sum) ? sum + negative_log_likelihood(p, data) : sum;
  };
  GaitPrior best = prior;
  double least = cost(best), step = 1.8;
  for (int round = 0; round < rounds; ++round, step = std::sqrt(step))
    for (const Hyperparameter& h : kRefined)
      descend(
          best, least, h.member == &GaitKernel::period_s ? 1 + 0.02 * (step - 1) : step,
          h.most_moves,
          [&](GaitPrior& next, double factor) {
            if (h.kernels & legs) next.legs.*h.member *= factor;
            if (h.kernels & trunk) next.trunk.*h.member *= factor;
          },
          cost);
  return best;
}

}  // namespace stride::gaussian_process
