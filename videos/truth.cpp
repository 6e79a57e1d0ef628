#include "videos/truth.h"

#include <fmt/format.h>

#include <cmath>

#include "extract/io/file.h"
#include "extract/io/random.h"

namespace stride::videos {
namespace {

constexpr int kClicksPerStride = 8;
constexpr double kUsualStride_s = 0.69;

Facing facing(const Clip& clip) { return clip.to_left ? Facing::left : Facing::right; }

/// To so many decimals, so that files stay short.
double rounded(double value, double decimals) {
  const double scale = std::pow(10, decimals);
  return std::round(value * scale) / scale;
}

}  // namespace

Trajectory truth_px(const Clip& clip) {
  const Motion motion(clip);
  Trajectory trajectory;
  trajectory.video = clip.name + ".mp4";
  trajectory.width_px = clip.width_px;
  trajectory.height_px = clip.height_px;
  trajectory.rate_hz = clip.rate_hz * clip.slow_motion;
  trajectory.direction = facing(clip);
  if (clip.jump) trajectory.movement = "jump";
  for (int i = 0; i < clip.frames; ++i) {
    TrajectoryFrame& frame = trajectory.frames.emplace_back();
    frame.frame = i;
    frame.time_s = clip.time_s(i);
    const Skeleton skeleton = motion.skeleton(frame.time_s);
    const PinholeCamera camera = motion.camera(frame.time_s);
    for (const BodyPart part : kAskedParts)
      frame[part] = {camera.project(skeleton[part]), Source::clicked, 1};
  }
  return trajectory;
}

Table truth_m(const Clip& clip) {
  const Motion motion(clip);
  Table table;
  table.format = "truth";
  table.set_meta("unit", "m, rad");
  table.set_meta("video", clip.name + ".mp4");
  table.set_meta("source", clip.jump ? clip.jump->source() : clip.gait.source);
  table.set_meta("direction", std::string(kFacings[facing(clip)]));
  const auto number = [&](const char* key, double value) {
    table.set_meta(key, fmt::format("{}", value));
  };
  number("period_s", clip.jump ? clip.jump->duration_s() : clip.gait.period_s);
  if (clip.jump) {
    table.set_meta("movement", "jump");
    number("take_off_s", clip.stands_first_s + clip.jump->take_off_s());
    number("landing_s", clip.stands_first_s + clip.jump->landing_s());
  }
  number("speed_m_s", motion.speed_m_s());
  number("metres_per_pixel", motion.camera(clip.duration_s() / 2).metres_per_pixel());
  number("camera_roll_rad", clip.camera.roll_rad);
  number("thigh_m", clip.proportions.thigh);
  number("shank_m", clip.proportions.shank);
  table.columns = {"frame",        "time_s",        "phase",         "metres_per_pixel",
                   "pelvis_tilt",  "pelvis_tx",     "pelvis_ty",     "hip_flexion_r",
                   "knee_angle_r", "ankle_angle_r", "hip_flexion_l", "knee_angle_l",
                   "ankle_angle_l"};
  for (const BodyPart part : kAskedParts)
    for (const char* axis : {"x", "y"})
      table.columns.push_back(fmt::format("{}_{}", name(part), axis));
  for (int i = 0; i < clip.frames; ++i) {
    const double time_s = clip.time_s(i);
    const Skeleton s = motion.skeleton(time_s);
    std::vector<double> row{
        static_cast<double>(i), time_s,       s.phase,     motion.camera(time_s).metres_per_pixel(),
        s.pelvis_tilt,          s.pelvis.x(), s.pelvis.y()};
    for (int side : {0, 1})
      row.insert(row.end(), {s.hip_flexion[side], s.knee_angle[side], s.ankle_angle[side]});
    for (const BodyPart part : kAskedParts) {
      const Eigen::Vector3d p = s[part] - s.pelvis;
      row.insert(row.end(), {p.x(), p.y()});
    }
    for (std::size_t c = 2; c < row.size(); ++c) row[c] = rounded(row[c], 6);
    table.rows.push_back(std::move(row));
  }
  return table;
}

Keypoints clicks(const Clip& clip) {
  const Trajectory truth = truth_px(clip);
  Keypoints keypoints;
  keypoints.video = truth.video;
  keypoints.width_px = clip.width_px;
  keypoints.height_px = clip.height_px;
  keypoints.direction = facing(clip);
  if (clip.treadmill) keypoints.treadmill = true;
  keypoints.slow_motion = clip.slow_motion;
  keypoints.near_leg = clip.to_left ? Side::left : Side::right;
  Random random(clip.seed * 15485863 + clip.click_seed);
  if (clip.jump) keypoints.movement = "jump";
  const double stride_s = clip.jump ? kUsualStride_s : clip.gait.period_s;
  const double step = stride_s / clip.time_s(kClicksPerStride);
  for (double at = 0; at < clip.frames - 0.5; at += step) {
    const TrajectoryFrame& frame = truth.frames[static_cast<std::size_t>(std::lround(at))];
    ClickedFrame& clicked = keypoints.frames[frame.frame];
    clicked.time_s = frame.time_s;
    for (const BodyPart part : kBodyParts) {
      const Prompt prompt = row(part).prompt;
      if (prompt != Prompt::always && !(clip.jump && prompt == Prompt::with_head)) continue;
      const Eigen::Vector2d off(clip.click_sd_px * normal(random),
                                clip.click_sd_px * normal(random));
      Click click;
      click.p_px = (frame[part].p_px + off).unaryExpr([](double x) { return rounded(x, 2); });
      clicked[part] = click;
    }
  }
  return keypoints;
}

void write_truth(const Clip& clip, const std::filesystem::path& video) {
  const std::string hash = sha256_of_file(video);
  auto beside = [&](const char* extension) {
    return video.parent_path() / (clip.name + extension);
  };
  Trajectory trajectory = truth_px(clip);
  trajectory.video_sha256 = hash;
  for (TrajectoryFrame& frame : trajectory.frames)
    for (Point& point : frame.points)
      point.p_px = point.p_px.unaryExpr([](double x) { return rounded(x, 3); });
  save(trajectory, beside(".truth.csv"));
  save(truth_m(clip), beside(".truth_m.csv"));
  Keypoints keypoints = clicks(clip);
  keypoints.video_sha256 = hash;
  save(keypoints, beside(".keypoints.json"));
}

}  // namespace stride::videos
