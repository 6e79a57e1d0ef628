#pragma once

#include <string>
#include <string_view>

#include "extract/import/parsing/detections.h"
#include "extract/io/csv.h"

/// Readers for what people's scripts write of a pose network's results. None of these libraries has
/// a file format of its own, so the readers go by names and shapes. A network is never as sure as a
/// person: its confidence counts 0.95 times. All throw Error with file, line and what was expected.
namespace stride::imports {

/// MediaPipe's 33 landmarks: a table with a row a frame or a row a landmark, or JSON with a list of
/// landmarks a frame. Coordinates are shares of the picture, or pixels where they exceed 2.
ImportedFile read_mediapipe(std::string_view content, const std::string& file,
                            const ImportOptions& options);

/// Whether a table's header names MediaPipe's landmarks.
bool is_mediapipe(const TextLine& header);

/// Ultralytics' YOLO pose: what Results.to_json() gives, for each frame in a list, or a line a
/// frame.
ImportedFile read_ultralytics(std::string_view content, const std::string& file,
                              const ImportOptions& options);

/// One frame of the folder that `yolo pose predict save_txt=True` writes.
ImportedFile read_ultralytics_labels(std::string_view content, const std::string& file, int frame);

/// RTMPose: predictions of MMPose's inferencer, and keypoints and scores as rtmlib returns them.
ImportedFile read_rtmpose(std::string_view content, const std::string& file,
                          const ImportOptions& options);

}  // namespace stride::imports
