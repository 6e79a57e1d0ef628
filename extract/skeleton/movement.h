#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "extract/io/names.h"

namespace stride {

/// What one leg does while the other moves: the same half a stride later, the same at the same
/// time, or something of its own.
enum class Legs { in_turn, together, free };
inline constexpr Names<Legs> kLegs({{Legs::in_turn, "in turn"},
                                    {Legs::together, "together"},
                                    {Legs::free, "free"}});

/// A movement that the program knows: a section of movements.toml, which says what the members
/// mean.
struct Movement {
  std::string name, meaning;
  bool repeats = true;
  Legs legs = Legs::in_turn;
  std::string gait;
  std::vector<std::string> moments;
  std::string task;
  double task_speed_m_s = 0, task_effort = 0;
  std::string compare;
};

inline constexpr const char* kDefaultMovement = "run";

/// All of them, in the order of the file. Throws Error naming the file, the key and the rule.
const std::vector<Movement>& movements();

/// The movement of that name; of no name, that of kDefaultMovement. Throws Error, beginning with
/// `what`, with the list of names.
const Movement& movement(std::string_view name, std::string_view what = "movement");

/// Their names, separated by commas.
std::string movement_names();

}  // namespace stride
