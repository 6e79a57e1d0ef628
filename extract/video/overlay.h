#pragma once

#include <filesystem>
#include <opencv2/core/mat.hpp>

#include "extract/skeleton/trajectory.h"

namespace stride::video {

struct OverlayStyle {
  bool near_is_right = true;  // the leg that is drawn bright and on top
  double scale = 1;           // of lines and dots; 1 suits 640×360
  double trail_s = 0.5;       // of the ankles over the ground; 0: none
};

/// Draws the points of `trajectory.frames[i]` on a BGR image of that frame: the far leg in blue,
/// the near leg in orange, trunk and head in white. The less confident, the fainter: a joint is a
/// disc with a white middle where it was clicked, a disc where the picture showed it, a ring where
/// only the gait speaks (confidence up to 0.3). Behind the ankles goes the way that they went over
/// the ground, as the background moved.
void draw_points(cv::Mat& image, const Trajectory& trajectory, std::size_t i,
                 const OverlayStyle& style);

/// The style for a clip: near leg from the direction of travel (a camera that stands on the
/// runner's right sees it run to the right), size from the frame.
OverlayStyle overlay_style(const Trajectory& trajectory);

/// The whole video with the points drawn on it, as .mp4. Throws Error as Video and VideoWriter do.
void write_overlay(const std::filesystem::path& video, const Trajectory& trajectory,
                   const std::filesystem::path& out);

}  // namespace stride::video
