#pragma once

#include <filesystem>

#include "extract/io/table.h"
#include "extract/skeleton/keypoints.h"
#include "extract/skeleton/trajectory.h"
#include "videos/clip.h"

namespace stride::videos {

/// Projected positions of the parts in every frame, px.
Trajectory truth_px(const Clip& clip);

/// The same in metres with the joint angles: `# stride truth 1`. Metadata: source, period_s,
/// speed_m_s, metres_per_pixel, camera_roll_rad, direction, thigh_m, shank_m; of a jump movement,
/// take_off_s, landing_s and its duration as period_s. Columns: frame,
/// time_s, phase (0 = right foot strike), metres_per_pixel, the nine coordinates by OpenSim's
/// names (rad, m; pelvis_tx, pelvis_ty of the midpoint of the hips above the ground), and
/// <part>_x, <part>_y of every part from the midpoint of the hips, x the way of running, y up.
Table truth_m(const Clip& clip);

/// Simulated clicks at the paper's rate, four positions a half step, eight a stride, in a jump as
/// many a second as in a stride of 0.69 s, with normal
/// noise of clip.click_sd_px; the required parts and the toes, in a jump also the head.
Keypoints clicks(const Clip& clip);

/// Writes NAME.truth.csv, NAME.truth_m.csv and NAME.keypoints.json beside the video.
void write_truth(const Clip& clip, const std::filesystem::path& video);

}  // namespace stride::videos
