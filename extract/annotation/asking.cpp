#include "extract/annotation/asking.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace stride::annotation {

std::vector<BodyPart> asking_order(const std::string& near_leg, bool hips, bool head) {
  const std::array<BodyPart, 4> right{BodyPart::knee_r, BodyPart::ankle_r, BodyPart::toe_r,
                                      BodyPart::hip_r};
  std::vector<BodyPart> order{BodyPart::pelvis};
  for (const bool near : {true, false})
    for (std::size_t i = 0; i < (hips ? 4 : 3); ++i)
      order.push_back((near_leg != "left") == near ? right[i] : mirrored(right[i]));
  if (head) order.push_back(BodyPart::head);
  return order;
}

bool is_near(BodyPart part, const std::string& near_leg) {
  return name(part).ends_with(near_leg == "left" ? "_l" : "_r");
}

std::string spoken(BodyPart part, const std::string& near_leg) {
  if (mirrored(part) == part) return std::string(name(part));
  const std::string_view whole = name(part);
  return fmt::format("{} {} ({})", is_near(part, near_leg) ? "near" : "far",
                     whole.substr(0, whole.size() - 2), whole.ends_with("_l") ? "left" : "right");
}

std::optional<BodyPart> next_missing(const Keypoints& keypoints, int frame,
                                     const std::vector<BodyPart>& order,
                                     std::optional<BodyPart> after) {
  const auto clicked = keypoints.frames.find(frame);
  const auto found = after ? std::ranges::find(order, *after) : order.end();
  const std::size_t start =
      found == order.end() ? 0 : static_cast<std::size_t>(found - order.begin()) + 1;
  for (std::size_t i = 0; i < order.size(); ++i) {
    const BodyPart part = order[(start + i) % order.size()];
    if (clicked == keypoints.frames.end() || !clicked->second[part]) return part;
  }
  return std::nullopt;
}

int next_phase_frame(const Keypoints& keypoints, int frame, double step_frames) {
  const int first = keypoints.frames.empty() ? frame : keypoints.frames.begin()->first;
  const double phase = std::floor((frame - first + 0.5) / step_frames);
  int next = frame;
  for (int k = 0; next <= frame; ++k)
    next = first + static_cast<int>(std::lround((phase + k) * step_frames));
  return next;
}

double stride_from_crossings(const Trajectory& trajectory) {
  std::vector<double> crossings;
  const TrajectoryFrame* before = nullptr;
  for (const TrajectoryFrame& frame : trajectory.frames) {
    if (!frame[BodyPart::ankle_r].present() || !frame[BodyPart::ankle_l].present()) continue;
    if (before) {
      const auto gap = [](const TrajectoryFrame& f) {
        return f[BodyPart::ankle_r].p_px.x() - f[BodyPart::ankle_l].p_px.x();
      };
      const double a = gap(*before), b = gap(frame);
      if ((a < 0) != (b < 0))
        crossings.push_back(before->frame + (frame.frame - before->frame) * a / (a - b));
    }
    before = &frame;
  }
  if (crossings.size() < 2) return 0;
  std::vector<double> halves;
  for (std::size_t i = 1; i < crossings.size(); ++i)
    halves.push_back(crossings[i] - crossings[i - 1]);
  std::ranges::sort(halves);
  return halves[halves.size() / 2] + halves[(halves.size() - 1) / 2];
}

}  // namespace stride::annotation
