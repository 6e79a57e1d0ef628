#include <cmath>
#include <numbers>

#include "videos/colour.h"
#include "videos/costume.h"
#include "videos/limb.h"

namespace stride::videos {
namespace {

using Eigen::Vector3d;

class Human final : public Costume {
 public:
  Human(std::uint64_t seed, HumanLook look) : grain_(seed), look_(std::move(look)) {}

  std::vector<Patch> dress(const Skeleton& k, const Proportions& p, bool from_left) const override {
    const int near = from_left ? 1 : 0, far = 1 - near;
    std::vector<Patch> patches;
    arm(k, p, far, 0.62, patches);
    leg(k, p, far, 0.62, patches);
    pelvis(k, patches);
    leg(k, p, near, 1, patches);
    if (look_.ponytail) ponytail(k, patches);
    neck_and_head(k, patches);
    shirt(k, p, patches);
    arm(k, p, near, 1, patches);
    return patches;
  }

 private:
  Colour skin(double s, double across, double seed) const {
    return lit(look_.skin, 1 + 0.15 * grain_.rough(35 * s + seed, 5 * across + seed));
  }

  /// Cloth that hangs in folds.
  Colour cloth(const Colour& colour, double s, double across, double seed) const {
    const double folds = grain_.rough(16 * s + 3.5 * across + seed, 3 * across - 5 * s + 2 * seed);
    const double weave = grain_(180 * s + seed, 16 * across);
    return lit(colour, 1 + 0.34 * folds + 0.07 * weave);
  }

  void leg(const Skeleton& k, const Proportions& p, int side, double light,
           std::vector<Patch>& out) const {
    const double seed = 10.0 + 30 * side;
    Patch shank = hanging(k.knee[side], k.shank_angle[side],
                          {{0, 0.052, 0.050},
                           {0.05, 0.050, 0.055},
                           {0.13, 0.046, 0.074},
                           {0.20, 0.044, 0.066},
                           {0.30, 0.037, 0.042},
                           {p.shank - 0.03, 0.033, 0.036},
                           {p.shank, 0.035, 0.038}});
    shank.colour = [=, this, end = p.shank](double s, double across) {
      Colour colour = skin(s, across, seed);
      colour = lit(colour, 1 - 0.22 * band(s, -0.02, 0.045, 0.05) * step(across, 0.3, 0.5));
      const double sock = step(s, end - 0.105, 0.004);
      const Colour knit = lit(look_.sock, 1 - 0.20 * band(s, end - 0.095, end - 0.082, 0.006) +
                                              0.10 * grain_(140 * s, 8 * across));
      return mixed(colour, knit, sock);
    };
    Patch shoe = this->shoe(k, p, side);
    Patch thigh = hanging(k.hip[side], k.thigh_angle[side],
                          {{0, 0.088, 0.098},
                           {0.10, 0.088, 0.086},
                           {0.22, 0.079, 0.072},
                           {0.33, 0.064, 0.058},
                           {p.thigh - 0.02, 0.055, 0.051},
                           {p.thigh + 0.02, 0.053, 0.049}});
    thigh.colour = [=, this](double s, double across) {
      const double muscle = 0.16 * band(across, -0.05, 0.25, 0.3) * band(s, 0.2, 0.36, 0.1);
      return lit(skin(s, across, seed + 7), 1 - muscle);
    };
    Patch shorts = hanging(
        k.hip[side], k.thigh_angle[side],
        {{-0.03, 0.098, 0.112}, {0.06, 0.101, 0.106}, {0.15, 0.098, 0.094}, {0.235, 0.099, 0.092}});
    shorts.round_end = false;
    shorts.colour = [=, this](double s, double across) {
      Colour colour = cloth(look_.shorts, s, across, seed + 13);
      colour = mixed(colour, look_.stripe, band(across, -0.22, 0.06, 0.06));
      return mixed(colour, look_.shorts * 0.55F, step(s, 0.222, 0.006));
    };
    for (Patch* patch : {&shank, &shoe, &thigh, &shorts}) {
      patch->light = light;
      out.push_back(std::move(*patch));
    }
  }

  Patch shoe(const Skeleton& k, const Proportions& p, int side) const {
    const double toe = p.toe_forward, sole = p.sole_down;
    Patch shoe = along_foot(k.ankle[side], k.foot_angle[side],
                            {{-p.heel_back, -0.005, 0.9 * sole},
                             {-0.85 * p.heel_back, 0.022, sole},
                             {-0.04, 0.034, sole},
                             {0.02, 0.034, sole},
                             {0.05, 0.010, sole},
                             {0.10, -0.022, sole},
                             {0.8 * toe, -0.040, 0.96 * sole},
                             {toe - 0.012, -0.047, 0.87 * sole}});
    shoe.round_start = false;
    shoe.gloss = 0.10;
    shoe.colour = [=, this](double s, double across) {
      Colour colour = lit(look_.shoe, 1 + 0.15 * grain_(60 * s, 6 * across));
      const double slanted = s - 0.02 * across;
      colour =
          mixed(colour, look_.lace, band(slanted, 0.018, 0.034, 0.006) * step(across, -0.5, 0.1));
      colour =
          mixed(colour, look_.lace, band(slanted, 0.054, 0.070, 0.006) * step(across, -0.5, 0.1));
      colour = mixed(colour, look_.lace, step(across, 0.72, 0.1) * band(s, 0.03, 0.11, 0.01));
      return mixed(look_.sole, colour, step(across, -0.52, 0.08));
    };
    return shoe;
  }

  void pelvis(const Skeleton& k, std::vector<Patch>& out) const {
    Patch hips = hanging(
        k.pelvis, -0.6 * k.trunk_lean,
        {{-0.16, 0.095, 0.100}, {-0.05, 0.104, 0.124}, {0.04, 0.100, 0.125}, {0.08, 0.085, 0.105}});
    hips.light = 0.92;
    hips.colour = [this](double s, double across) { return cloth(look_.shorts, s, across, 77); };
    out.push_back(std::move(hips));
  }

  void shirt(const Skeleton& k, const Proportions& p, std::vector<Patch>& out) const {
    const double top = p.trunk;
    // The hem swings after the hips.
    const double sway = 0.008 * std::sin(4 * std::numbers::pi * k.phase + 0.8);
    Patch shirt = upward(k.pelvis, k.trunk_lean,
                         {{0.045, 0.108 + sway, 0.126 - sway},
                          {0.12, 0.106, 0.112},
                          {0.22, 0.106, 0.100},
                          {0.33, 0.117, 0.106},
                          {0.43, 0.120, 0.118},
                          {top - 0.06, 0.098, 0.112},
                          {top - 0.01, 0.060, 0.078}});
    shirt.round_start = false;
    shirt.colour = [=, this](double s, double across) {
      Colour colour = cloth(look_.shirt, s, across, 131);
      const double wave = s + 0.012 * across;
      colour = mixed(colour, look_.shirt_band, band(wave, 0.31, 0.365, 0.006));
      colour = mixed(colour, rgb(30, 34, 60), band(wave, 0.373, 0.385, 0.005));
      colour = mixed(colour, look_.shirt * 0.6F, step(0.06 - s, 0, 0.006));
      return colour;
    };
    out.push_back(std::move(shirt));
  }

  void neck_and_head(const Skeleton& k, std::vector<Patch>& out) const {
    const double lean = std::atan2(k.head.x() - k.shoulders.x(), k.head.y() - k.shoulders.y());
    Patch neck = upward(k.shoulders, lean,
                        {{-0.04, 0.055, 0.066}, {0.03, 0.050, 0.056}, {0.10, 0.050, 0.054}});
    neck.light = 0.86;
    neck.colour = [this](double s, double across) { return skin(s, across, 51); };
    out.push_back(std::move(neck));

    Patch head = upward(k.head, k.head_pitch,
                        {{-0.122, 0.070, -0.020},
                         {-0.112, 0.082, 0.000},
                         {-0.090, 0.088, 0.030},
                         {-0.066, 0.087, 0.060},
                         {-0.045, 0.090, 0.080},
                         {-0.024, 0.107, 0.090},
                         {0.004, 0.090, 0.097},
                         {0.040, 0.093, 0.102},
                         {0.075, 0.082, 0.095},
                         {0.098, 0.060, 0.076},
                         {0.112, 0.026, 0.044}});
    head.round_start = head.round_end = false;
    head.colour = [this](double s, double across) {
      Colour colour = skin(s, across, 61);
      colour = mixed(colour, rgb(120, 50, 45),
                     0.7 * band(s, -0.078, -0.070, 0.006) * step(across, 0.72, 0.1));
      const double eye = band(s, 0.008, 0.024, 0.008) * band(across, 0.60, 0.80, 0.08);
      colour = mixed(colour, rgb(40, 30, 30), 0.85 * eye);
      colour = mixed(colour, look_.hair,
                     0.8 * band(s, 0.032, 0.040, 0.006) * band(across, 0.5, 0.9, 0.1));
      const double ear = band(s, -0.035, 0.025, 0.012) * band(across, -0.28, 0.0, 0.08);
      colour = mixed(colour, look_.skin * 0.72F, 0.7 * ear);
      const double hairline =
          0.058 - 0.05 * std::max(0.0, 0.45 - across) - 0.02 * std::max(0.0, 0.1 - across);
      const Colour hair = lit(look_.hair, 1 + 0.9 * grain_.rough(50 * s, 14 * across + 3));
      return mixed(colour, hair, step(s, hairline, 0.016) * (1 - 0.9 * ear));
    };
    out.push_back(std::move(head));
  }

  /// It swings back at every landing.
  void ponytail(const Skeleton& k, std::vector<Patch>& out) const {
    const double swing = -0.75 + 0.35 * std::sin(4 * std::numbers::pi * k.phase);
    Vector3d tie = k.head + Vector3d(-0.085, 0.035, 0);
    Patch tail = hanging(tie, swing,
                         {{0, 0.018, 0.018},
                          {0.05, 0.034, 0.034},
                          {0.14, 0.040, 0.036},
                          {0.22, 0.024, 0.022},
                          {0.27, 0.006, 0.006}});
    tail.colour = [this](double s, double across) {
      return lit(look_.hair, 1 + 0.8 * grain_.rough(14 * s, 16 * across + 3));
    };
    out.push_back(std::move(tail));
  }

  void arm(const Skeleton& k, const Proportions& p, int side, double light,
           std::vector<Patch>& out) const {
    const double seed = 200.0 + 40 * side;
    Patch upper = hanging(k.shoulder[side], k.upper_arm_angle[side],
                          {{0, 0.050, 0.052},
                           {0.10, 0.050, 0.049},
                           {0.20, 0.045, 0.042},
                           {p.upper_arm, 0.038, 0.038}});
    upper.colour = [=, this](double s, double across) { return skin(s, across, seed); };
    Patch forearm = hanging(
        k.elbow[side], k.forearm_angle[side],
        {{0, 0.040, 0.038}, {0.07, 0.045, 0.040}, {0.16, 0.035, 0.033}, {p.forearm, 0.024, 0.026}});
    forearm.colour = [=, this](double s, double across) {
      Colour colour = skin(s, across, seed + 5);
      if (side == 0)
        colour =
            mixed(colour, rgb(25, 25, 28), band(s, p.forearm - 0.045, p.forearm - 0.02, 0.004));
      return colour;
    };
    Patch hand = hanging(k.wrist[side], k.forearm_angle[side] + 0.25,
                         {{0.0, 0.026, 0.026}, {0.03, 0.036, 0.034}, {0.065, 0.036, 0.036}});
    hand.colour = [=, this](double s, double across) {
      return lit(skin(s, across, seed + 9),
                 1 - 0.22 * band(across, -0.1, 0.1, 0.2) * step(s, 0.03, 0.02));
    };
    Patch sleeve = hanging(k.shoulder[side], k.upper_arm_angle[side],
                           {{-0.02, 0.056, 0.062}, {0.06, 0.064, 0.063}, {0.145, 0.062, 0.058}});
    sleeve.round_end = false;
    sleeve.colour = [=, this](double s, double across) {
      Colour colour = cloth(look_.shirt, s, across, seed + 17);
      return mixed(colour, look_.shirt_band, step(s, 0.125, 0.005));
    };
    for (Patch* patch : {&upper, &forearm, &hand, &sleeve}) {
      patch->light = light;
      out.push_back(std::move(*patch));
    }
  }

  Texture grain_;
  HumanLook look_;
};

}  // namespace

std::unique_ptr<Costume> human_costume(std::uint64_t seed, const HumanLook& look) {
  return std::make_unique<Human>(seed, look);
}

}  // namespace stride::videos
