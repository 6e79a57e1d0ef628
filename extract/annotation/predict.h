#pragma once

#include <atomic>
#include <optional>

#include "extract/annotation/frame_store.h"
#include "extract/annotation_session.h"

namespace stride {

/// Tracks the clicks through the frames between them, for the ghosts and strips of the window.
/// Nothing if `given_up` became true meanwhile.
std::optional<Prediction> predict(const Keypoints& keypoints, FrameStore& frames,
                                  const std::atomic<bool>& given_up);

}  // namespace stride
