#include "videos/gait_curves.h"

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

GaitCurves rajagopal_run() {
  GaitCurves gait;
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

GaitCurves hamner_run() {
  GaitCurves gait = rajagopal_run();  // its trunk and arms
  gait.name = "hamner_run";
  gait.source =
      "Hamner, Seth, Delp 2010, J. Biomech. 43:2709, subject 2: thirteen strides of a man of 1.83 "
      "m "
      "on a treadmill at 3.96 m/s; Fourier series of the mean of both legs";
  gait.period_s = 0.6899;
  gait.hip_flexion_deg = {11.7665,
                          {{30.4530, -14.4073},
                           {-8.1884, 2.9931},
                           {-3.1174, 1.6783},
                           {-0.0851, 0.4310},
                           {-0.4357, 0.1779},
                           {-0.3013, 0.2863}}};
  gait.knee_angle_deg = {-51.3236,
                         {{7.6937, 27.9598},
                          {17.5724, -20.9584},
                          {5.3620, -1.2710},
                          {0.4062, -0.8614},
                          {0.6845, -0.5685},
                          {0.1009, -0.0831}}};
  // The measured mean is -0.6634; 5° more lay the shoe flat in stance.
  gait.ankle_angle_deg = {4.3366,
                          {{16.9551, 6.2491},
                           {-10.8902, 3.0998},
                           {-2.1455, -2.6947},
                           {0.6742, 0.5287},
                           {-0.4847, 0.5334},
                           {-0.0890, 0.0104}}};
  gait.pelvis_tilt_deg = {
      -1.1864, {{-0.2852, -0.2508}, {0.4624, 3.3218}, {-0.0465, -0.1000}, {0.1200, -0.1175}}};
  gait.pelvis_height_m = {0.95868, {{0, 0}, {0.01937, -0.03035}, {0, 0}, {0.00073, 0.00115}}};
  return gait;
}

GaitCurves jog() {
  GaitCurves gait;
  gait.name = "jog";
  gait.source =
      "humanoid3d_jog of DeepMimic (Xue Bin Peng 2018, MIT licence), 2.8 m/s; Fourier series of "
      "the "
      "mean of both legs; 8° of the pelvis' tilt counted as flexion of the hip";
  gait.period_s = 0.8333;
  gait.hip_flexion_deg = {7.2114,
                          {{21.7415, -5.7874},
                           {-1.5336, -0.5164},
                           {-1.4860, 1.9101},
                           {-0.2103, 0.1103},
                           {-0.0754, -0.2344},
                           {-0.1969, 0.0648}}};
  gait.knee_angle_deg = {-43.4253,
                         {{10.7786, 22.9935},
                          {18.1848, -16.7825},
                          {3.8510, -2.2844},
                          {1.7722, 1.2649},
                          {0.8550, 0.4463},
                          {0.0746, 0.3753}}};
  gait.ankle_angle_deg = {6.6975,
                          {{15.1948, 3.5846},
                           {-8.2402, 6.9917},
                           {-2.9829, -4.4286},
                           {2.7433, -1.9100},
                           {0.4983, 0.2747},
                           {0.2857, -0.8167}}};
  gait.pelvis_tilt_deg = {-6.6039, {{0, 0}, {-2.6814, 5.2393}, {0, 0}, {0.1764, -0.3633}}};
  gait.pelvis_height_m = {0.87033, {{0, 0}, {0.02209, -0.05636}, {0, 0}, {0.00206, 0.00418}}};
  gait.trunk_lean_deg = {6, {{0, 0}, {-0.8, 1.0}}};
  gait.shoulder_deg = {-14, {{-24, 14}}};
  gait.elbow_deg = {86, {{-8, 10}}};
  gait.hip_swing_m = -0.004;
  gait.hip_drop_m = 0.003;
  return gait;
}

GaitCurves walk() {
  GaitCurves gait;
  gait.name = "walk";
  gait.source =
      "OpenSim's example of Gait10dof18musc, subject 1 at 1.14 m/s; Fourier series of the mean of "
      "both legs; 10° of flexion of the hip counted as tilt of the pelvis";
  gait.period_s = 1.2340;
  gait.hip_flexion_deg = {9.3156,
                          {{21.5996, -3.0277},
                           {-6.6670, -1.8950},
                           {-0.5271, 2.6698},
                           {-0.4654, -0.3429},
                           {-0.2368, 0.5266},
                           {0.2748, 0.3274}}};
  gait.knee_angle_deg = {-21.3963,
                         {{-0.6013, 22.0391},
                          {20.5779, -7.4555},
                          {1.1868, -7.3963},
                          {1.4187, -0.9922},
                          {0.3558, -1.6084},
                          {-0.4622, -0.4675}}};
  gait.ankle_angle_deg = {2.2653,
                          {{-5.1469, 2.4569},
                           {0.9280, -2.4812},
                           {-3.1933, -0.4911},
                           {1.1473, 1.2759},
                           {0.8363, -1.0504},
                           {-0.3378, 0.1482}}};
  gait.pelvis_tilt_deg = {-2.2196, {{0, 0}, {0.6822, 0.8859}, {0, 0}, {0.0195, 0.4323}}};
  gait.trunk_lean_deg = {2, {{0, 0}, {0.4, 0.3}}};
  gait.shoulder_deg = {3, {{-15, 4}}};
  gait.elbow_deg = {18, {{-7, 3}}};
  gait.shoulder_swing_m = 0.02;
  gait.hip_swing_m = 0.01;
  gait.hip_drop_m = 0.006;
  return gait;
}

GaitCurves game_run() {
  GaitCurves gait;
  gait.name = "game_run";
  gait.source =
      "humanoid3d_run of DeepMimic (Xue Bin Peng 2018, MIT licence), a stylised run of 3.6 m/s; "
      "Fourier series of the mean of both legs; 18° of the pelvis' tilt counted as flexion of the "
      "hip";
  gait.period_s = 0.72;
  gait.hip_flexion_deg = {16.9565,
                          {{29.5466, -26.7172},
                           {-13.1777, 6.7922},
                           {-1.3906, 4.0358},
                           {-1.8877, -0.9417},
                           {-0.2137, 0.4260}}};
  gait.knee_angle_deg = {-48.1945,
                         {{20.0173, 24.5675},
                          {-0.5920, -28.6529},
                          {5.3605, -5.7845},
                          {1.1092, 2.1673},
                          {0.8258, -1.0236}}};
  gait.ankle_angle_deg = {4.2595,
                          {{19.8429, 0.9426},
                           {-8.7420, 12.0712},
                           {-6.0528, -1.9310},
                           {0.3960, -2.3961},
                           {0.6961, 0.2108}}};
  gait.pelvis_tilt_deg = {-7.8428, {{0, 0}, {6.1207, 0.7190}, {0, 0}, {0.3615, -0.5867}}};
  gait.trunk_lean_deg = {15, {{0, 0}, {-1.5, 2.0}}};
  gait.shoulder_deg = {-12, {{-42, 36}}};
  gait.elbow_deg = {88, {{-14, 14}}};
  gait.shoulder_swing_m = 0.06;
  return gait;
}

GaitCurves cartoon_run() {
  GaitCurves gait = rajagopal_run();
  gait.name = "cartoon_run";
  gait.source = "drawn by eye: the run of Rajagopal et al. 2016 with every swing exaggerated";
  gait.period_s = 0.64;
  const auto exaggerate = [](Harmonics& curve, double factor) {
    for (auto& term : curve.terms) {
      term.cosine *= factor;
      term.sine *= factor;
    }
  };
  exaggerate(gait.hip_flexion_deg, 1.35);
  exaggerate(gait.knee_angle_deg, 1.18);
  exaggerate(gait.ankle_angle_deg, 1.1);
  gait.knee_angle_deg.mean = -60;
  gait.hip_flexion_deg.mean = 20;
  gait.shoulder_deg = {-14, {{-52, 44}}};
  gait.elbow_deg = {80, {{-26, 24}}};
  gait.trunk_lean_deg = {5, {{0, 0}, {-4, 4}}};
  gait.squash = 0.09;
  gait.hip_swing_m = gait.hip_drop_m = 0;
  return gait;
}

}  // namespace stride::videos
