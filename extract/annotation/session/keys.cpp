#include "extract/annotation/session/keys.h"

namespace stride::annotation {

Command command_of(int code) {
  using enum Command;
  if (code >= '0' && code <= '9') return choose_part;
  switch (code) {
    case 'a':
    case ',':
    case key::kLeft:
      return previous_frame;
    case 'd':
    case '.':
    case key::kRight:
      return next_frame;
    case '[':
    case key::kUp:
      return previous_clicked;
    case ']':
    case key::kDown:
      return next_clicked;
    case key::kSpace:
      return next_phase;
    case 'n':
      return next_worst;
    case 'f':
      return next_suspect;
    case key::kHome:
      return first_frame;
    case key::kEnd:
      return last_frame;
    case 'x':
      return absent;
    case key::kEnter:
      return accept;
    case key::kBackspace:
    case key::kDelete:
      return erase;
    case 'c':
      return copy;
    case 'i':
      return nudge_up;
    case 'k':
      return nudge_down;
    case 'j':
      return nudge_left;
    case 'l':
      return nudge_right;
    case 's':
      return swap_legs;
    case 'b':
      return begin_range;
    case 't':
      return trim;
    case 'u':
      return undo;
    case 'r':
      return redo;
    case 'z':
      return zoom;
    case ';':
      return zoom_to_runner;
    case key::kTab:
      return play;
    case 'h':
      return toggle_hips;
    case 'e':
      return toggle_head;
    case '-':
      return finer_phases;
    case '=':
    case '+':
      return coarser_phases;
    case 'o':
      return floor_line;
    case 'p':
      return Command::floor_from_feet;
    case '\'':
    case '|':
    case '#':
      return calibration_line;
    case 'y':
      return slow_motion;
    case 'm':
      return treadmill;
    case 'g':
      return notes;
    case 'v':
      return ask_again;
    case key::kEscape:
      return cancel;
    case 'w':
      return save;
    case '?':
    case '/':
    case key::kF1:
      return help;
    case 'q':
      return quit;
    default:
      return none;
  }
}

const std::vector<KeyHelp>& key_help() {
  static const std::vector<KeyHelp> help{
      {"left click", "place the part that is asked for; near a point: drag that point"},
      {"right click", "the same for a part that is hidden, where it must be"},
      {"x", "the part is absent: hidden or outside, and cannot be told"},
      {"Enter", "take the prediction of the tracker for it"},
      {"1 … 7", "choose pelvis, near knee, ankle, toe, far knee, ankle, toe"},
      {"8 9 0", "choose near hip, far hip, head"},
      {"i j k l", "move the last point by a quarter pixel up, left, down, right"},
      {"Backspace", "take the click of the chosen part away"},
      {"c", "copy what is missing here from the nearest clicked frame"},
      {"u  r", "undo, redo (without limit)"},
      {"a d", "one frame back, on (also , and .); Home and End"},
      {"[ ]", "previous, next clicked frame"},
      {"Space", "next phase frame; - and = put them closer, wider"},
      {"n", "next worst frame of the tracking"},
      {"s", "swap left and right leg here, or in the range begun with b"},
      {"f", "next frame where legs seem to be swapped"},
      {"b", "begin a range here; it reaches to the frame shown"},
      {"t", "trim the clip to the range; without one: whole clip again"},
      {"wheel  z", "zoom at the mouse; z: 8 times and back. Middle button: pan"},
      {";  Tab", "zoom to the runner; play and stop"},
      {"o  p", "floor line: two clicks; from the standing feet"},
      {"'", "calibration line of known length: two clicks, then metres"},
      {"y  m  g", "slow-motion factor, treadmill, notes"},
      {"h e", "ask for hips, for the head too"},
      {"v", "ask again for direction and near leg"},
      {"w  q", "write the keypoints file now (every click is saved anyway); quit"},
  };
  return help;
}

}  // namespace stride::annotation
