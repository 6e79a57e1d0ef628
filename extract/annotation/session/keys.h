#pragma once

#include <string>
#include <vector>

namespace stride::annotation {

/// The actions of keys in the window.
enum class Command {
  none,
  previous_frame,
  next_frame,
  previous_clicked,
  next_clicked,
  next_phase,
  next_worst,
  next_suspect,
  first_frame,
  last_frame,
  choose_part,
  absent,
  accept,
  erase,
  copy,
  nudge_up,
  nudge_down,
  nudge_left,
  nudge_right,
  swap_legs,
  begin_range,
  trim,
  undo,
  redo,
  zoom,
  zoom_to_runner,
  play,
  toggle_hips,
  toggle_head,
  finer_phases,
  coarser_phases,
  floor_line,
  floor_from_feet,
  calibration_line,
  slow_motion,
  treadmill,
  notes,
  ask_again,
  cancel,
  save,
  help,
  quit
};

struct KeyHelp {
  std::string keys;  // as on the keyboard
  std::string does;
};

/// The action of a key from cv::waitKeyEx. Qt reports letters in lower case without shift or
/// control, so only letters and digits are used.
Command command_of(int key);

/// For the help overlay and the README, in order.
const std::vector<KeyHelp>& key_help();

namespace key {
inline constexpr int kEnter = 13, kEscape = 27, kBackspace = 8, kTab = 9, kSpace = 32;
inline constexpr int kLeft = 65361, kUp = 65362, kRight = 65363, kDown = 65364;
inline constexpr int kHome = 65360, kEnd = 65367, kDelete = 65535, kF1 = 65470;
inline constexpr int kShift = 65505, kAlt = 65513;
}  // namespace key

}  // namespace stride::annotation
