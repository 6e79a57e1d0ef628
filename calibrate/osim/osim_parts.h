#pragma once

#include <string>

#include "calibrate/osim/model.h"
#include "calibrate/osim/osim_element.h"

namespace stride::osim {

// The parts of load_osim(). Version 3 documents (30000) keep each body's joint inside the body and
// name things by bare names; version 4 documents (40000) keep joints in a set and point at things
// by paths through "sockets". Every part throws Error naming file, line and element.

/// The thing that a path or bare name means: "/jointset/knee_r/knee_angle_r" → "knee_angle_r".
std::string last_of_path(const std::string& path);

/// Index of the body that `from` names in its child `socket` (version 4) or `bare` (version 3).
int body_of(const Model& model, const OsimElement& from, const char* socket, const char* bare);
int coordinate_of(const Model& model, const OsimElement& from, const char* socket,
                  const char* bare);
/// Index of the coordinate of that path; `at` is blamed if there is none.
int coordinate_named(const Model& model, const OsimElement& at, const std::string& path);

/// A property that is a SimmSpline or a Constant, maybe scaled.
SimmSpline read_spline(const OsimElement& from, const char* property);

void read_bodies_and_joints(const OsimElement& root, bool version4, Model& model);
void read_muscle(Model& model, const OsimElement& from);
void read_geometry(Model& model, const OsimElement& from);
void read_contact(Model& model, const OsimElement& from);
void read_limit(Model& model, const OsimElement& from);

}  // namespace stride::osim
