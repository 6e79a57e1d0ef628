#pragma once

#include "extract/import/parsing/detections.h"

namespace stride::imports {

/// Joins what was detected frame by frame into people, by their names where the file gives them,
/// else by where they were in the frames before, and takes one of them: the largest for the
/// longest (sum over frames of the extent of its points), or `options.person`. Drops points below
/// `options.min_confidence`. Throws Error naming `file` if there is nobody, or not that many.
Detections take_person(DetectedPeople people, const ImportOptions& options,
                       const std::string& file);

}  // namespace stride::imports
