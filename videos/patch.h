#pragma once

#include <Eigen/Core>
#include <functional>
#include <vector>

#include "videos/colour.h"
#include "videos/pinhole_camera.h"

namespace stride::videos {

/// Half-widths of a body at a position along its axis, m. `front + back` > 0; one may be negative.
struct Station {
  double s = 0, front = 0, back = 0;
};

/// A part of the runner: a rounded body around an axis in a plane z = const, shaded as if round.
struct Patch {
  Eigen::Vector2d origin;       // x, y, m
  Eigen::Vector2d axis, front;  // unit vectors
  double z_m = 0;
  std::vector<Station> stations;              // ascending s, m along the axis from the origin
  bool round_start = true, round_end = true;  // else cut off square, as a hem
  /// Colour at `s` m along the axis and `across`, -1 at the back … 1 at the front.
  std::function<Colour(double s, double across)> colour;
  double light = 1;            // < 1: further from the light
  double gloss = 0;            // strength of the highlight
  double roundness = 1;        // 0: flat as a cut-out
  double end_roundness = 0.2;  // the same of the rounded ends, small where another patch goes on
  double outline_m = 0;        // > 0: a line around the group
  int group = 0;               // patches of one group follow each other and share an outline
};

/// Paints patches in order on a float image, with one sample of each pixel at (u + du, v + dv).
void paint(const std::vector<Patch>& patches, const PinholeCamera& camera, double du, double dv,
           cv::Mat& image);

}  // namespace stride::videos
