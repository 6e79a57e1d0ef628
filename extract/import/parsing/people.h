#pragma once

#include "extract/import/parsing/detections.h"

namespace stride::imports {

/// Joins what was detected frame by frame into people, by their names where the file gives them,
/// else by where they were in the frames before, and takes one of them: the largest for the
/// longest (sum over frames of the extent of its points), or `options.person`. Somebody who is away
/// while nobody else is there is the same person afterwards.
///
/// What says of itself that it is no point is left out: places (0, 0) and (−1, −1), confidences of
/// 0 and below `options.min_confidence`. Confidences above 1.5 are percent. Throws Error naming
/// `file` if there is nobody, or not that many.
Detections take_person(ImportedFile content, const ImportOptions& options, const std::string& file);

}  // namespace stride::imports
