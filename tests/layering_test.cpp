// The layering: which room may include from which, how many units a room has, and no include cycles
// of more than two units.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <functional>
#include <map>
#include <regex>
#include <set>
#include <string>
#include <vector>

namespace {

namespace fs = std::filesystem;

/// The rooms in the order of the pipeline. A room includes from itself and from rooms above it in
/// this list. `commands` are the files of the command line, which know everything in their folder.
const std::vector<std::string> kRooms{
    "extract/io", "extract/io/json", "extract/parallel", "extract/skeleton", "extract/video",
    "extract/import/parsing", "extract/import/formats", "extract/import/networks", "extract/import",
    "extract/pose/tflite", "extract/pose", "extract/tracking/gaussian_process", "extract/tracking",
    "extract/annotation", "extract/annotation/session", "extract/commands",
    //
    "calibrate/osim", "calibrate/runner", "calibrate/fit/solver", "calibrate/fit", "calibrate/gait",
    "calibrate/aperiodic", "calibrate", "calibrate/report", "calibrate/commands",
    //
    "shaping", "shaping/pipeline", "shaping/commands",
    //
    "train/simulation/engine", "train/simulation/laws", "train/simulation/integration",
    "train/simulation/simd", "train/simulation/simbody", "train/simulation/planar",
    "train/simulation/competition", "train/simulation", "train/task", "train/environment",
    "train/network", "train/ddpg", "train/training", "train/ppo", "train/rollout", "train/film",
    "train/evaluation", "train/experiments", "train/page", "train/python", "train/commands"};

constexpr std::size_t kMostUnits = 12;  // of a room
constexpr std::size_t kLargestKnot = 2;

/// PATH/NAME of PATH/NAME.h and PATH/NAME.cpp.
struct Unit {
  std::string room;
  std::set<std::string> includes;  // units
};

std::string room_of(const fs::path& unit) {
  const std::string folder = unit.parent_path().generic_string();
  const std::string name = unit.filename().string();
  const bool command = name == "commands" || name.ends_with("_command");
  return command ? folder.substr(0, folder.find('/')) + "/commands" : folder;
}

std::map<std::string, Unit> units() {
  const fs::path root = STRIDE_SOURCE_DIR;
  const std::regex include(R"re(^\s*#include "([^"]+)\.h")re");
  std::map<std::string, Unit> result;
  for (const char* folder : {"extract", "calibrate", "shaping", "train"})
    for (const auto& entry : fs::recursive_directory_iterator(root / folder)) {
      const std::string extension = entry.path().extension().string();
      if (extension != ".h" && extension != ".cpp") continue;
      fs::path path = fs::relative(entry.path(), root).replace_extension();
      Unit& unit = result[path.generic_string()];
      unit.room = room_of(path);
      std::ifstream file(entry.path());
      for (std::string line; std::getline(file, line);)
        if (std::smatch match; std::regex_search(line, match, include))
          if (match[1] != path.generic_string()) unit.includes.insert(match[1]);
    }
  return result;
}

std::ptrdiff_t order(const std::string& room) {
  return std::ranges::find(kRooms, room) - kRooms.begin();
}

/// Strongly connected components with more than one unit (Tarjan 1972).
std::vector<std::vector<std::string>> knots(const std::map<std::string, Unit>& units) {
  std::map<std::string, int> index, low;
  std::vector<std::string> stack;
  std::set<std::string> on_stack;
  std::vector<std::vector<std::string>> result;
  const std::function<void(const std::string&)> visit = [&](const std::string& name) {
    const int number = static_cast<int>(index.size());
    index[name] = low[name] = number;
    stack.push_back(name);
    on_stack.insert(name);
    for (const std::string& next : units.at(name).includes) {
      if (!units.contains(next)) continue;
      if (!index.contains(next)) {
        visit(next);
        low[name] = std::min(low[name], low[next]);
      } else if (on_stack.contains(next)) {
        low[name] = std::min(low[name], index[next]);
      }
    }
    if (low[name] != index[name]) return;
    std::vector<std::string> knot;
    do {
      knot.push_back(stack.back());
      on_stack.erase(stack.back());
      stack.pop_back();
    } while (knot.back() != name);
    if (knot.size() > 1) result.push_back(knot);
  };
  for (const auto& [name, unit] : units)
    if (!index.contains(name)) visit(name);
  return result;
}

TEST(Rooms, AreAllInThePipeline) {
  const auto all = units();
  ASSERT_GT(all.size(), 100U);
  for (const auto& [name, unit] : all)
    EXPECT_LT(order(unit.room), std::ssize(kRooms))
        << name << ": the room " << unit.room << " is not in the list of this test";
}

TEST(Rooms, NoArrowRunsBack) {
  const auto all = units();
  for (const auto& [name, unit] : all)
    for (const std::string& included : unit.includes) {
      if (!all.contains(included)) continue;
      EXPECT_LE(order(room_of(included)), order(unit.room))
          << name << " includes " << included << ": " << unit.room << " comes before "
          << room_of(included);
    }
}

TEST(Rooms, HaveAtMostADozenUnits) {
  std::map<std::string, std::size_t> count;
  for (const auto& [name, unit] : units()) ++count[unit.room];
  for (const auto& [room, number] : count) EXPECT_LE(number, kMostUnits) << room;
}

TEST(Rooms, HoldNoKnot) {
  for (const auto& knot : knots(units())) {
    std::string text;
    for (const std::string& unit : knot) text += " " + unit;
    EXPECT_LE(knot.size(), kLargestKnot) << "these include one another:" << text;
  }
}

TEST(Rooms, OnlyOneSaysSimbody) {
  const fs::path root = STRIDE_SOURCE_DIR;
  const std::regex simbody(R"(SimTK::|#include [<"]S(imbody|imTK))");
  for (const auto& [name, unit] : units()) {
    if (unit.room == "train/simulation/simbody") continue;
    for (const char* extension : {".h", ".cpp"}) {
      std::ifstream file(root / (name + extension));
      const std::string text((std::istreambuf_iterator<char>(file)), {});
      EXPECT_FALSE(std::regex_search(text, simbody)) << name << extension;
    }
  }
}

}  // namespace
