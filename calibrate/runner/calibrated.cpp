#include "calibrate/runner/calibrated.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string_view>

#include "extract/io/error.h"
#include "extract/io/table.h"
#include "extract/skeleton/movement.h"

namespace stride {
namespace {

constexpr int kVersion = 1;

/// The numbers of the preamble, by the names they have in the file.
template <typename Calibrated, typename Visit>
void visit_numbers(Calibrated& run, Visit visit) {
  visit("period_s", run.period_s);
  visit("period_sd_s", run.period_sd_s);
  visit("take_off_s", run.take_off_s);
  visit("landing_s", run.landing_s);
  visit("speed_m_s", run.speed_m_s);
  visit("metres_per_pixel", run.metres_per_pixel);
  visit("camera_roll_rad", run.camera_roll_rad);
  visit("rms_px", run.rms_px);
  visit("rms_m", run.rms_m);
}

/// Every cell of a sample, by the name of its column.
template <typename Sample, typename Visit>
void visit_cells(Sample& sample, const std::vector<BodyPart>& parts, Visit visit) {
  visit("time_s", sample.time_s);
  visit("phase", sample.phase);
  for (std::size_t i = 0; i < kCoordinateNames.size(); ++i)
    visit(kCoordinateNames[i], sample.coordinates[i]);
  visit("pelvis_ty_sd", sample.pelvis_height_sd_m);
  for (const BodyPart part : parts) {
    auto& p = sample.p_m[index(part)];
    auto& sd = sample.sd_m[index(part)];
    visit(fmt::format("{}_x", name(part)), p.x());
    visit(fmt::format("{}_y", name(part)), p.y());
    visit(fmt::format("{}_x_sd", name(part)), sd.x());
    visit(fmt::format("{}_y_sd", name(part)), sd.y());
  }
}

/// Angles in rad, the pelvis at a height that a runner reaches.
void require_coordinates(const CalibratedSample& sample, const std::string& where) {
  constexpr double kMost_rad = 2 * std::numbers::pi, kLowest_m = -1, kHighest_m = 5;
  for (std::size_t i = 0; i < kCoordinateNames.size(); ++i) {
    const std::string_view name = kCoordinateNames[i];
    const double value = sample.coordinates[i];
    if (name == "pelvis_ty")
      require(value >= kLowest_m && value <= kHighest_m,
              "{}: {} = {:.6g}: must be the pelvis' height above the ground in m", where, name,
              value);
    else if (name != "pelvis_tx")
      require(std::abs(value) <= kMost_rad, "{}: {} = {:.6g}: must be in rad, within a turn", where,
              name, value);
  }
}

}  // namespace

std::array<Eigen::Vector2d, kBodyPartCount> CalibratedSample::unknown_points() {
  std::array<Eigen::Vector2d, kBodyPartCount> points;
  points.fill(Eigen::Vector2d::Constant(std::numeric_limits<double>::quiet_NaN()));
  return points;
}

void forget_heels(CalibratedSample& sample) {
  for (const BodyPart part : kBodyParts)
    if (is_heel(part)) sample.p_m[index(part)].setConstant(CalibratedTrajectory::kUnknown);
}

CalibratedTrajectory load_calibrated(const std::filesystem::path& file) {
  const Table table = load_csv(file);
  require(table.format != "trajectory",
          "{0}: is a trajectory in pixels, a calibrated one in metres is needed; run `stride "
          "calibrate {0}` first",
          file.string());
  load_table(file, "calibrated", kVersion);
  require(table.meta("unit") == "m", "{}: unit = '{}': a calibrated trajectory is in m",
          file.string(), table.meta("unit"));
  CalibratedTrajectory run;
  run.source = table.meta("source");
  run.source_sha256 = table.meta("source_sha256");
  if (table.has_meta("movement"))
    run.movement = movement(table.meta("movement"), file.string() + ": movement").name;
  run.model = table.meta("model");
  run.verdict = table.meta("verdict");
  visit_numbers(run, [&](const char* key, double& value) {
    if (table.has_meta(key)) value = table.meta_number(key);
  });
  require(run.period_s > 0 && std::isfinite(run.period_s),
          "{}: period_s = {}: must be positive: the stride of a run has a duration", file.string(),
          run.period_s);

  const std::vector<BodyPart> parts = parts_in_file(
      [&](BodyPart part) { return table.has_column(fmt::format("{}_x", name(part))); });
  for (std::size_t i = 0; i < table.rows.size(); ++i) {
    CalibratedSample& sample = run.samples.emplace_back();
    visit_cells(sample, parts, [&](const std::string& column, double& value) {
      const bool deviation = column.ends_with("_sd");
      if (deviation && !table.has_column(column)) return;
      value = table.rows[i][table.column(column)];
      require(deviation || std::isfinite(value), "{}: row {}: {} = {}: must be a finite number",
              file.string(), i + 1, column, value);
    });
    require(i == 0 || sample.time_s > run.samples[i - 1].time_s,
            "{}: row {}: time_s = {}: must grow from row to row", file.string(), i + 1,
            sample.time_s);
    require_coordinates(sample, fmt::format("{}: row {}", file.string(), i + 1));
  }
  require(run.samples.size() >= 2, "{}: {} rows: at least one stride is needed", file.string(),
          run.samples.size());
  return run;
}

void save(const CalibratedTrajectory& run, const std::filesystem::path& file) {
  Table table;
  table.format = "calibrated";
  table.version = kVersion;
  table.set_meta("unit", "m");
  table.set_meta("source", run.source);
  table.set_meta("source_sha256", run.source_sha256);
  if (run.movement != kDefaultMovement) table.set_meta("movement", run.movement);
  table.set_meta("model", run.model);
  visit_numbers(run, [&](const char* key, double value) {
    if (std::isfinite(value)) table.set_meta(key, fmt::format("{}", value));
  });
  table.set_meta("verdict", run.verdict);
  const std::vector<BodyPart> parts = parts_in_file([&](BodyPart part) {
    return std::ranges::all_of(
        run.samples, [&](const CalibratedSample& sample) { return sample[part].allFinite(); });
  });
  const CalibratedSample none;
  visit_cells(none, parts,
              [&](const std::string& column, double) { table.columns.push_back(column); });
  for (const CalibratedSample& sample : run.samples) {
    auto& row = table.rows.emplace_back();
    visit_cells(sample, parts, [&](const std::string&, double value) { row.push_back(value); });
  }
  save(table, file);
}

}  // namespace stride
