#include "videos/gait.h"

#include <cmath>
#include <numbers>

namespace stride::videos {

double Harmonics::operator()(double phase) const {
  double value = mean;
  for (std::size_t i = 0; i < terms.size(); ++i) {
    const double angle = 2 * std::numbers::pi * static_cast<double>(i + 1) * phase;
    value += terms[i].cosine * std::cos(angle) + terms[i].sine * std::sin(angle);
  }
  return value;
}

Gait rajagopal_run() {
  Gait gait;
  gait.name = "rajagopal_run";
  gait.source =
      "Rajagopal, Dembia, DeMers, Delp, Hicks, Delp 2016, IEEE Trans. Biomed. Eng. 63:2068, trial "
      "RUN4: six strides of a man of 1.80 m on a treadmill; Fourier series of the mean of both "
      "legs";
  gait.period_s = 0.6867;
  gait.hip_flexion_deg = {16.5368,
                          {{22.2039, -19.9628},
                           {-5.9930, 5.4519},
                           {-2.6508, 1.9323},
                           {-0.6103, -0.6384},
                           {-0.3858, 0.1211},
                           {-0.2461, 0.0465}}};
  gait.knee_angle_deg = {-51.8542,
                         {{19.2852, 31.4699},
                          {10.7230, -22.6972},
                          {6.0220, -1.5303},
                          {0.8598, 0.3793},
                          {0.5567, -0.6575},
                          {0.4616, 0.5594}}};
  // The measured mean is -1.4225 against a standing trial; 6.5° more lay the shoe flat in stance.
  gait.ankle_angle_deg = {5.0775,
                          {{14.7699, -0.1582},
                           {-6.8657, 7.4919},
                           {-3.8200, -4.3131},
                           {1.6012, -3.0252},
                           {1.1543, 0.1913},
                           {-0.3421, -0.9910}}};
  gait.pelvis_tilt_deg = {
      -6.6832, {{0.2317, -0.1418}, {0.8703, 0.9274}, {-0.2458, 0.0141}, {0.3210, 0.1517}}};
  gait.pelvis_height_m = {
      0.96339,
      {{0, 0}, {0.01198, -0.03876}, {0, 0}, {0.00260, 0.00037}, {0, 0}, {0.00067, -0.00001}}};
  gait.trunk_lean_deg = {7.5, {{0, 0}, {-0.9, 1.1}}};
  gait.shoulder_deg = {-16, {{-28, 25}}};
  gait.elbow_deg = {92, {{-10, 12}, {4, 0}}};
  gait.hip_swing_m = -0.006;
  gait.hip_drop_m = 0.004;
  return gait;
}

}  // namespace stride::videos
