#pragma once

#include <string>

#include "calibrate/osim/model.h"
#include "calibrate/osim/osim_element.h"

namespace stride::osim {

// The parts of load_osim(). In version 3 documents (30000) a joint is inside its body, and
// references are names. In version 4 documents (40000) joints are in a set, and references are
// paths in "sockets". Every function throws Error with file, line and element.

/// The last component of a path or name: "/jointset/knee_r/knee_angle_r" → "knee_angle_r".
std::string last_of_path(const std::string& path);

/// Index of the body that `from` refers to in its child `socket` (version 4) or `bare` (version 3).
int body_of(const Model& model, const OsimElement& from, const char* socket, const char* bare);
int coordinate_of(const Model& model, const OsimElement& from, const char* socket,
                  const char* bare);
/// Index of the coordinate of that path. The error for a missing one names the element `at`.
int coordinate_named(const Model& model, const OsimElement& at, const std::string& path);

/// A property that is a SimmSpline or a Constant, optionally scaled.
SimmSpline read_spline(const OsimElement& from, const char* property);

void read_bodies_and_joints(const OsimElement& root, bool version4, Model& model);
void read_muscle(Model& model, const OsimElement& from);
void read_geometry(Model& model, const OsimElement& from);
void read_contact(Model& model, const OsimElement& from);
void read_limit(Model& model, const OsimElement& from);

}  // namespace stride::osim
