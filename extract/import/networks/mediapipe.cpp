#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <map>

#include "extract/import/formats/formats.h"
#include "extract/import/networks/frames.h"
#include "extract/import/parsing/columns.h"
#include "extract/import/parsing/labels.h"
#include "extract/io/error.h"

namespace stride::imports {
namespace {

constexpr std::size_t kLandmarks = 33, kNone = PointColumns::kNone;
constexpr int kFewest = 6;  // landmarks of a table that is MediaPipe's

/// MediaPipe's names, in order.
constexpr std::array<std::string_view, kLandmarks> kNames{
    "nose",        "left_eye_inner",  "left_eye",        "left_eye_outer", "right_eye_inner",
    "right_eye",   "right_eye_outer", "left_ear",        "right_ear",      "mouth_left",
    "mouth_right", "left_shoulder",   "right_shoulder",  "left_elbow",     "right_elbow",
    "left_wrist",  "right_wrist",     "left_pinky",      "right_pinky",    "left_index",
    "right_index", "left_thumb",      "right_thumb",     "left_hip",       "right_hip",
    "left_knee",   "right_knee",      "left_ankle",      "right_ankle",    "left_heel",
    "right_heel",  "left_foot_index", "right_foot_index"};

std::string letters_of(std::string_view text) {
  std::string letters;
  for (const unsigned char c : text)
    if (std::isalnum(c)) letters += static_cast<char>(std::tolower(c));
  return letters;
}

/// Landmark by its number or name, as in "25", "LEFT_KNEE", "leftKnee", "landmark_25".
std::size_t landmark_of(std::string_view text) {
  std::string letters = letters_of(text);
  for (std::size_t k = 0; k < kLandmarks; ++k)
    if (letters == letters_of(kNames[k])) return k;
  for (const std::string_view prefix :
       {"poselandmark", "landmark", "keypoint", "point", "joint", "pose", "lm", "kp", "p"})
    if (letters.starts_with(prefix)) {
      letters.erase(0, prefix.size());
      break;
    }
  for (std::size_t k = 0; k < kLandmarks; ++k)
    if (letters == letters_of(kNames[k])) return k;
  if (letters.empty() || letters.size() > 2 ||
      !std::ranges::all_of(letters, [](unsigned char c) { return std::isdigit(c) != 0; }))
    return kNone;
  return static_cast<std::size_t>(std::stoi(letters));
}

/// Which number of a point a name stands for: 0 x, 1 y, 2 how well it is seen; 3 what is not used.
std::optional<std::size_t> component_of(std::string_view name) {
  const std::string letters = letters_of(name);
  if (letters == "x") return 0;
  if (letters == "y") return 1;
  if (letters == "z" || letters == "presence") return 3;
  for (const std::string_view seen : {"v", "vis", "visibility", "c", "conf", "confidence", "score"})
    if (letters == seen) return 2;
  return std::nullopt;
}

/// A column of a row a frame, as in "LEFT_KNEE_x", "x_25", "x25", "landmark_25_visibility".
struct Column {
  std::size_t landmark = kNone, component = 0;
};
std::optional<Column> column_of(std::string_view name) {
  const auto parted = [](std::string_view component, std::string_view landmark) {
    std::optional<Column> column;
    if (const auto k = component_of(component))
      if (const std::size_t l = landmark_of(landmark); l != kNone) column = Column{l, *k};
    return column;
  };
  const std::size_t last = name.find_last_of("_. -:"), first = name.find_first_of("_. -:");
  if (last != name.npos) {
    if (const auto column = parted(name.substr(last + 1), name.substr(0, last))) return column;
    return parted(name.substr(0, first), name.substr(first + 1));
  }
  const std::size_t digit = name.find_first_of("0123456789");
  if (digit == 0) {
    const std::size_t letter = name.find_first_not_of("0123456789");
    return letter == name.npos ? std::nullopt : parted(name.substr(letter), name.substr(0, letter));
  }
  return digit == name.npos ? std::nullopt : parted(name.substr(0, digit), name.substr(digit));
}

/// The index of the first column with one of these names, compared without case and signs.
std::size_t find(const TextLine& header, std::initializer_list<std::string_view> names) {
  for (const std::string_view name : names)
    for (std::size_t c = 0; c < header.cells.size(); ++c)
      if (letters_of(header.cells[c]) == name) return c;
  return kNone;
}

/// Where a table has what.
struct Layout {
  std::size_t frame = kNone, person = kNone;
  // A row a landmark:
  std::size_t landmark = kNone, x = kNone, y = kNone, seen = kNone;
  // A row a frame; of each landmark x, y and how well it is seen:
  std::array<std::array<std::size_t, 3>, kLandmarks> wide;
  int landmarks = 0;  // with x and y

  bool is_long() const { return landmark != kNone && x != kNone && y != kNone; }
};

Layout layout_of_table(const TextLine& header) {
  Layout layout;
  layout.frame = find(header, {"frame", "frameid", "frameidx", "frameindex", "framenumber",
                               "framenum", "frameno", "image", "imageid"});
  layout.person = find(header, {"person", "personid", "pose", "poseid", "poseindex", "trackid"});
  layout.landmark =
      find(header, {"landmark", "landmarkid", "landmarkindex", "landmarkidx", "landmarkname",
                    "keypoint", "keypointid", "joint", "jointid", "point", "name", "id"});
  layout.x = find(header, {"x"});
  layout.y = find(header, {"y"});
  layout.seen = find(header, {"visibility", "vis", "v", "confidence", "score"});
  for (auto& columns : layout.wide) columns.fill(kNone);
  std::map<std::size_t, std::array<std::size_t, 3>> found;
  for (std::size_t c = 0; c < header.cells.size(); ++c) {
    const auto column = column_of(header.cells[c]);
    if (!column || column->component > 2 || column->landmark > kLandmarks) continue;
    auto& columns =
        found.try_emplace(column->landmark, std::array{kNone, kNone, kNone}).first->second;
    if (columns[column->component] == kNone) columns[column->component] = c;
  }
  // Numbers to 33 count from 1.
  const std::size_t from = found.contains(kLandmarks) && !found.contains(0) ? 1 : 0;
  for (const auto& [landmark, columns] : found) {
    if (landmark - from >= kLandmarks || columns[0] == kNone || columns[1] == kNone) continue;
    layout.wide[landmark - from] = columns;
    ++layout.landmarks;
  }
  return layout;
}

double seen(double visibility) {
  return kSurestNetwork * (std::isfinite(visibility) ? std::clamp(visibility, 0.0, 1.0) : 1.0);
}

const LabelMap& map_of_landmarks() {
  static const LabelMap map(layout_of(kLandmarks), {}, "MediaPipe");
  return map;
}

using Landmarks = std::vector<Point>;

void add_person(int frame, const std::string& id, const Landmarks& points, ImportedFile& content) {
  content.people.push_back({frame, id, map_of_landmarks().parts(points)});
}

Point point_in(const TextLine& line, const std::array<std::size_t, 3>& columns,
               const std::string& file) {
  const double visibility = columns[2] == kNone ? 1 : number_in(line, columns[2], file);
  return {{number_in(line, columns[0], file), number_in(line, columns[1], file)},
          Source::detected,
          seen(visibility)};
}

ImportedFile read_table(std::string_view text, const std::string& file) {
  const std::vector<TextLine> lines = read_text_table(text, file).lines;
  require(!lines.empty(), "{}:1: expected a header with MediaPipe's landmarks", file);
  const Layout layout = layout_of_table(lines.front());
  require(layout.is_long() || layout.landmarks >= kFewest,
          "{}:{}: expected columns like LEFT_KNEE_x, x25 or landmark_25_x, or landmark, x, y", file,
          lines.front().number);
  ImportedFile content;
  std::map<std::pair<int, std::string>, Landmarks> long_form;
  for (std::size_t i = 1; i < lines.size(); ++i) {
    const TextLine& line = lines[i];
    check_width(line, lines.front(), file);
    const std::string id = layout.person == kNone ? "" : line.cells[layout.person];
    const int frame =
        layout.frame == kNone ? static_cast<int>(i) - 1 : frame_in(line, layout.frame, file);
    if (layout.landmarks >= kFewest) {
      Landmarks points(kLandmarks);
      for (std::size_t k = 0; k < kLandmarks; ++k)
        if (layout.wide[k][0] != kNone) points[k] = point_in(line, layout.wide[k], file);
      add_person(frame, id, points, content);
      continue;
    }
    require(layout.frame != kNone, "{}:{}: expected a column 'frame' beside '{}'", file,
            lines.front().number, lines.front().cells[layout.landmark]);
    const std::size_t k = landmark_of(line.cells[layout.landmark]);
    require(k < kLandmarks, "{}:{}: '{}': expected one of MediaPipe's landmarks, 0 to 32 or a name",
            file, line.number, line.cells[layout.landmark]);
    Landmarks& points = long_form.try_emplace({frame, id}, Landmarks(kLandmarks)).first->second;
    points[k] = point_in(line, {layout.x, layout.y, layout.seen}, file);
  }
  for (const auto& [key, points] : long_form) add_person(key.first, key.second, points, content);
  return content;
}

/// {x, y, visibility}, or [x, y, z, visibility].
Point point_of(const JsonValue& value) {
  if (value.is_null()) return {};
  if (value.is_array()) {
    const std::vector<double> numbers = value.numbers();
    if (numbers.size() < 2) value.fail("x, y, z and visibility");
    return {{numbers[0], numbers[1]}, Source::detected, seen(numbers.size() > 3 ? numbers[3] : 1)};
  }
  const auto visibility = first_of(value, {"visibility", "v", "score", "confidence"});
  return {{value["x"].number(), value["y"].number()},
          Source::detected,
          seen(visibility && visibility->is_number() ? visibility->number() : 1)};
}

bool is_point(const JsonValue& value) {
  return (value.has("x") && value.has("y")) ||
         (value.is_array() && value.size() >= 2 && value[0].is_number());
}

/// The landmarks of one person: a list of 33, or an object by name.
Landmarks landmarks_of(const JsonValue& person) {
  Landmarks points(kLandmarks);
  if (person.is_object()) {
    for (const std::string& key : person.keys())
      if (const std::size_t k = landmark_of(key); k < kLandmarks && is_point(person[key]))
        points[k] = point_of(person[key]);
    return points;
  }
  for (std::size_t i = 0; i < person.size(); ++i) {
    std::size_t k = i;
    if (const auto name = first_of(person[i], {"name", "landmark", "id", "index"}))
      k = landmark_of(name_of(name));
    else if (person.size() != kLandmarks)
      person.fail(fmt::format("33 landmarks ({} here)", person.size()));
    if (k < kLandmarks) points[k] = point_of(person[i]);
  }
  return points;
}

ImportedFile read_json(std::string_view text, const std::string& file) {
  const JsonFile json(text, file);
  ImportedFile content;
  const JsonValue root = json.root();
  const auto is_person = [](const JsonValue& value) {
    if (value.is_array()) return value.size() > 0 && is_point(value[0]);
    if (!value.is_object()) return false;
    return std::ranges::any_of(value.keys(), [&](const std::string& key) {
      return landmark_of(key) < kLandmarks && is_point(value[key]);
    });
  };
  const auto add = [&](int frame, const JsonValue& people) {
    if (is_person(people))
      add_person(frame, "", landmarks_of(people), content);
    else if (people.is_array())
      for (std::size_t i = 0; i < people.size(); ++i)
        if (!people[i].is_null() && is_person(people[i]))
          add_person(frame, "", landmarks_of(people[i]), content);
  };
  if (is_person(root)) {  // one frame
    add(0, root);
    return content;
  }
  for (const auto& [frame, value] : frames_of(root)) {
    if (value.is_null()) continue;
    auto landmarks = first_of(value, {"pose_landmarks", "poseLandmarks", "landmarks", "keypoints",
                                      "pose", "landmark", "poses"});
    if (landmarks && landmarks->is_object())
      if (const auto inner = first_of(*landmarks, {"landmark", "landmarks"})) landmarks = inner;
    if (landmarks)
      add(frame, *landmarks);
    else if (value.is_array() || is_person(value))
      add(frame, value);
  }
  return content;
}

/// Whether a table's header names MediaPipe's landmarks.
bool is_mediapipe(const TextLine& header) {
  if (header.cells.empty()) return false;
  const Layout layout = layout_of_table(header);
  const bool own = std::ranges::any_of(
      header.cells, [](const std::string& cell) { return cell.ends_with("_confidence"); });
  // A table of ours may have some of the names.
  const int fewest = header.cells.front() == "frame" ? 20 : kFewest;
  return !own && ((layout.is_long() && layout.frame != kNone) || layout.landmarks >= fewest);
}

ImportedFile read_mediapipe(std::string_view text, const std::string& file,
                            const ImportOptions& /*options*/) {
  const auto start = text.find_first_not_of(" \t\n");
  const bool json = start != text.npos && (text[start] == '[' || text[start] == '{');
  ImportedFile content = json ? read_json(text, file) : read_table(text, file);
  tell_normalised(content);
  return content;
}

}  // namespace

/// MediaPipe's 33 landmarks: a table with a row a frame or a row a landmark, or JSON with a list of
/// landmarks a frame. Coordinates are shares of the picture, or pixels where they exceed 2.
const Format formats::mediapipe{[](const FileText& text) {
                                  if (!text.is_json())
                                    return if_so(is_mediapipe(text.header()), Certainty::perhaps);
                                  return if_so(
                                      is_of_a_network(text) && !text.has("\"visible\"") &&
                                          (text.has("\"visibility\"") || text.has("andmarks\"")),
                                      Certainty::certain);
                                },
                                read_mediapipe, /*in_folders=*/true};

}  // namespace stride::imports
