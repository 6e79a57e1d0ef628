#pragma once

#include <string>
#include <string_view>

#include "extract/import/parsing/detections.h"

namespace stride::imports {

/// One frame of the folder that `yolo pose predict save_txt=True` writes.
ImportedFile read_ultralytics_labels(std::string_view content, const std::string& file, int frame);

}  // namespace stride::imports
