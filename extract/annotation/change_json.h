#pragma once

#include <string>

#include "extract/annotation/document.h"

namespace stride::annotation {

/// A change as one line of JSON, and back. Numbers read back exactly.
std::string line_of(const Change& change);

/// Throws Error, beginning with `where`, if the line is not one of ours.
Change change_of(const std::string& line, const std::string& where);

}  // namespace stride::annotation
