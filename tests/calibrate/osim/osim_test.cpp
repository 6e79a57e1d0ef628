#include <gtest/gtest.h>

#include <string>

#include "calibrate/osim/model.h"
#include "extract/io/file.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/throws.h"

namespace stride {
namespace {

const std::filesystem::path kData = STRIDE_TEST_DATA;

// Everything that a model says, with every digit: two models are the same if their texts are.

std::string text(const osim::SimmSpline& s) {
  return fmt::format("spline {} {}", fmt::join(s.x, " "), fmt::join(s.y, " "));
}

std::string text(const osim::TransformAxis& a) {
  return fmt::format("axis {} {} {} {} {} {} {}\n", fmt::join(a.axis, " "), a.coordinate,
                     static_cast<int>(a.kind), a.constant, a.slope, a.intercept, text(a.spline));
}

std::string text(const osim::PathPoint& p) {
  std::string all = fmt::format(
      "point {} {} {} {} {} {} {} {}", p.name, static_cast<int>(p.kind), p.body,
      fmt::join(p.kind == osim::PathPoint::Kind::moving ? osim::Vec3{} : p.location_m, " "),
      p.coordinate, p.range_min, p.range_max, fmt::join(p.location_coordinate, " "));
  for (const osim::SimmSpline& each : p.location) all += text(each);
  return all + "\n";
}

std::string text(const osim::Muscle& m) {
  std::string all = fmt::format(
      "muscle {} {} {} {} {} {} {} {} {} {} {} {} {} {} {} {} {} {} {}\n", m.name,
      m.max_isometric_force_N, m.optimal_fiber_length_m, m.tendon_slack_length_m,
      m.pennation_angle_at_optimal_rad, m.max_contraction_velocity, m.activation_time_constant_s,
      m.deactivation_time_constant_s, m.minimum_activation, m.FmaxTendonStrain, m.FmaxMuscleStrain,
      m.KshapeActive, m.KshapePassive, m.Af, m.Flen, m.fv_linear_extrap_threshold,
      m.maximum_pennation_angle_rad, m.default_fiber_length_m.value_or(-1), m.default_activation);
  for (const osim::PathPoint& each : m.path) all += text(each);
  return all;
}

std::string text(const osim::Model& m) {
  std::string all = fmt::format("{}\n{}\n{}\n", m.name, m.credits, fmt::join(m.gravity_m_s2, " "));
  for (const osim::Body& b : m.bodies)
    all += fmt::format("body {} {} {} {}\n", b.name, b.mass_kg, fmt::join(b.mass_center_m, " "),
                       fmt::join(b.inertia, " "));
  for (const osim::Coordinate& c : m.coordinates)
    all +=
        fmt::format("coordinate {} {} {} {} {} {} {} {}\n", c.name, c.rotational, c.default_value,
                    c.default_speed, c.range_min, c.range_max, c.clamped, c.locked);
  for (const osim::Joint& j : m.joints) {
    all += fmt::format("joint {} {} {} {} {} {} {} {} {}\n", j.name, static_cast<int>(j.type),
                       j.parent, j.child, fmt::join(j.location_in_parent_m, " "),
                       fmt::join(j.orientation_in_parent_rad, " "),
                       fmt::join(j.location_in_child_m, " "),
                       fmt::join(j.orientation_in_child_rad, " "), fmt::join(j.coordinates, " "));
    for (const osim::TransformAxis& each : j.transform) all += text(each);
  }
  for (const osim::Muscle& each : m.muscles) all += text(each);
  for (const osim::ContactPlane& p : m.planes)
    all += fmt::format("plane {} {}\n", p.name, p.height_m);
  for (const osim::ContactSphere& s : m.spheres)
    all += fmt::format("sphere {} {} {} {}\n", s.name, s.body, fmt::join(s.location_m, " "),
                       s.radius_m);
  for (const osim::ContactForce& c : m.contacts)
    all += fmt::format("contact {} {} {} {} {} {} {} {} {}\n", c.name, c.plane,
                       fmt::join(c.spheres, " "), c.stiffness, c.dissipation, c.static_friction,
                       c.dynamic_friction, c.viscous_friction, c.transition_velocity_m_s);
  for (const osim::CoordinateLimit& l : m.limits)
    all += fmt::format("limit {} {} {} {} {} {} {} {}\n", l.name, l.coordinate, l.upper_stiffness,
                       l.upper_limit, l.lower_stiffness, l.lower_limit, l.damping, l.transition);
  return all;
}

TEST(Osim, BothDocumentVersionsLoadToTheSameModel) {
  const osim::Model three = osim::load_osim(osim::default_model_file());
  const osim::Model four = osim::load_osim(kData / "gait9dof18musc_version40000.osim");
  EXPECT_EQ(text(three), text(four));
}

// The numbers are those that OpenSim prints for the competition's file.
TEST(Osim, LoadsTheCompetitionsFigures) {
  const osim::Model model = osim::load_osim(osim::default_model_file());
  ASSERT_EQ(model.bodies.size(), 13u);
  ASSERT_EQ(model.coordinates.size(), 10u);
  ASSERT_EQ(model.muscles.size(), 18u);
  EXPECT_NEAR(model.mass_kg(), 79.6646, 1e-10);
  const osim::Coordinate& lumbar = model.coordinates[model.coordinate("lumbar_extension")];
  EXPECT_TRUE(lumbar.locked);
  EXPECT_NEAR(lumbar.default_value, -0.139626, 1e-6);
  EXPECT_FALSE(model.coordinates[model.coordinate("pelvis_ty")].rotational);

  const osim::Muscle& vasti = model.muscles[model.muscle("vasti_l")];
  EXPECT_EQ(model.muscle("vasti_l"), 14);
  EXPECT_EQ(vasti.max_isometric_force_N, 9593.95082);
  EXPECT_EQ(vasti.KshapePassive, 9);
  EXPECT_EQ(vasti.FmaxMuscleStrain, 1);
  EXPECT_EQ(vasti.Af, 0.25);
  EXPECT_FALSE(vasti.default_fiber_length_m);
  ASSERT_EQ(vasti.path.size(), 4u);
  EXPECT_EQ(vasti.path[2].kind, osim::PathPoint::Kind::conditional);
  EXPECT_EQ(vasti.path[2].coordinate, model.coordinate("knee_angle_l"));
  EXPECT_EQ(vasti.path[3].kind, osim::PathPoint::Kind::moving);
  EXPECT_EQ(vasti.path[3].location[0].x.size(), 17u);

  ASSERT_EQ(model.contacts.size(), 2u);
  EXPECT_EQ(model.contacts[1].spheres, (std::vector<int>{2, 3}));
  EXPECT_EQ(model.contacts[0].stiffness, 6e5);
  ASSERT_EQ(model.limits.size(), 6u);
  EXPECT_EQ(model.limits[3].name, "KneeLimit_l");
  EXPECT_EQ(model.limits[3].lower_limit, -140);
  EXPECT_THAT(model.credits, testing::HasSubstr("Ajay Seth"));
}

TEST(Osim, IsDescribedForAPerson) {
  const std::string description = osim::describe(osim::load_osim(osim::default_model_file()));
  EXPECT_THAT(description, testing::HasSubstr("79.66 kg"));
  EXPECT_THAT(description, testing::HasSubstr("iliopsoas_r"));
}

class BadOsim : public testing::Test {
 protected:
  /// The default model with the first `from` replaced.
  std::filesystem::path with(const std::string& from, const std::string& to) {
    std::string content = read_file(osim::default_model_file());
    const auto at = content.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    content.replace(at, from.size(), to);
    write_file_atomically(folder_ / "bad.osim", content);
    return folder_ / "bad.osim";
  }
  TemporaryFolder folder_;
};

TEST_F(BadOsim, NamesFileLineAndElementOfWhatIsNotUnderstood) {
  const auto file = with("<CoordinateLimitForce name=\"HipLimit_r\">",
                         "<BushingForce name=\"b\"/>\n"
                         "<CoordinateLimitForce name=\"HipLimit_r\">");
  EXPECT_ERROR(osim::load_osim(file), "<BushingForce name=\"b\">: is not understood");
  const std::string content = read_file(file);
  const auto line =
      1 + std::count(content.begin(), content.begin() + content.find("<Bushing"), '\n');
  EXPECT_ERROR(osim::load_osim(file), fmt::format("bad.osim:{}: ", line));
}

TEST_F(BadOsim, RefusesAnUnknownPropertyThatMightChangeTheMotion) {
  EXPECT_ERROR(osim::load_osim(with("<dissipation>", "<adhesion>3</adhesion><dissipation>")),
               "<adhesion>: not understood inside <HuntCrossleyForce::ContactParameters>");
}

TEST_F(BadOsim, IgnoresWhatIsOnlySeen) {
  const auto file = with("<mass>11.777</mass>",
                         "<mass>11.777</mass><VisibleObject><scale_factors>1 1 1</scale_factors>"
                         "</VisibleObject><WrapObjectSet><objects/></WrapObjectSet>");
  EXPECT_EQ(text(osim::load_osim(file)), text(osim::load_osim(osim::default_model_file())));
}

TEST_F(BadOsim, LeavesOutAForceThatIsSwitchedOff) {
  const auto file = with("<CoordinateLimitForce name=\"HipLimit_r\">\n          <isDisabled>false",
                         "<CoordinateLimitForce name=\"HipLimit_r\">\n          <isDisabled>true");
  EXPECT_EQ(osim::load_osim(file).limits.size(), 5u);
}

TEST_F(BadOsim, RefusesFiguresThatAreNone) {
  EXPECT_ERROR(osim::load_osim(with("<mass>11.777</mass>", "<mass>heavy</mass>")),
               "<mass>: \"heavy\": must be finite numbers");
  EXPECT_ERROR(osim::load_osim(with("<mass>11.777</mass>", "<mass>nan</mass>")), "must be finite");
  EXPECT_ERROR(osim::load_osim(with("<mass>11.777</mass>", "")), "has no <mass>");
  EXPECT_ERROR(osim::load_osim(with("<optimal_fiber_length>0.069", "<optimal_fiber_length>0")),
               "<optimal_fiber_length>: 0: must be > 0");
}

TEST_F(BadOsim, RefusesNamesOfNothing) {
  EXPECT_ERROR(osim::load_osim(with("<parent_body>femur_r", "<parent_body>femur_x")),
               "\"femur_x\": there is no such body");
  EXPECT_ERROR(osim::load_osim(with("<coordinate>knee_angle_r", "<coordinate>elbow")),
               "\"elbow\": there is no such coordinate");
  EXPECT_ERROR(osim::load_osim(with("platform r_heel", "platform r_hell")), "\"r_hell\"");
}

TEST_F(BadOsim, RefusesOtherVersionsAndOtherFiles) {
  EXPECT_ERROR(osim::load_osim(with("Version=\"30000\"", "Version=\"20302\"")),
               "Version=\"20302\": must be 30000");
  write_file_atomically(folder_ / "other.osim", "<mujoco/>");
  EXPECT_ERROR(osim::load_osim(folder_ / "other.osim"), "not an OpenSim model");
  write_file_atomically(folder_ / "cut.osim",
                        read_file(osim::default_model_file()).substr(0, 20000));
  EXPECT_ERROR(osim::load_osim(folder_ / "cut.osim"), "not XML");
  EXPECT_ERROR(osim::load_osim(folder_ / "none.osim"), "no such file");
}

TEST_F(BadOsim, RefusesAJointThatCannotBe) {
  EXPECT_ERROR(osim::load_osim(with("<parent_body>pelvis", "<parent_body>toes_r")),
               "do not form a tree");
}

}  // namespace
}  // namespace stride
