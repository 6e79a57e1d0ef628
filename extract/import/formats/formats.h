#pragma once

#include "extract/import/parsing/format.h"

/// Every format by its name, in the order in which they are listed. A new one is a row here and a
/// file in formats/ or networks/ that defines it: how it is told from the others, and its reader.
// clang-format off
#define STRIDE_IMPORT_FORMATS(row) \
  row(openpose) \
  row(deeplabcut) \
  row(coco) \
  row(alphapose) \
  row(mmpose) \
  row(sleap) \
  row(trc) \
  row(cvat) \
  row(kinovea) \
  row(dltdv) \
  row(mediapipe) \
  row(ultralytics) \
  row(rtmpose) \
  row(csv) \
  row(json)
// clang-format on

namespace stride::imports::formats {

#define STRIDE_DECLARE_FORMAT(name) extern const Format name;
STRIDE_IMPORT_FORMATS(STRIDE_DECLARE_FORMAT)
#undef STRIDE_DECLARE_FORMAT

}  // namespace stride::imports::formats
