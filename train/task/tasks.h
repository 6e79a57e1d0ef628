#pragma once

#include "train/task/task.h"

namespace stride::task {

// The tasks; each in the file of its name. task.cpp has their table.

/// The competition's: as far as possible in 10 s. A fall is a pelvis below 0.65 m.
std::unique_ptr<Task> distance(const TaskOptions& options, const osim::Model& model);

/// A speed v*, for 10 s with little effort. Reward of a step Δt:
///   Δt (v* − |v − v*| − effort · mean squared activation) + the competition's cost of ligaments
/// with the pelvis' speed v. Measure: Δt (v* − |v − v*|), summed: the distance less what was made
/// too fast.
std::unique_ptr<Task> speed(const TaskOptions& options, const osim::Model& model);

/// Walking: the same speed with a foot on the ground. A step with both in the air counts −Δt v* in
/// reward and measure. The reward loses `slip` for each metre that a foot slides while it bears
/// weight: the slower of heel and toe, less where it bears under bearing_N().
std::unique_ptr<Task> walk(const TaskOptions& options, const osim::Model& model);

/// A jump from standing: both feet leave the ground within half a metre of the start, and after
/// both have landed the runner does not fall for 0.5 s. Reward in flight: the pelvis' way forward,
/// which a fall takes back; in the 0.5 s after it, the more the later, the length; of several jumps
/// the best alone. The length: from the foremost ankle at take-off to where the rearmost ankle
/// touched down. Measure: the length, 0 without that end.
std::unique_ptr<Task> long_jump(const TaskOptions& options, const osim::Model& model);

/// A jump onto the right foot: after the landing the left one does not touch the ground for the 0.5
/// s in which the runner does not fall. Reward as of the long jump; length to the right ankle.
std::unique_ptr<Task> hop(const TaskOptions& options, const osim::Model& model);

/// The same upward: the rise of the centre of mass above its height at take-off.
std::unique_ptr<Task> high_jump(const TaskOptions& options, const osim::Model& model);

}  // namespace stride::task
