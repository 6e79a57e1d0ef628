#pragma once

#include <Eigen/Core>
#include <array>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "calibrate/fit/solver/marks.h"
#include "calibrate/runner/runner.h"

namespace stride::fit {

/// A normal prior on a quantity.
struct Prior {
  double mean = 0, sd = 0;
};

/// A scale that was measured at one moment: a calibration line's.
struct MeasuredScale {
  double metres_per_pixel = 0, relative_sd = 0;
  double u_s = 0;  // from the middle of the clip
};

/// Options of the fit. The length of the runner's legs sets the scale.
struct FitOptions {
  /// Hip to ankle at a straight knee, relative sd. Default: the mean of Drillis and Contini 1966
  /// (0.491 of the height) and of two measured runners (0.476, Rajagopal 2016; Hamner 2010) times
  /// 1.76 m, the mean height of the 28 runners of Fukuchi et al. 2017; 4.5 % covers both spreads.
  Prior leg_m{0.850, 0.045};
  std::optional<double> metres_per_pixel;  // in the middle of the clip: known exactly
  bool size_given = false;  // by a person: leg_m or metres_per_pixel is of this runner
  std::optional<MeasuredScale> measured_scale;  // instead of leg_m
  Prior roll_rad{0, 0.035};  // of the ground in the image as it is, clockwise < 0
  int harmonics = 0;         // 0: chosen by the data, from 2 to kMaxHarmonics
  /// Standard deviation of a person's click in leg lengths: a lower bound for every point, however
  /// smooth the track is.
  double mark_sd = 0.015;
  bool numeric_derivatives = false;  // instead of automatic ones: for the benchmark
};

/// The part of the pelvis' height that repeats at every half stride, seen in the image:
/// h(φ) = c[0] cos 4πφ + c[1] sin 4πφ + c[2] cos 8πφ + c[3] sin 8πφ, m of the runner.
struct VerticalOscillation {
  Eigen::Vector4d c = Eigen::Vector4d::Zero();
  Eigen::Matrix4d covariance = Eigen::Matrix4d::Zero();

  double operator()(double phase) const { return weights(phase).dot(c); }
  static Eigen::Vector4d weights(double phase);
  double peak_to_peak_m() const;
};

/// The residual of one labelled point.
struct MarkResidual {
  Eigen::Vector2d r_px = Eigen::Vector2d::Zero();  // mark − fit, in the runner's turned image
  bool outlier = false;                            // excluded by Tukey's loss
};

/// A runner fitted to a clip. Failure is a value: `ok` false with `failure`.
struct StrideFit {
  bool ok = false;
  std::string failure;
  Runner runner;
  int harmonics = 0;
  bool toes_seen = false, head_seen = false, heels_seen = false;
  std::array<double, heel::size> heel{};   // where the seen heels are
  bool backward = false;                   // knees bend forward: the clip is mirrored
  std::vector<Eigen::Vector2d> pelvis_px;  // of every frame
  VerticalOscillation vertical_oscillation;

  double explained = 0;    // of the first guess: see StridePeriod
  double sigma_px = 0;     // robust standard deviation of a mark of confidence 1
  double correlation = 1;  // number of frames equivalent to one independent frame
  double rms_px = 0;       // of the inliers
  double outlier_fraction = 0;
  std::vector<MarkResidual> marks;  // of Marks::points
  int iterations = 0;               // of all solves

  /// Covariance of `flattened(runner)`; zero for fixed parameters.
  Eigen::MatrixXd covariance;

  double period_sd_s() const;
  double scale_relative_sd() const;
  double roll_sd_rad() const;
};

/// Standard deviations of functions of the fit, from the covariance of its parameters.
Eigen::VectorXd propagated_sd(const StrideFit& fit,
                              const std::function<Eigen::VectorXd(const StrideFit&)>& values);

/// The blocks of a runner, one after another.
Eigen::VectorXd flattened(const Runner& runner);
Runner unflattened(const Eigen::VectorXd& values);

/// Position of a part relative to the labelled pelvis, px.
Eigen::Vector2d about_pelvis_px(const StrideFit& fit, const Directions& directions, BodyPart part,
                                double u_s);

/// Position of a part in the image of frame `frame`, px as Mark::z_px.
Eigen::Vector2d predicted_px(const StrideFit& fit, const Directions& directions, BodyPart part,
                             int frame, double u_s);

}  // namespace stride::fit
