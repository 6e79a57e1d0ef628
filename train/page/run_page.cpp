#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "extract/io/error.h"
#include "extract/io/file.h"
#include "extract/io/json/json.h"
#include "train/experiments/plot.h"
#include "train/page/html.h"
#include "train/page/page.h"
#include "train/page/scratch.h"
#include "train/rollout/human_gait.h"

namespace stride::page {
namespace fs = std::filesystem;
namespace {

using Json = nlohmann::ordered_json;

fs::path evaluation_file(const fs::path& run) { return run / "evaluation.json"; }

Json load_evaluation(const fs::path& run) {
  const fs::path file = evaluation_file(run);
  require(fs::exists(file), "{}: the run has not been evaluated; `stride evaluate {}` does it",
          run.string(), run.string());
  Json json = json_or_null(read_file(file));
  require(json.is_object() && json.contains("format") && json["format"] == "stride-evaluation",
          "{}: not what stride evaluate writes", file.string());
  return json;
}

double number(const Json& json, const char* key) {
  const auto found = json.find(key);
  return found != json.end() && found->is_number() ? found->get<double>() : NAN;
}

/// The gait's figures beside the band of human runners at that speed.
std::string gait_table(const Json& evaluation, int& inside, int& compared) {
  const Json gait = evaluation.value("gait", Json::object());
  const Json human = evaluation.value("human_at_this_speed", Json());
  std::vector<std::vector<std::string>> rows{{"", "agent", "human runners at this speed", ""}};
  struct Line {
    const char *key, *name;
    int digits;
  };
  for (const auto& [key, name, digits] :
       {Line{"cadence_per_min", "cadence, steps/min", 0}, Line{"step_length_m", "step, m", 2},
        Line{"duty_factor", "share of a stride that a foot stands", 2},
        Line{"flight_share", "share of the time in the air", 2}}) {
    const double value = number(gait, key);
    std::string band, verdict;
    if (human.is_object() && human.contains(key) && std::isfinite(value)) {
      const double low = human[key].at(0), high = human[key].at(1);
      const bool within = value >= low && value <= high;
      band = fmt::format("{:.{}f} to {:.{}f}", low, digits, high, digits);
      verdict = within ? "inside" : "outside";
      inside += within;
      ++compared;
    }
    rows.push_back(
        {name, std::isfinite(value) ? fmt::format("{:.{}f}", value, digits) : "–", band, verdict});
  }
  return table(rows);
}

std::string verdict(const Json& evaluation, int inside, int compared) {
  const Json gait = evaluation.value("gait", Json::object());
  const std::size_t episodes = evaluation.value("episodes", Json::array()).size();
  const double se = number(evaluation, "distance_se_m"), phase = number(gait, "leg_phase");
  const bool runs = !evaluation.contains("measure");
  const double measured = number(evaluation, "distance_m");
  std::string text = runs ? fmt::format("It comes {:.1f}", measured)
                          : fmt::format("{}: {} {:.2f}", evaluation.value("movement", ""),
                                        evaluation.value("measure", ""), measured);
  if (std::isfinite(se)) text += fmt::format(" ± {:.1f}", se);
  text += fmt::format(" m{} ({} episode{}, {} fall{})", runs ? " far" : "", episodes,
                      episodes == 1 ? "" : "s", evaluation.value("falls", 0),
                      evaluation.value("falls", 0) == 1 ? "" : "s");
  if (const double speed = number(gait, "last_speed_m_s"); std::isfinite(speed))
    text += fmt::format(", at last with {:.2f} m/s", speed);
  if (std::isfinite(phase)) text += fmt::format("; {}", rollout::leg_pattern(phase));
  if (compared > 0)
    text += fmt::format("; {} of {} figures of its gait lie inside the band of human runners",
                        inside, compared);
  return text + ".";
}

/// The run's curve, and the mean of its arm if there are other seeds of it.
std::string curve_section(const fs::path& run) {
  if (!fs::exists(run / "curve.csv")) return "";
  std::vector<fs::path> runs{run};
  const std::string name = run.filename().string();
  const auto is_number = [](const std::string& text) {
    return !text.empty() && std::ranges::all_of(text, [](char c) { return c >= '0' && c <= '9'; });
  };
  if (is_number(name)) {
    runs.clear();
    for (const auto& entry : fs::directory_iterator(run.parent_path()))
      if (is_number(entry.path().filename().string()) && fs::exists(entry.path() / "curve.csv"))
        runs.push_back(entry.path());
    std::ranges::sort(runs);
  }
  const Scratch scratch;
  experiments::plot(experiments::arms_of(runs), {.out = scratch.folder / "curve"});
  return "<h2>How it learned</h2>\n" +
         picture(data_uri(scratch.folder / "curve.svg"),
                 runs.size() > 1 ? fmt::format("Distance without noise, mean ± standard error over "
                                               "{} seeds.",
                                               runs.size())
                                 : "Distance without noise, one seed.");
}

std::string film_section(const fs::path& run) {
  for (const char* name : {"evaluation.mp4", "run.mp4"})
    if (fs::exists(run / name))
      return film(data_uri(run / name),
                  "The episode that came farthest; on the left the clip, where it was found.");
  return "";
}

}  // namespace

std::string run_page(const fs::path& given) {
  const fs::path run = fs::absolute(given / "").lexically_normal().parent_path();
  const Json evaluation = load_evaluation(run);
  std::string gait, body;
  try {
    int inside = 0, compared = 0;
    gait = gait_table(evaluation, inside, compared);
    body = fmt::format("<p class=\"verdict\">{}</p>\n",
                       escaped(verdict(evaluation, inside, compared)));
  } catch (const Json::exception&) {  // a value of another kind
    throw Error(fmt::format("{}: not what stride evaluate writes", evaluation_file(run).string()));
  }
  body += film_section(run);
  body += "<h2>Its gait</h2>\n" + gait;
  body += curve_section(run);
  body += "<h2>How it was made</h2>\n" + folded("config.toml", read_file(run / "config.toml"));
  return document(fmt::format("Run {}", run.filename().string()), body);
}

std::string experiment_page(const fs::path& given) {
  const fs::path folder = fs::exists(given / "results.md") ? given : given / "report";
  const std::string results = read_file(folder / "results.md");
  std::string title = fs::absolute(given / "").lexically_normal().parent_path().filename().string();
  if (results.starts_with("# ")) title = results.substr(2, results.find('\n') - 2);
  std::string body;
  for (const auto& [name, caption] : {std::pair{"decisions",
                                                "Against decisions, mean ± standard error over "
                                                "seeds; what is measured stands at the axis."},
                                      std::pair{"wall", "The same against wall clock."}})
    if (fs::exists(folder / fmt::format("{}.svg", name)))
      body += picture(data_uri(folder / fmt::format("{}.svg", name)), caption);
  body += markdown(results);
  for (const char* name : {"experiment.toml", "README.md"})
    if (fs::exists(folder / name)) body += folded(name, read_file(folder / name));
  return document(title, body);
}

std::string page_of(const fs::path& subject, const fs::path& video) {
  require(fs::exists(subject), "{}: no such file or folder", subject.string());
  if (!fs::is_directory(subject)) {
    std::string name = subject.string();
    if (name.ends_with(".trajectory.csv")) return clip_page(subject, video);
    // A video, or another file of the clip.
    fs::path trajectory = subject;
    for (fs::path stem = subject.filename(); stem.has_extension(); stem = stem.stem())
      if (fs::exists(trajectory =
                         subject.parent_path() / (stem.stem().string() + ".trajectory.csv")))
        return clip_page(trajectory, video);
    throw Error(
        fmt::format("{}: no NAME.trajectory.csv lies beside it; make one with `stride track`, "
                    "or give a run folder or an experiment's folder",
                    name));
  }
  if (fs::exists(subject / "config.toml")) return run_page(subject);
  require(fs::exists(subject / "results.md") || fs::exists(subject / "report/results.md"),
          "{}: neither a run folder (config.toml) nor a report of an experiment (results.md)",
          subject.string());
  return experiment_page(subject);
}

}  // namespace stride::page
