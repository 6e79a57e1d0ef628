#include "calibrate/aperiodic/passage.h"

#include <algorithm>
#include <cmath>

namespace stride::aperiodic {

SplinePlace Passage::place(double u_s) const {
  const auto intervals = static_cast<double>(knots.size()) - 3;
  const double at = std::clamp((u_s - first_s) / knot_s, 0.0, intervals);
  SplinePlace place;
  place.first = std::min(static_cast<int>(at), static_cast<int>(intervals) - 1);
  const double t = at - place.first, s = 1 - t;
  place.weight = {s * s * s / 6, (3 * t * t * t - 6 * t * t + 4) / 6,
                  (3 * s * s * s - 6 * s * s + 4) / 6, t * t * t / 6};
  return place;
}

Angles Passage::angles(double u_s) const {
  const SplinePlace at = place(u_s);
  Angles angles{};
  for (std::size_t k = 0; k < 4; ++k)
    for (int a = 0; a < kAngles; ++a)
      angles[a] += at.weight[k] * knots[static_cast<std::size_t>(at.first) + k][a];
  return angles;
}

Passage empty_passage(const std::vector<double>& u_s, double knot_s) {
  Passage passage;
  passage.first_s = u_s.front();
  const double span_s = u_s.back() - u_s.front();
  const int intervals = std::max(1, static_cast<int>(std::ceil(span_s / knot_s)));
  passage.knot_s = span_s / intervals;
  passage.knots.assign(static_cast<std::size_t>(intervals) + 3, Angles{});
  passage.pelvis_px.assign(u_s.size(), Eigen::Vector2d::Zero());
  return passage;
}

Eigen::Vector2d predicted_px(const Passage& passage, const Directions& directions, BodyPart part,
                             int frame, double u_s) {
  return passage.pelvis_px[static_cast<std::size_t>(frame)] +
         about_pelvis(part, directions, passage.limbs.data(), passage.angles(u_s));
}

}  // namespace stride::aperiodic
