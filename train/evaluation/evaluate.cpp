#include "train/evaluation/evaluate.h"

#include <fmt/format.h>

#include <cmath>
#include <memory>

#include "extract/io/error.h"
#include "extract/io/file.h"
#include "extract/io/json/json.h"
#include "extract/io/outputs.h"
#include "extract/skeleton/movement.h"
#include "train/film/evaluation_film.h"
#include "train/rollout/human_gait.h"
#include "train/training/runner_factory.h"
#include "train/training/train.h"

namespace stride::evaluation {
namespace fs = std::filesystem;
namespace {

using Json = nlohmann::ordered_json;

/// NaN becomes null.
Json number(double value) { return std::isfinite(value) ? Json(value) : Json(); }

Json to_json(const std::pair<double, double>& interval) {
  return {number(interval.first), number(interval.second)};
}

Json to_json(const rollout::GaitBand& band) { return {band.low, band.high}; }

/// Null at speeds at which humans do not run.
Json to_json(const std::optional<rollout::HumanGait>& human) {
  if (!human) return {};
  return {{"cadence_per_min", to_json(human->cadence_per_min)},
          {"step_length_m", to_json(human->step_length_m)},
          {"duty_factor", to_json(human->duty_factor)},
          {"flight_share", to_json(human->flight_share)}};
}

Json to_json(const rollout::GaitSummary& gait) {
  return {{"speed_m_s", number(gait.speed_m_s)},
          {"last_speed_m_s", number(gait.last_speed_m_s)},
          {"cadence_per_min", number(gait.cadence_per_min)},
          {"step_length_m", number(gait.step_length_m)},
          {"duty_factor", number(gait.duty_factor)},
          {"flight_share", number(gait.flight_share)},
          {"leg_phase", number(gait.leg_phase)},
          {"stride_s", number(gait.stride_s)},
          {"peak_ground_force_bw", number(gait.peak_ground_force_bw)}};
}

/// Null if there was no clip.
Json to_json(const std::optional<rollout::ClipSimilarity>& similarity) {
  if (!similarity) return {};
  return {{"angle_rms_deg", number(similarity->angle_rms_deg)},
          {"inside_share", number(similarity->inside_share)}};
}

/// The people whose gait it is compared with; none at speeds at which they do not run.
std::optional<rollout::HumanGait> human_of(const Evaluation& evaluation) {
  if (movement(evaluation.task.movement).compare != "runners") return std::nullopt;
  return rollout::human_gait(evaluation.gait.speed_m_s);
}

Json to_json(const Evaluation& evaluation, const fs::path& agent) {
  const EpisodeStatistics& statistics = evaluation.statistics;
  Json episodes = Json::array();
  for (const network::EpisodeSummary& episode : evaluation.episodes)
    episodes.push_back({{"seed", evaluation.first_seed + episodes.size()},
                        {"distance_m", episode.distance_m},
                        {"reward", episode.reward},
                        {"time_s", episode.time_s},
                        {"fell", episode.fell},
                        {"failed", episode.failed}});
  Json json{{"format", "stride-evaluation"},
            {"version", 1},
            {"agent", agent.filename().string()},
            {"distance_m", statistics.distance_m},
            {"distance_se_m", number(statistics.distance_se_m)},
            {"distance_95_m", to_json(statistics.distance_95_m)},
            {"finished_distance_m", number(statistics.finished_distance_m)},
            {"falls", statistics.falls},
            {"fall_share_95", to_json(statistics.fall_share_95)},
            {"median_seed", evaluation.first_seed + median_episode(evaluation.episodes)},
            {"gait", to_json(evaluation.gait)},
            {"human_at_this_speed", to_json(human_of(evaluation))},
            {"clip", to_json(evaluation.similarity)},
            {"episodes", episodes}};
  if (evaluation.task.movement != kDefaultMovement) {
    json["movement"] = evaluation.task.movement;
    json["measure"] = task::measure_of(evaluation.task.name);
  }
  return json;
}

template <typename Scalar>
rollout::Rollout record(const fs::path& agent, const training::TrainOptions& train_options,
                        const Potential* potential, environment::RunnerEnvironment& environment,
                        std::uint64_t seed) {
  environment::Observer observer =
      training::make_observer(train_options, potential, environment.spec());
  const network::Policy<Scalar> policy =
      network::load_policy<Scalar>(agent, observer.names(), environment.spec().action_names);
  return rollout::record_episode(policy, environment, observer, potential,
                                 train_options.run.action_repeat, seed);
}

}  // namespace

std::string Evaluation::brief_report() const {
  std::string text = fmt::format("{:.2f} m", statistics.distance_m);
  if (episodes.size() > 1)
    text += fmt::format(
        " ± {:.2f} over {} episodes, {:.2f} m over those that finished, {:.0f} to {:.0f} % fall",
        statistics.distance_se_m, episodes.size(), statistics.finished_distance_m,
        100 * statistics.fall_share_95.first, 100 * statistics.fall_share_95.second);
  const network::EpisodeSummary& median = episodes[median_episode(episodes)];
  if (task.movement != kDefaultMovement)
    text = fmt::format("{}: {}: {}", task.movement, task::measure_of(task.name), text);
  text += fmt::format(", {} falls, {:.1f} s; {:.2f} m/s", statistics.falls, median.time_s,
                      gait.speed_m_s);
  if (!movement(task.movement).repeats) return text;
  if (!std::isfinite(gait.duty_factor)) return text + ", too few steps to speak of a gait";
  text += fmt::format(", at last {:.2f}", gait.last_speed_m_s);
  const std::optional<rollout::HumanGait> human = human_of(*this);
  const bool compared = movement(task.movement).compare == "runners";
  const auto line = [&](const char* name, double value, rollout::GaitBand rollout::HumanGait::*band,
                        int digits) {
    text += fmt::format("\n  {:<18}{:>6.{}f}", name, value, digits);
    if (!human) return;
    const auto [low, high] = (*human).*band;
    text += fmt::format("  {} the human {:.{}f} to {:.{}f}",
                        ((*human).*band).holds(value) ? "inside" : "outside", low, digits, high,
                        digits);
  };
  line("steps/min", gait.cadence_per_min, &rollout::HumanGait::cadence_per_min, 0);
  line("m a step", gait.step_length_m, &rollout::HumanGait::step_length_m, 2);
  line("duty factor", gait.duty_factor, &rollout::HumanGait::duty_factor, 2);
  line("share in the air", gait.flight_share, &rollout::HumanGait::flight_share, 2);
  if (std::isfinite(gait.leg_phase))
    text += fmt::format("\n  {:<18}{:>6.2f}  {}", "phase of the legs", gait.leg_phase,
                        rollout::leg_pattern(gait.leg_phase));
  if (similarity)
    text += fmt::format(
        "\n  {:<18}{:>6.2f}  of the joint angles inside the clip's band, rms {:.0f} deg",
        "like the clip", similarity->inside_share, similarity->angle_rms_deg);
  return text + (human || !compared
                     ? ""
                     : "\n  humans do not run at this speed: no figures to compare with");
}

Evaluation evaluate(const fs::path& run, const EvaluateOptions& options) {
  require(options.episodes >= 1, "--episodes {}: must be at least 1", options.episodes);
  require(options.first_seed >= 0, "--first {}: must be at least 0", options.first_seed);
  const fs::path out = options.out.empty() ? run : options.out;
  check_outputs({run / "reference.calibrated.csv", options.clip},
                {{"--trajectory", options.trajectory, FileKind::calibrated},
                 {"--out", out / "evaluation.json", FileKind::json},
                 {"--out", out / "evaluation.mot", FileKind::motion},
                 {"--out", out / "evaluation.sto", FileKind::motion},
                 {"--out", options.film ? out / "evaluation.mp4" : "", FileKind::video}});
  const fs::path agent = network::agent_file(run, options.agent);
  training::TrainOptions train_options = training::load_run_options(run);
  if (options.difficulty >= 0) train_options.environment.difficulty = options.difficulty;
  if (!options.rules.empty()) train_options.environment.rules = options.rules;
  if (!options.engine.empty()) train_options.environment.engine = options.engine;
  if (options.obstacles >= 0) train_options.environment.max_obstacles = options.obstacles;
  train_options.environment.reference.clear();  // only training episodes start on it
  train_options.check();
  const training::Demonstration shaped_by = training::load_run_demonstration(train_options, run);
  const Potential* potential = shaped_by.potential ? &*shaped_by.potential : nullptr;
  const training::EnvironmentFactory make_environment =
      training::make_runners(train_options.environment, shaped_by);
  Evaluation evaluation;
  evaluation.task = train_options.environment.task;
  evaluation.first_seed = static_cast<std::uint64_t>(options.first_seed);
  evaluation.episodes = run_episodes(agent, train_options, potential, make_environment,
                                     evaluation.first_seed, options.episodes, options.threads);
  evaluation.statistics = statistics_of(evaluation.episodes);

  const std::unique_ptr<environment::Environment> made = make_environment(-1);
  auto& environment = static_cast<environment::RunnerEnvironment&>(*made);
  const osim::Model& model = environment.engine().model();
  const auto record_one = train_options.run.precision == "float" ? record<float> : record<double>;
  const rollout::Rollout median =
      record_one(agent, train_options, potential, environment,
                 evaluation.first_seed + median_episode(evaluation.episodes));
  evaluation.gait = rollout::gait_of(median, model);
  if (!options.clip.empty())
    evaluation.similarity = rollout::similarity(median, load_calibrated(options.clip), model);

  evaluation.file = out / "evaluation.json";
  write_file_atomically(evaluation.file, json_text(to_json(evaluation, agent)));
  write_file_atomically(out / "evaluation.mot", rollout::motion_file(median));
  write_file_atomically(out / "evaluation.sto", rollout::states_file(median));
  if (!options.trajectory.empty()) {
    CalibratedTrajectory own = rollout::demonstration(median, model, options.from_s);
    own.source = fs::absolute(run).lexically_normal().filename().string();
    save(own, options.trajectory);
  }
  if (options.film) {
    std::optional<film::SourceStride> source;
    if (potential != nullptr)
      source =
          film::find_source(*potential, train_options.shaping.source.empty()
                                            ? run
                                            : fs::path(train_options.shaping.source).parent_path());
    const std::string title =
        evaluation.task.movement == kDefaultMovement
            ? fmt::format("{:.1f} m", median.summary.distance_m)
            : fmt::format("{}: {:.2f} m", evaluation.task.movement, median.summary.distance_m);
    film::write_film(median, model, title, source, out / "evaluation.mp4");
  }
  return evaluation;
}

}  // namespace stride::evaluation
