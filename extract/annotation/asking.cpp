#include "extract/annotation/asking.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace stride::annotation {

std::vector<BodyPart> asking_order(Side near_leg, bool hips, bool head) {
  const Side far_leg = near_leg == Side::right ? Side::left : Side::right;
  std::vector<BodyPart> order;
  const auto add = [&](std::optional<Side> side, auto asked) {
    for (const BodyPartRow& each : kBodyPartRows)
      if (each.side == side && asked(each.prompt)) order.push_back(each.part);
  };
  const auto of_leg = [&](Prompt p) {
    return p == Prompt::always || (hips && p == Prompt::with_hips);
  };
  add(std::nullopt, [](Prompt p) { return p == Prompt::always; });
  add(near_leg, of_leg);
  add(far_leg, of_leg);
  add(std::nullopt, [&](Prompt p) { return head && p == Prompt::with_head; });
  return order;
}

bool is_near(BodyPart part, Side near_leg) { return row(part).side == near_leg; }

std::string spoken(BodyPart part, Side near_leg) {
  const std::optional<Side> side = row(part).side;
  if (!side) return std::string(name(part));
  return fmt::format("{} {} ({})", is_near(part, near_leg) ? "near" : "far",
                     row(part).nouns.front(), kSides[*side]);
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
