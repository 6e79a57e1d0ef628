#include "train/film/film.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <opencv2/imgproc.hpp>

#include "extract/io/error.h"
#include "train/film/film_canvas.h"

namespace stride::film {
namespace {

constexpr double kForce_m_N = 1 / 2600.0;  // length of an arrow
/// The left leg is the far one: mixed so much with the background.
constexpr double kFar = 0.42;

const cv::Scalar kBone(205, 225, 232), kBoneRim(120, 140, 150), kSky(236, 226, 216),
    kFlesh(196, 200, 214), kInk(60, 48, 40);

/// Blue at rest, over violet to red at full activation.
cv::Scalar activation_colour(double activation) {
  const double a = std::clamp(activation, 0.0, 1.0);
  return {205 * (1 - a) + 40 * a, 88 * (1 - a) + 30 * a, 52 * (1 - a) + 225 * a};
}

using Frame = simulation::RunnerKinematics::Frame;

/// A point fixed in a body, in the ground.
simulation::PlanarVector at(const Frame& frame, double x, double y) {
  const double c = std::cos(frame.angle_rad), s = std::sin(frame.angle_rad);
  return {frame.position.x + c * x - s * y, frame.position.y + s * x + c * y};
}

std::vector<laws::BodyFrame> body_frames(const simulation::RunnerKinematics& kinematics) {
  std::vector<laws::BodyFrame> frames;
  for (const Frame& body : kinematics.bodies)
    frames.push_back({{body.position.x, body.position.y, 0},
                      std::cos(body.angle_rad),
                      std::sin(body.angle_rad),
                      body.velocity.x,
                      body.velocity.y,
                      body.omega_rad_s});
  return frames;
}

void draw_muscles(Canvas& canvas, const FilmModel& model, const RunnerPicture& picture, int side) {
  std::vector<double> q = model.default_coordinates, u(q.size(), 0);
  for (int i = 0; i < simulation::kCoordinates; ++i)
    q[model.layout.coordinate[i]] = picture.state.q[i];
  const std::vector<laws::BodyFrame> frames = body_frames(picture.kinematics);
  for (std::size_t m = 0; m < model.muscles.size(); ++m) {
    const FilmModel::DrawnMuscle& law = model.muscles[m];
    if (law.side != side) continue;
    std::vector<laws::PathNode> nodes(law.path.points.size());
    nodes.resize(laws::place_path(law.path, q.data(), u.data(), frames, nodes.data()));
    std::vector<simulation::PlanarVector> path;
    for (const laws::PathNode& node : nodes)
      path.push_back({node.position_m[0], node.position_m[1]});
    const cv::Scalar colour =
        mixed(activation_colour(picture.state.activation[m]), kSky, side == 1 ? kFar : 0);
    canvas.muscle(path, law.belly_m + 0.0035, mixed(colour, kInk, 0.45));
    canvas.muscle(path, law.belly_m, colour);
  }
}

void draw_flesh_of_leg(Canvas& canvas, const FilmModel& model, const RunnerPicture& picture,
                       int side) {
  const auto& bodies = picture.kinematics.bodies;
  const FilmModel::LegBodies& leg = model.legs[side];
  const Frame &calcn = bodies[leg.calcn], &toes = bodies[leg.toes];
  const simulation::PlanarVector hip = bodies[leg.femur].position,
                                 knee = bodies[leg.tibia].position,
                                 ankle = bodies[leg.talus].position;
  const cv::Scalar skin = mixed(kFlesh, kSky, side == 1 ? 0.5 : 0);
  canvas.flesh(hip, knee, 0.085, 0.055, skin);
  canvas.flesh(knee, between(knee, ankle, 0.3), 0.055, 0.060, skin);
  canvas.flesh(between(knee, ankle, 0.3), ankle, 0.060, 0.036, skin);
  canvas.flesh(ankle, calcn.position, 0.036, 0.040, skin);
  canvas.flesh(calcn.position, at(toes, 0.05, 0.01), 0.040, 0.026, skin);
}

void draw_leg(Canvas& canvas, const FilmModel& model, const RunnerPicture& picture, int side) {
  const auto& bodies = picture.kinematics.bodies;
  const FilmModel::LegBodies& leg = model.legs[side];
  const cv::Scalar fill = mixed(kBone, kSky, side == 1 ? kFar : 0),
                   rim = mixed(kBoneRim, kSky, side == 1 ? kFar : 0);
  const Frame &calcn = bodies[leg.calcn], &toes = bodies[leg.toes];
  const simulation::PlanarVector hip = bodies[leg.femur].position,
                                 knee = bodies[leg.tibia].position,
                                 ankle = bodies[leg.talus].position;
  canvas.bone(hip, knee, 0.030, 0.016, fill, rim);
  canvas.bone(knee, ankle, 0.027, 0.013, fill, rim);
  for (const double grown : {0.006, 0.0}) {
    const simulation::PlanarVector sole_toe = at(toes, 0.075 + grown, -0.012 - grown);
    canvas.shape({at(calcn, -0.012 - grown, 0.03),
                  at(calcn, -0.006, -0.012 - grown),
                  at(toes, 0, -0.014 - grown),
                  sole_toe,
                  at(toes, 0.07, 0.012 + grown),
                  at(toes, 0, 0.03 + grown),
                  {ankle.x, ankle.y + grown}},
                 grown > 0 ? rim : fill);
  }
  for (const osim::ContactSphere& sphere : model.spheres)
    if (sphere.body == leg.calcn || sphere.body == leg.toes)
      canvas.disc(at(bodies[sphere.body], sphere.location_m[0], sphere.location_m[1]),
                  sphere.radius_m, mixed(rim, kInk, 0.15), 1);
  draw_muscles(canvas, model, picture, side);
  for (const simulation::PlanarVector& joint : {hip, knee, ankle}) {
    canvas.disc(joint, 0.017, rim);
    canvas.disc(joint, 0.012, fill);
  }
}

void draw_trunk(Canvas& canvas, const FilmModel& model, const RunnerPicture& picture) {
  const auto& bodies = picture.kinematics.bodies;
  const Frame &pelvis = bodies[model.pelvis], &torso = bodies[model.torso],
              &head = bodies[model.head];
  const simulation::PlanarVector hip = bodies[model.legs[0].femur].position;
  canvas.flesh(at(pelvis, -0.06, -0.03), at(torso, 0.01, 0.10), 0.105, 0.100, kFlesh);
  canvas.flesh(at(torso, 0.01, 0.10), at(torso, 0.015, 0.36), 0.100, 0.118, kFlesh);
  canvas.flesh(at(torso, 0.015, 0.36), at(torso, 0.0, 0.47), 0.118, 0.055, kFlesh);
  canvas.flesh(at(torso, 0.0, 0.45), at(head, 0.01, 0.04), 0.055, 0.050, kFlesh);
  canvas.flesh(at(head, 0.012, 0.085), at(head, 0.03, 0.055), 0.108, 0.085, kFlesh);
  for (const double grown : {0.006, 0.0}) {
    const cv::Scalar colour = grown > 0 ? kBoneRim : mixed(kBone, kSky, 0.25);
    // Chest: an egg on the spine.
    std::vector<simulation::PlanarVector> chest;
    for (int i = 0; i < 32; ++i) {
      const double a = 2 * std::numbers::pi * i / 32;
      chest.push_back(at(torso, 0.020 + (0.092 - 0.012 * std::sin(a) + grown) * std::cos(a),
                         0.31 + (0.150 + grown) * std::sin(a)));
    }
    for (int vertebra = 0; vertebra < 13; ++vertebra)
      canvas.disc(at(torso, -0.012 * std::sin(vertebra * 0.5), 0.02 + 0.042 * vertebra),
                  0.020 + grown, colour);
    canvas.shape(chest, colour);
    canvas.shape({at(pelvis, -0.125 - grown, 0.055),
                  at(pelvis, -0.10, 0.095 + grown),
                  at(pelvis, -0.01, 0.055 + grown),
                  at(pelvis, 0.02 + grown, -0.01),
                  at(pelvis, -0.01, -0.085 - grown),
                  {hip.x, hip.y - 0.02 - grown},
                  at(pelvis, -0.125 - grown, -0.05)},
                 colour);
    // The head's frame sits on the neck; the skull above it.
    canvas.disc(at(head, 0.012, 0.085), 0.092 + grown, colour);
    canvas.flesh(at(head, 0.045, 0.02), at(head, 0.06, 0.035), 0.032 + grown, 0.036 + grown,
                 colour);
  }
  // Ribs.
  for (int rib = 0; rib < 5; ++rib)
    canvas.line(at(torso, -0.05, 0.24 + 0.04 * rib), at(torso, 0.085, 0.215 + 0.04 * rib), 0.006,
                mixed(kBoneRim, kBone, 0.4));
}

void draw_ground(Canvas& canvas, const RunnerPicture& picture) {
  cv::Mat& image = canvas.picture();
  const int row = static_cast<int>(canvas.place({0, 0}).y);
  for (int v = 0; v < row; ++v) {
    const double w = static_cast<double>(v) / row;
    image.row(v).setTo(mixed(cv::Scalar(250, 240, 228), kSky, w));
  }
  image.rowRange(row, image.rows).setTo(cv::Scalar(118, 148, 150));
  const double below_m = -0.6;
  for (double x = std::floor(canvas.left_m()); x < canvas.right_m(); x += 1) {
    if (static_cast<long>(std::llround(x)) % 2 == 0)
      canvas.shape({{x, 0}, {x + 1, 0}, {x + 1, below_m}, {x, below_m}}, {106, 136, 138});
    canvas.line({x, 0}, {x, -0.06}, 0.012, kInk);
    for (int tenth = 1; tenth < 10; ++tenth)
      canvas.line({x + 0.1 * tenth, 0}, {x + 0.1 * tenth, tenth == 5 ? -0.035 : -0.018}, 0.005,
                  kInk);
    const std::string label = fmt::format("{} m", std::llround(x));
    const cv::Point2d p = canvas.place({x, -0.16});
    cv::putText(image, label, {static_cast<int>(p.x) - 14, static_cast<int>(p.y)},
                cv::FONT_HERSHEY_SIMPLEX, 0.42 * kOversampling, kInk, kOversampling, cv::LINE_AA);
  }
  canvas.line({canvas.left_m(), 0}, {canvas.right_m(), 0}, 0.008, kInk);
  for (const simulation::Obstacle& obstacle : picture.obstacles) {
    canvas.disc({obstacle.x_m, obstacle.y_m}, obstacle.radius_m, cv::Scalar(70, 110, 170));
    canvas.disc({obstacle.x_m, obstacle.y_m}, obstacle.radius_m, kInk, 2);
  }
}

/// The force of the ground on a foot, from under the foot.
void draw_force(Canvas& canvas, const FilmModel& model, const RunnerPicture& picture, int side) {
  const simulation::PlanarVector force = picture.kinematics.ground_reaction_N[side];
  if (force.y < 20) return;
  const auto& bodies = picture.kinematics.bodies;
  const simulation::PlanarVector heel = bodies[model.legs[side].calcn].position,
                                 toes = bodies[model.legs[side].toes].position;
  const simulation::PlanarVector from{0.5 * (heel.x + toes.x), 0},
      to{from.x + force.x * kForce_m_N, force.y * kForce_m_N};
  const cv::Scalar green(70, 150, 40);
  canvas.line(from, to, 0.012, green);
  const double length = std::hypot(to.x - from.x, to.y);
  const simulation::PlanarVector d{(to.x - from.x) / length, to.y / length};
  canvas.shape({{to.x + 0.05 * d.x, to.y + 0.05 * d.y},
                {to.x - 0.022 * d.y, to.y + 0.022 * d.x},
                {to.x + 0.022 * d.y, to.y - 0.022 * d.x}},
               green);
}

void write(cv::Mat& image, const std::string& text, cv::Point at_px, double size) {
  cv::putText(image, text, at_px, cv::FONT_HERSHEY_SIMPLEX, size, kInk, 1, cv::LINE_AA);
}

void draw_figures(cv::Mat& image, const RunnerPicture& picture, const FilmOptions& options) {
  const double size = options.height_px / 720.0;
  const int line = static_cast<int>(36 * size), margin = static_cast<int>(20 * size);
  write(image, fmt::format("{:5.2f} s", picture.state.time_s), {margin, line}, 0.9 * size);
  write(image, fmt::format("{:5.2f} m", picture.state.q[simulation::kPelvisX]), {margin, 2 * line},
        0.9 * size);
  write(image, fmt::format("{:5.2f} m/s", picture.state.u[simulation::kPelvisX]),
        {margin, 3 * line}, 0.9 * size);
  // The scale of the muscles' colours.
  const int width = static_cast<int>(150 * size),
            top = static_cast<int>(options.height_px - 24 * size),
            left = options.width_px - width - static_cast<int>(60 * size);
  for (int i = 0; i < width; ++i)
    image(cv::Rect(left + i, top, 1, std::max(2, static_cast<int>(10 * size))))
        .setTo(activation_colour(static_cast<double>(i) / width));
  write(image, "0", {left - line / 2, top + line / 4}, 0.7 * size);
  write(image, "1", {left + width + line / 5, top + line / 4}, 0.7 * size);
  if (!options.title.empty()) {
    const int wide =
        cv::getTextSize(options.title, cv::FONT_HERSHEY_SIMPLEX, 0.9 * size, 1, nullptr).width;
    write(image, options.title, {options.width_px - wide - margin, line}, 0.9 * size);
  }
}

}  // namespace

FilmModel film_model(const osim::Model& model) {
  FilmModel film;
  const auto body = [&](const std::string& name) {
    const int index = model.body(name);
    require(index >= 0, "film: the model has no body '{}'; a runner needs one to be drawn", name);
    return index;
  };
  film.pelvis = body("pelvis");
  film.torso = body("torso");
  film.head = body("head");
  for (int side : {0, 1}) {
    const std::string suffix = side == 0 ? "_r" : "_l";
    film.legs[side] = {body("femur" + suffix), body("tibia" + suffix), body("talus" + suffix),
                       body("calcn" + suffix), body("toes" + suffix)};
  }
  film.layout = simulation::runner_layout(model);
  for (const int index : film.layout.muscle) {
    const osim::Muscle& muscle = model.muscles[index];
    FilmModel::DrawnMuscle law;
    law.path = laws::path_law(model, muscle);
    law.side = muscle.name.ends_with("_l") ? 1 : 0;
    // Strength is proportional to the cross-section.
    law.belly_m = 0.010 + 0.014 * std::sqrt(muscle.max_isometric_force_N / 5000);
    film.muscles.push_back(std::move(law));
  }
  film.spheres = model.spheres;
  for (const osim::Coordinate& coordinate : model.coordinates)
    film.default_coordinates.push_back(coordinate.default_value);
  return film;
}

simulation::PlanarVector film_place(const RunnerPicture& picture, const FilmOptions& options,
                                    simulation::PlanarVector p_m) {
  const double scale = options.height_px / options.metres_high;
  return {options.width_px / 2.0 + (p_m.x - picture.state.q[simulation::kPelvisX]) * scale,
          options.height_px * kGroundRow - p_m.y * scale};
}

cv::Mat film_frame(const FilmModel& model, const RunnerPicture& picture,
                   const FilmOptions& options) {
  Canvas canvas({options.width_px, options.height_px}, options.metres_high,
                picture.state.q[simulation::kPelvisX]);
  draw_ground(canvas, picture);
  draw_flesh_of_leg(canvas, model, picture, 1);
  draw_leg(canvas, model, picture, 1);
  draw_flesh_of_leg(canvas, model, picture, 0);
  draw_trunk(canvas, model, picture);
  draw_leg(canvas, model, picture, 0);
  for (int side : {0, 1}) draw_force(canvas, model, picture, side);
  cv::Mat frame;
  cv::resize(canvas.picture(), frame, {options.width_px, options.height_px}, 0, 0, cv::INTER_AREA);
  draw_figures(frame, picture, options);
  return frame;
}

}  // namespace stride::film
