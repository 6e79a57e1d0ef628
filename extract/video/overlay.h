#pragma once

#include <filesystem>
#include <opencv2/core/mat.hpp>

#include "extract/skeleton/trajectory.h"

namespace stride::video {

struct OverlayStyle {
  bool near_is_right = true;  // the leg that is drawn on top
  double scale = 1;           // of lines and dots; 1 suits 640×360
  double trail_s = 0.5;       // of the ankles over the ground; 0: none
};

/// Draws the points of `trajectory.frames[i]` on a BGR image of that frame: far leg blue, near leg
/// orange, trunk and head white, opacity by confidence. A joint is a disc with a white centre where
/// it was clicked, a disc where optical flow followed it, a ring where only the gait prior speaks
/// (confidence up to 0.3). Trails show the paths of the ankles over the ground, by the motion of
/// the background.
void draw_points(cv::Mat& image, const Trajectory& trajectory, std::size_t i,
                 const OverlayStyle& style);

/// The style for a clip: near leg from the direction of travel (a camera that stands on the
/// runner's right sees it run to the right), size from the frame.
OverlayStyle overlay_style(const Trajectory& trajectory);

/// The whole video with the points drawn on it, as .mp4. Throws Error as Video and VideoWriter do.
void write_overlay(const std::filesystem::path& video, const Trajectory& trajectory,
                   const std::filesystem::path& out);

}  // namespace stride::video
