#pragma once

#include <filesystem>
#include <map>
#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "calibrate/calibrate.h"

namespace stride::page {

/// A clip with everything that is known about it.
struct CalibratedClip {
  std::filesystem::path video;
  Trajectory trajectory;
  SagittalModel model;
  Calibration calibration;
  std::map<int, cv::Mat> frames;  // by their number in the video: those that are shown
};

/// Indices into Trajectory::frames of those that moments_section shows.
std::vector<int> shown_moments(const CalibratedClip& clip);

/// The frames behind period and speed, or of a jump its flight, each with the fitted legs. Needs
/// them in `frames`.
std::string moments_section(const CalibratedClip& clip);

/// Hip to ankle of the fitted runner, px.
double leg_of(const Calibration& calibration);

/// A square window around a point, what lies outside the frame in grey; and an image as a data URI.
cv::Mat window(const cv::Mat& image, const Eigen::Vector2d& middle_px, double side_px);
std::string jpeg_uri(const cv::Mat& image);

}  // namespace stride::page
