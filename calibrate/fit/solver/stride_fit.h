#pragma once

#include <Eigen/Core>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "calibrate/fit/solver/marks.h"
#include "calibrate/runner/runner.h"

namespace stride::fit {

/// What is known of a quantity before the clip is seen: a normal distribution.
struct Prior {
  double mean = 0, sd = 0;
};

/// How the fit is made. Pixels know no metres: the length of the runner's legs gives them.
struct FitOptions {
  /// Hip to ankle at a straight knee, relative sd. Default: the mean of Drillis and Contini 1966
  /// (0.491 of the height) and of two measured runners (0.476, Rajagopal 2016; Hamner 2010) times
  /// 1.76 m, the mean height of the 28 runners of Fukuchi et al. 2017; 4.5 % covers both spreads.
  Prior leg_m{0.850, 0.045};
  std::optional<double> metres_per_pixel;  // in the middle of the clip: known exactly
  Prior roll_rad{0, 0.035};                // of the ground in the image as it is, clockwise < 0
  int harmonics = 0;                       // 0: chosen by the data, from 2 to kMaxHarmonics
  /// How well a person marks a joint, of a leg's length: no mark is believed to be better, however
  /// smooth the track through it is.
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

/// How one mark agrees with the fit.
struct MarkResidual {
  Eigen::Vector2d r_px = Eigen::Vector2d::Zero();  // mark − fit, in the runner's turned image
  bool outlier = false;                            // not believed
};

/// A runner fitted to a clip. Failure is a value: `ok` false with `failure`.
struct StrideFit {
  bool ok = false;
  std::string failure;
  Runner runner;
  int harmonics = 0;
  bool toes_seen = false, head_seen = false;
  bool backward = false;  // knees bend forward: the clip is seen the other way round
  std::vector<Eigen::Vector2d> pelvis_px;  // of every frame
  VerticalOscillation vertical_oscillation;

  double explained = 0;    // of the first guess: see StridePeriod
  double sigma_px = 0;     // robust standard deviation of a mark of confidence 1
  double correlation = 1;  // frames that say as much as one independent one
  double rms_px = 0;       // of the marks that are believed
  double outlier_fraction = 0;
  std::vector<MarkResidual> marks;  // of Marks::points
  int iterations = 0;               // of all solves

  /// Of `flattened(runner)`; zero where a parameter was not free.
  Eigen::MatrixXd covariance;

  double period_sd_s() const;
  double scale_relative_sd() const;
  double roll_sd_rad() const;
};

/// Standard deviations of what is computed from a fit, by the covariance of its runner.
Eigen::VectorXd propagated_sd(const StrideFit& fit,
                              const std::function<Eigen::VectorXd(const StrideFit&)>& values);

/// The blocks of a runner, one after another.
Eigen::VectorXd flattened(const Runner& runner);
Runner unflattened(const Eigen::VectorXd& values);

/// Where a part of the runner is from its marked pelvis, px.
Eigen::Vector2d about_pelvis_px(const StrideFit& fit, const Directions& directions, BodyPart part,
                                double u_s);

/// Where a part of the runner is in the image of frame `frame`, px as Mark::z_px.
Eigen::Vector2d predicted_px(const StrideFit& fit, const Directions& directions, BodyPart part,
                             int frame, double u_s);

}  // namespace stride::fit
