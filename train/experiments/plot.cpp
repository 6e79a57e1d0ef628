#include "train/experiments/plot.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <thread>

#include "extract/io/error.h"
#include "extract/io/file.h"
#include "extract/io/gnuplot.h"
#include "extract/io/outputs.h"
#include "extract/io/table.h"
#include "train/experiments/curve_axis.h"
#include "train/training/curve.h"

namespace stride::experiments {
namespace fs = std::filesystem;
namespace {

constexpr int kPoints = 200;  // of each line

struct Curve {
  std::vector<double> x, y;

  /// Linear between rows.
  double at(double where) const {
    const auto above = std::ranges::lower_bound(x, where);
    if (above == x.begin()) return y.front();
    if (above == x.end()) return y.back();
    const auto i = static_cast<std::size_t>(above - x.begin());
    const double share = (where - x[i - 1]) / (x[i] - x[i - 1]);
    return y[i - 1] + share * (y[i] - y[i - 1]);
  }
};

Curve load_curve(const fs::path& run, const PlotOptions& options) {
  const CurveAxis& axis = curve_axis(options.against);
  const Table curve = load_run_curve(run, axis);
  const std::size_t x = curve.column(axis.column), y = curve.column(options.column);
  Curve result;
  for (const auto& row : curve.rows)
    if (std::isfinite(row[y])) {
      result.x.push_back(axis.seconds ? row[x] / 3600 : row[x]);
      result.y.push_back(row[y]);
    }
  require(!result.x.empty(), "{}: no figures of {} yet", run.string(), options.column);
  return result;
}

struct Band {
  std::string label;
  std::vector<double> x, mean, se;
};

Band band_of(const Arm& arm, const PlotOptions& options) {
  std::vector<Curve> curves;
  double end = std::numeric_limits<double>::infinity();
  for (const fs::path& run : arm.runs) {
    curves.push_back(load_curve(run, options));
    end = std::min(end, curves.back().x.back());
  }
  const auto n = static_cast<double>(curves.size());
  Band band{.label = fmt::format("{} ({} seed{})", arm.label, n, n == 1 ? "" : "s"),
            .x = {},
            .mean = {},
            .se = {}};
  for (int i = 0; i < kPoints; ++i) {
    const double x = end * i / (kPoints - 1);
    double sum = 0, squares = 0;
    for (const Curve& curve : curves) sum += curve.at(x);
    for (const Curve& curve : curves) squares += std::pow(curve.at(x) - sum / n, 2);
    band.x.push_back(x);
    band.mean.push_back(sum / n);
    band.se.push_back(n > 1 ? std::sqrt(squares / (n - 1) / n) : 0);
  }
  return band;
}

std::string data_of(const std::vector<Band>& bands) {
  std::string text = "# x, mean, standard error; one block an arm\n";
  for (const Band& band : bands) {
    text += fmt::format("# {}\n", gnuplot_string(band.label));
    for (std::size_t i = 0; i < band.x.size(); ++i)
      text += fmt::format("{},{},{}\n", band.x[i], band.mean[i], band.se[i]);
    text += "\n\n";
  }
  return text;
}

/// What the evaluations of these runs measure.
std::string measure_of(const std::vector<Arm>& arms) {
  std::string measure;
  for (const Arm& arm : arms)
    for (const fs::path& run : arm.runs) {
      const Table curve = load_table(run / "curve.csv", "curve", 1);
      const std::string own =
          curve.has_meta("measure") ? curve.meta("measure") : "distance in 10 s";
      require(measure.empty() || measure == own,
              "{}: measures the {}, the runs before it the {}: plot them apart", run.string(), own,
              measure);
      measure = own;
    }
  return measure;
}

std::string script_of(const std::vector<Band>& bands, const PlotOptions& options,
                      const std::string& measure) {
  const std::string name = options.out.filename().string();
  const CurveAxis& axis = curve_axis(options.against);
  const bool crowded = bands.size() > 4;
  double end = 0;
  for (const Band& band : bands) end = std::max(end, band.x.back());
  const bool millions = !axis.seconds && end > 1e6;  // the format's %c would label many tics 1M
  const char* x = millions ? "($1/1e6)" : "1";
  std::string label = axis.quantity;
  if (axis.seconds) label += " (h)";
  if (millions) label += " (millions)";
  std::string lines;
  for (std::size_t i = 0; i < bands.size(); ++i) {
    const char* colour = kLineColours[i % kLineColours.size()];
    lines += fmt::format(
        "{} {} index {} using {}:($2-$3):($2+$3) with filledcurves fc rgb '{}' fs "
        "transparent solid {} noborder notitle, \\\n  '' index {} using {}:2 with lines lw 2 lc "
        "rgb '{}' title {} noenhanced",
        i == 0 ? "plot" : ", \\\n ", gnuplot_file(name + ".csv"), i, x, colour, crowded ? 0.1 : 0.2,
        i, x, colour, gnuplot_string(bands[i].label));
  }
  if (!options.level.label.empty())
    lines += fmt::format(", \\\n  {} with lines lw 2 dt 2 lc rgb 'black' title {} noenhanced",
                         options.level.value, gnuplot_string(options.level.label));
  std::string script = fmt::format(
      "# Run gnuplot on this file in its folder. Mean and standard error over seeds.\n"
      "set datafile separator ','\nset {}\nset grid lc rgb '#dddddd'\n"
      "set autoscale xfix\nset format x '{}'\nset xlabel '{}'\nset ylabel {} noenhanced\n"
      "set title {} noenhanced\n",
      crowded ? "key outside right top Left reverse" : "rmargin 5\nset key left top",
      axis.seconds || millions ? "%g" : "%.0s%c", label,
      gnuplot_string(options.column == "evaluation_distance_m" ? measure + " (m)" : options.column),
      gnuplot_string(options.title));
  for (const auto& [terminal, extension] :
       {std::pair{"svg size 720,420 font 'sans,12' background rgb 'white'", "svg"},
        std::pair{"pngcairo size 1440,840 font 'sans,20'", "png"}})
    script += fmt::format("set terminal {}\nset output {}\n{}\nunset output\n", terminal,
                          gnuplot_file(fmt::format("{}.{}", name, extension)), lines);
  return script;
}

void check_files(const std::vector<Arm>& arms, const fs::path& out) {
  std::vector<fs::path> inputs;
  for (const Arm& arm : arms)
    for (const fs::path& run : arm.runs)
      inputs.insert(inputs.end(), {run / "curve.csv", run / "timing.csv"});
  check_outputs(inputs, {{"-o", out.string() + ".csv", FileKind::plot_data},
                         {"-o", out.string() + ".gnuplot", FileKind::gnuplot_script},
                         {"-o", out.string() + ".svg", FileKind::svg},
                         {"-o", out.string() + ".png", FileKind::image}});
}

}  // namespace

std::vector<Arm> arms_of(const std::vector<fs::path>& runs) {
  std::vector<std::pair<fs::path, Arm>> arms;  // by the folder that the label is of
  for (const fs::path& given : runs) {
    const fs::path run = fs::absolute(given / "").lexically_normal().parent_path();
    const bool is_seed =
        std::ranges::all_of(run.filename().string(), [](char c) { return c >= '0' && c <= '9'; });
    const fs::path folder = is_seed ? run.parent_path() : run;
    auto arm = std::ranges::find(arms, folder, &std::pair<fs::path, Arm>::first);
    if (arm == arms.end()) {
      arms.push_back({folder, {folder.filename().string(), {}}});
      arm = std::prev(arms.end());
    }
    arm->second.runs.push_back(run);
  }
  std::vector<Arm> result;
  for (auto& [folder, arm] : arms) result.push_back(std::move(arm));
  return result;
}

void plot(const std::vector<Arm>& arms, const PlotOptions& options) {
  require(!arms.empty(), "name at least one run folder");
  check_files(arms, options.out);
  std::vector<Band> bands;
  for (const Arm& arm : arms) bands.push_back(band_of(arm, options));
  const fs::path folder = fs::absolute(options.out).parent_path();
  const std::string name = options.out.filename().string();
  const std::string script = script_of(bands, options, measure_of(arms));
  write_file_atomically(folder / (name + ".csv"), data_of(bands));
  write_file_atomically(folder / (name + ".gnuplot"), script);
  run_gnuplot(script, folder);
}

void watch(const std::vector<Arm>& arms, const PlotOptions& options, const std::atomic<bool>& stop,
           std::FILE* messages) {
  constexpr auto kInterval = std::chrono::milliseconds(300);
  std::vector<fs::file_time_type> drawn;
  for (; !stop; std::this_thread::sleep_for(kInterval)) {
    std::vector<fs::file_time_type> written;
    std::error_code missing;
    for (const Arm& arm : arms)
      for (const fs::path& run : arm.runs)
        written.push_back(fs::last_write_time(run / "curve.csv", missing));
    if (written == drawn) continue;
    drawn = written;
    std::string report = fmt::format("{}.png drawn", options.out.string());
    try {
      plot(arms, options);
    } catch (const Error& error) {
      report = fmt::format("waiting: {}", error.what());
    }
    if (messages != nullptr) fmt::print(messages, "{}\n", report), std::fflush(messages);
  }
}

}  // namespace stride::experiments
