#pragma once

#include <string>

#include "extract/annotation/document.h"

namespace stride::annotation {

/// Writes a change as one line of JSON. Numbers read back exactly.
std::string line_of(const Change& change);

/// Reads such a line. Throws Error, beginning with `where`, if it is not a change.
Change change_of(const std::string& line, const std::string& where);

}  // namespace stride::annotation
