#pragma once

#include <atomic>
#include <optional>

#include "extract/annotation/session/session.h"
#include "extract/video/frame_store.h"

namespace stride::annotation {

/// Tracks the clicks through the frames between them, for the window. Nothing if `given_up` became
/// true.
std::optional<Prediction> predict(const Keypoints& keypoints, video::FrameStore& frames,
                                  const std::atomic<bool>& given_up);

}  // namespace stride::annotation
