#pragma once

#include <string>
#include <vector>

namespace stride::videos {

/// A periodic curve: mean + Σ cosine_h cos 2πhφ + sine_h sin 2πhφ, φ the fraction of the stride.
struct Harmonics {
  struct Term {
    double cosine = 0, sine = 0;
  };
  double mean = 0;
  std::vector<Term> terms;

  double operator()(double phase) const;
};

/// A gait: sagittal angles in degrees with OpenSim's signs (hip + flexion, knee − flexion, ankle +
/// dorsiflexion, pelvis tilt − forward), of the right leg; φ = 0 at the right foot strike, the left
/// leg half a stride later.
struct GaitCurves {
  std::string name, source;
  double period_s = 0;
  Harmonics hip_flexion_deg, knee_angle_deg, ankle_angle_deg, pelvis_tilt_deg;
  Harmonics pelvis_height_m;  // for legs of 0.857 m; only its variation is used
  // By eye, because the sources do not have it.
  Harmonics trunk_lean_deg;           // of the line hips → shoulders, forward positive
  Harmonics shoulder_deg, elbow_deg;  // of the right arm, flexion positive
  double squash = 0;  // the trunk is longer in flight and shorter in stance by this part
  double shoulder_swing_m = 0.045;  // fore and aft, by the rotation of the trunk
  double hip_swing_m = 0,
         hip_drop_m = 0;  // of the right hip, by the rotation and list of the pelvis
};

GaitCurves rajagopal_run();  // a man at 3.8 m/s
GaitCurves hamner_run();     // a man at 3.96 m/s
GaitCurves jog();            // 2.8 m/s
GaitCurves walk();           // 1.14 m/s
GaitCurves game_run();       // high knees, long flight
GaitCurves cartoon_run();    // the man's run, exaggerated

}  // namespace stride::videos
