#include <cmath>
#include <numbers>

#include "videos/colour.h"
#include "videos/costume.h"
#include "videos/limb.h"

namespace stride::videos {
namespace {

constexpr double kLine_m = 0.011;

const Colour kSkin = rgb(250, 206, 164), kHair = rgb(230, 120, 30), kShirt = rgb(64, 132, 216),
             kPants = rgb(236, 190, 52), kShoe = rgb(208, 52, 52), kGlove = rgb(250, 250, 246),
             kDark = rgb(28, 24, 30), kWhite = rgb(252, 252, 252);

/// Flat colour with a darker back, as drawn on film.
auto flat_colour(const Colour& colour, double edge = -0.35) {
  return [=](double, double across) { return across < edge ? lit(colour, 0.80) : colour; };
}

class Cartoon final : public Costume {
 public:
  std::vector<Patch> dress(const Skeleton& k, const Proportions& p, bool from_left) const override {
    const int near = from_left ? 1 : 0, far = 1 - near;
    std::vector<Patch> out;
    const auto add = [&](std::vector<Patch> patches) {
      const int group = static_cast<int>(out.size());
      for (Patch& patch : patches) {
        patch.group = group;
        patch.outline_m = kLine_m;
        patch.roundness = 0.30;
        patch.end_roundness = 0;
        out.push_back(std::move(patch));
      }
    };
    add(arm(k, p, far));
    add(leg(k, p, far));
    add(body(k));
    add(leg(k, p, near));
    add(head(k));
    face(k, out);
    add(arm(k, p, near));
    return out;
  }

 private:
  static std::vector<Patch> leg(const Skeleton& k, const Proportions& p, int side) {
    Patch thigh =
        hanging(k.hip[side], k.thigh_angle[side],
                {{0, 0.085, 0.085}, {0.5 * p.thigh, 0.082, 0.078}, {p.thigh, 0.064, 0.064}});
    thigh.colour = [end = 0.62 * p.thigh](double s, double across) {
      const Colour colour = s < end ? kPants : kSkin;
      return across < -0.35 ? lit(colour, 0.80) : colour;
    };
    Patch shank =
        hanging(k.knee[side], k.shank_angle[side],
                {{0, 0.064, 0.064}, {0.4 * p.shank, 0.056, 0.068}, {p.shank, 0.048, 0.048}});
    shank.colour = [end = p.shank](double s, double across) {
      Colour colour = s > end - 0.09 ? kWhite : kSkin;
      if (s > end - 0.07 && s < end - 0.05) colour = kShoe;
      return across < -0.35 ? lit(colour, 0.80) : colour;
    };
    const double toe = p.toe_forward, sole = p.sole_down;
    Patch shoe = along_foot(k.ankle[side], k.foot_angle[side],
                            {{-p.heel_back, 0.01, 0.96 * sole},
                             {-0.03, 0.055, sole},
                             {0.04, 0.055, sole},
                             {0.5 * toe, 0.02, sole},
                             {0.8 * toe, 0.028, sole},
                             {toe - 0.05, 0.012, 0.96 * sole}});
    shoe.round_start = false;
    shoe.colour = [](double s, double across) {
      if (across < -0.66) return kWhite;
      return across > 0.35 && s > 0.03 && s < 0.09 ? kWhite : kShoe;
    };
    std::vector<Patch> patches;
    for (Patch* patch : {&shank, &thigh, &shoe}) patches.push_back(std::move(*patch));
    return patches;
  }

  static std::vector<Patch> body(const Skeleton& k) {
    const double length = (k.shoulders - k.pelvis).norm();
    const double fat = std::sqrt(0.42 / length);  // squashed flat it grows round
    Patch pants = upward(k.pelvis, k.trunk_lean,
                         {{-0.07, 0.11 * fat, 0.12 * fat}, {0.06, 0.155 * fat, 0.15 * fat}});
    pants.colour = flat_colour(kPants);
    Patch shirt = upward(k.pelvis, k.trunk_lean,
                         {{0.05, 0.160 * fat, 0.150 * fat},
                          {0.35 * length, 0.175 * fat, 0.150 * fat},
                          {0.75 * length, 0.130 * fat, 0.125 * fat},
                          {length, 0.07, 0.08}});
    shirt.round_start = false;
    shirt.colour = [length](double s, double across) {
      const double stripe = s / length;
      Colour colour = stripe > 0.36 && stripe < 0.50 ? kWhite : kShirt;
      return across < -0.35 ? lit(colour, 0.80) : colour;
    };
    std::vector<Patch> patches;
    patches.push_back(std::move(pants));
    patches.push_back(std::move(shirt));
    return patches;
  }

  static std::vector<Patch> head(const Skeleton& k) {
    Patch skull = upward(
        k.head, k.head_pitch,
        {{-0.13, 0.11, 0.06}, {-0.06, 0.175, 0.15}, {0.03, 0.180, 0.195}, {0.12, 0.135, 0.155}});
    skull.colour = [](double s, double across) {
      const bool hair = s > 0.10 + 0.02 * std::sin(9 * across) || across < -0.42 - 0.25 * s;
      if (hair) return across < -0.7 ? lit(kHair, 0.82) : kHair;
      return across < -0.3 && s < -0.08 ? lit(kSkin, 0.84) : kSkin;
    };
    Patch nose = upward(k.head, k.head_pitch + 1.45, {{0.15, 0.030, 0.030}, {0.215, 0.034, 0.034}});
    nose.colour = flat_colour(rgb(244, 176, 140));
    // Three tufts that fly behind.
    std::vector<Patch> patches;
    for (int i = 0; i < 3; ++i) {
      const double flutter = 0.25 * std::sin(4 * std::numbers::pi * k.phase + i);
      Patch tuft = upward(k.head, k.head_pitch - 1.15 + 0.38 * i + flutter,
                          {{0.10, 0.05, 0.05}, {0.22, 0.035, 0.035}, {0.29, 0.008, 0.008}});
      tuft.colour = flat_colour(kHair);
      patches.push_back(std::move(tuft));
    }
    patches.push_back(std::move(nose));
    patches.push_back(std::move(skull));
    return patches;
  }

  /// Eye, mouth and ear, each with its own line.
  static void face(const Skeleton& k, std::vector<Patch>& out) {
    const auto spot = [&](double up, double forward, double tall, double wide, const Colour& colour,
                          double line) {
      const double c = std::cos(k.head_pitch), s = std::sin(k.head_pitch);
      const Eigen::Vector3d at =
          k.head + Eigen::Vector3d(forward * c + up * s, up * c - forward * s, 0);
      Patch patch = upward(at, k.head_pitch, {{-tall, wide, wide}, {tall, wide, wide}});
      patch.colour = [colour](double, double) { return colour; };
      patch.roundness = patch.end_roundness = 0;
      patch.outline_m = line;
      patch.group = static_cast<int>(out.size());
      out.push_back(std::move(patch));
    };
    spot(0.045, 0.095, 0.022, 0.036, kWhite, 0.006);
    spot(0.040, 0.112, 0.010, 0.014, kDark, 0);
    spot(-0.085, 0.085, 0.002, 0.040, lit(kShoe, 0.7), 0.006);
    spot(-0.01, -0.03, 0.012, 0.036, lit(kSkin, 0.93), 0.006);
  }

  static std::vector<Patch> arm(const Skeleton& k, const Proportions& p, int side) {
    Patch upper = hanging(k.shoulder[side], k.upper_arm_angle[side],
                          {{0, 0.060, 0.060}, {p.upper_arm, 0.046, 0.046}});
    upper.colour = [end = 0.6 * p.upper_arm](double s, double across) {
      const Colour colour = s < end ? kShirt : kSkin;
      return across < -0.35 ? lit(colour, 0.80) : colour;
    };
    Patch forearm = hanging(k.elbow[side], k.forearm_angle[side],
                            {{0, 0.046, 0.046}, {p.forearm, 0.040, 0.040}});
    forearm.colour = flat_colour(kSkin);
    Patch glove = hanging(k.wrist[side], k.forearm_angle[side] + 0.2,
                          {{-0.01, 0.055, 0.055}, {0.05, 0.070, 0.066}, {0.075, 0.060, 0.060}});
    glove.colour = flat_colour(kGlove);
    std::vector<Patch> patches;
    for (Patch* patch : {&forearm, &upper, &glove}) patches.push_back(std::move(*patch));
    return patches;
  }
};

}  // namespace

std::unique_ptr<Costume> cartoon_costume() { return std::make_unique<Cartoon>(); }

}  // namespace stride::videos
