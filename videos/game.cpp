#include <cmath>

#include "videos/colour.h"
#include "videos/costume.h"
#include "videos/limb.h"

namespace stride::videos {
namespace {

const Colour kSuit = rgb(46, 50, 66), kPlate = rgb(150, 160, 176), kAccent = rgb(224, 108, 36),
             kGlow = rgb(90, 232, 255), kSole = rgb(24, 26, 32);

class Game final : public Costume {
 public:
  explicit Game(std::uint64_t seed) : grain_(seed) {}

  std::vector<Patch> dress(const Skeleton& k, const Proportions& p, bool from_left) const override {
    const int near = from_left ? 1 : 0, far = 1 - near;
    std::vector<Patch> out;
    arm(k, p, far, 0.55, out);
    leg(k, p, far, 0.55, out);
    hips(k, out);
    leg(k, p, near, 1, out);
    trunk(k, p, out);
    helmet(k, out);
    arm(k, p, near, 1, out);
    return out;
  }

 private:
  Colour suit(double s, double across) const {
    // Woven hexagons, more or less.
    const double weave =
        std::sin(150 * s) * std::sin(14 * across + (std::fmod(std::abs(s), 0.04) > 0.02 ? 1.5 : 0));
    return lit(kSuit, 1 + 0.22 * weave + 0.15 * grain_.rough(9 * s, 3 * across));
  }

  /// Painted metal with scratches, an edge and a coloured stripe.
  Colour plate(double s, double across, double from, double to, double stripe) const {
    Colour colour = lit(kPlate, 1 + 0.14 * grain_.rough(20 * s, 6 * across + 40) +
                                    0.10 * grain_(90 * s, 3 * across));
    colour = mixed(colour, kAccent, band(across, stripe - 0.16, stripe + 0.16, 0.05));
    const double edge = std::min(s - from, to - s);
    return lit(colour, edge < 0.008 ? 0.45 : edge < 0.016 ? 1.35 : 1);
  }

  Patch armour(Patch patch, double stripe) const {
    const double from = patch.stations.front().s, to = patch.stations.back().s;
    patch.round_start = patch.round_end = false;
    patch.gloss = 0.42;
    patch.colour = [=, this](double s, double across) {
      return plate(s, across, from, to, stripe);
    };
    return patch;
  }

  void leg(const Skeleton& k, const Proportions& p, int side, double light,
           std::vector<Patch>& out) const {
    const auto cloth = [this](double s, double across) { return suit(s, across); };
    Patch thigh = hanging(k.hip[side], k.thigh_angle[side],
                          {{0, 0.100, 0.106},
                           {0.15, 0.096, 0.086},
                           {0.32, 0.066, 0.062},
                           {p.thigh + 0.01, 0.056, 0.054}});
    thigh.colour = cloth;
    Patch shank = hanging(
        k.knee[side], k.shank_angle[side],
        {{0, 0.054, 0.054}, {0.14, 0.052, 0.074}, {0.30, 0.044, 0.048}, {p.shank, 0.042, 0.044}});
    shank.colour = cloth;
    Patch cuisse =
        armour(hanging(k.hip[side], k.thigh_angle[side],
                       {{0.10, 0.106, 0.070}, {0.20, 0.102, 0.062}, {0.34, 0.074, 0.048}}),
               0.1);
    Patch greave = armour(hanging(k.knee[side], k.shank_angle[side],
                                  {{0.07, 0.066, 0.052},
                                   {0.16, 0.066, 0.070},
                                   {0.28, 0.060, 0.058},
                                   {p.shank - 0.06, 0.066, 0.066}}),
                          0.35);
    Patch cop = armour(hanging(k.knee[side], 0.5 * (k.thigh_angle[side] + k.shank_angle[side]),
                               {{-0.055, 0.045, 0.0}, {0, 0.078, 0.0}, {0.055, 0.045, 0.0}}),
                       0.5);
    const double toe = p.toe_forward, sole = p.sole_down;
    Patch boot = along_foot(k.ankle[side], k.foot_angle[side],
                            {{-p.heel_back - 0.012, 0.03, sole},
                             {-0.05, 0.060, sole},
                             {0.04, 0.055, sole},
                             {0.5 * toe, 0.010, sole},
                             {0.85 * toe, -0.006, sole},
                             {toe, -0.03, 0.9 * sole}});
    boot.round_start = boot.round_end = false;
    boot.gloss = 0.3;
    boot.colour = [this](double s, double across) {
      if (across < -0.50) return lit(kSole, std::fmod(s + 1, 0.03) < 0.015 ? 0.6 : 1.3);
      if (across < -0.38) return kGlow;
      return lit(kPlate, (s > 0.10 ? 0.72 : 0.9) + 0.10 * grain_.rough(30 * s, 8 * across));
    };
    for (Patch* patch : {&shank, &boot, &thigh, &greave, &cuisse, &cop}) {
      patch->light = light;
      out.push_back(std::move(*patch));
    }
  }

  void hips(const Skeleton& k, std::vector<Patch>& out) const {
    Patch belt = upward(k.pelvis, 0.6 * k.trunk_lean,
                        {{-0.11, 0.085, 0.095}, {0, 0.112, 0.125}, {0.10, 0.098, 0.100}});
    belt.colour = [this](double s, double across) {
      if (s > 0.03 && s < 0.075) return lit(kSole, 1.2 + 0.3 * band(across, 0.1, 0.5, 0.05));
      return suit(s, across);
    };
    belt.gloss = 0.15;
    out.push_back(std::move(belt));
  }

  void trunk(const Skeleton& k, const Proportions& p, std::vector<Patch>& out) const {
    Patch pack = upward(k.pelvis, k.trunk_lean,
                        {{0.26, -0.06, 0.17}, {0.40, -0.06, 0.20}, {p.trunk - 0.02, -0.05, 0.17}});
    pack.gloss = 0.3;
    pack.round_start = pack.round_end = false;
    pack.colour = [this](double s, double across) {
      if (std::abs(std::fmod(s, 0.07) - 0.035) < 0.006) return kGlow;
      return lit(kSuit, 1.5 + 0.2 * grain_.rough(20 * s, 9 * across));
    };
    Patch waist = upward(k.pelvis, k.trunk_lean,
                         {{0.05, 0.095, 0.098}, {0.18, 0.092, 0.088}, {0.34, 0.11, 0.10}});
    waist.colour = [this](double s, double across) { return suit(s, across); };
    Patch chest = armour(upward(k.pelvis, k.trunk_lean,
                                {{0.23, 0.115, 0.100},
                                 {0.36, 0.152, 0.115},
                                 {0.47, 0.148, 0.125},
                                 {p.trunk - 0.02, 0.100, 0.115},
                                 {p.trunk + 0.03, 0.070, 0.080}}),
                         0.45);
    chest.end_roundness = 0.5;
    for (Patch* patch : {&pack, &waist, &chest}) out.push_back(std::move(*patch));
  }

  void helmet(const Skeleton& k, std::vector<Patch>& out) const {
    const double lean = std::atan2(k.head.x() - k.shoulders.x(), k.head.y() - k.shoulders.y());
    Patch neck = upward(k.shoulders, lean, {{-0.02, 0.060, 0.066}, {0.10, 0.055, 0.060}});
    neck.colour = [this](double s, double across) { return suit(s, across); };
    neck.light = 0.8;
    Patch helm = upward(k.head, k.head_pitch,
                        {{-0.12, 0.060, 0.03},
                         {-0.10, 0.090, 0.065},
                         {-0.05, 0.112, 0.105},
                         {0.02, 0.116, 0.122},
                         {0.07, 0.104, 0.115},
                         {0.11, 0.074, 0.086},
                         {0.135, 0.028, 0.040}});
    helm.round_start = helm.round_end = false;
    helm.gloss = 0.5;
    helm.end_roundness = 0.8;
    helm.colour = [this](double s, double across) {
      if (band(s, -0.015, 0.045, 0.01) * step(across, 0.02, 0.05) > 0.5)
        return lit(kGlow, 0.55 + 0.45 * across);
      Colour colour = lit(kPlate, 1 + 0.10 * grain_.rough(25 * s, 7 * across));
      colour = mixed(colour, kAccent, band(s, 0.07, 0.095, 0.004));
      return lit(colour, std::abs(across + 0.05) < 0.03 ? 0.5 : 1);
    };
    out.push_back(std::move(neck));
    out.push_back(std::move(helm));
  }

  void arm(const Skeleton& k, const Proportions& p, int side, double light,
           std::vector<Patch>& out) const {
    const auto cloth = [this](double s, double across) { return suit(s + 3, across); };
    Patch upper = hanging(k.shoulder[side], k.upper_arm_angle[side],
                          {{0, 0.060, 0.060}, {0.14, 0.058, 0.056}, {p.upper_arm, 0.044, 0.044}});
    upper.colour = cloth;
    Patch forearm = hanging(k.elbow[side], k.forearm_angle[side],
                            {{0, 0.045, 0.045}, {0.08, 0.052, 0.048}, {p.forearm, 0.036, 0.036}});
    forearm.colour = cloth;
    Patch vambrace = armour(
        hanging(k.elbow[side], k.forearm_angle[side],
                {{0.05, 0.060, 0.058}, {0.12, 0.062, 0.058}, {p.forearm - 0.015, 0.046, 0.046}}),
        0.0);
    Patch fist =
        hanging(k.wrist[side], k.forearm_angle[side], {{0, 0.040, 0.040}, {0.05, 0.050, 0.046}});
    fist.colour = [this](double s, double across) {
      return lit(kSole, 1.7 + 0.4 * grain_(60 * s, 5 * across));
    };
    Patch pauldron = armour(hanging(k.shoulder[side], 0.45 * k.upper_arm_angle[side],
                                    {{-0.075, 0.060, 0.064},
                                     {-0.03, 0.105, 0.105},
                                     {0.05, 0.108, 0.108},
                                     {0.11, 0.085, 0.085}}),
                            -0.1);
    pauldron.gloss = 0.6;
    for (Patch* patch : {&upper, &forearm, &vambrace, &fist, &pauldron}) {
      patch->light = light;
      out.push_back(std::move(*patch));
    }
  }

  Texture grain_;
};

}  // namespace

std::unique_ptr<Costume> game_costume(std::uint64_t seed) { return std::make_unique<Game>(seed); }

}  // namespace stride::videos
