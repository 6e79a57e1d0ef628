#pragma once

#include <Eigen/Core>
#include <vector>

#include "extract/skeleton/body_part.h"
#include "extract/skeleton/trajectory.h"

namespace stride::fit {

/// The labelled points of a trajectory, mirrored so that the runner faces right, with y up.
struct Mark {
  int frame = 0;   // index into Trajectory::frames
  double u_s = 0;  // from the middle of the clip
  BodyPart part{};
  Eigen::Vector2d z_px;  // from the centre of the image
  double weight = 1;     // of its squared residual: the confidence, at least 0.05
};

struct Marks {
  std::vector<Mark> points;  // by frame
  std::vector<double> u_s;   // of every frame
  double middle_s = 0, duration_s = 0;
  bool to_left = false;
  int count[kBodyPartCount] = {};  // number of points of a part

  bool sees(BodyPart part) const { return count[index(part)] * 4 >= static_cast<int>(u_s.size()); }
  bool sees_toes() const { return sees(BodyPart::toe_r) || sees(BodyPart::toe_l); }
  bool sees_heels() const { return sees(BodyPart::heel_r) || sees(BodyPart::heel_l); }
};

/// Heels are left out where the toes are not seen, since alone they do not tell the foot's angle.
enum class Heels { beside_toes, left_out };
Marks observe(const Trajectory& trajectory, bool to_left, Heels heels = Heels::beside_toes);

/// A point as Mark::z_px in pixels of the frame.
Eigen::Vector2d image_px(const Trajectory& trajectory, bool to_left, const Eigen::Vector2d& z_px);

}  // namespace stride::fit
