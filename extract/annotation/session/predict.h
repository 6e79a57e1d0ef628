#pragma once

#include <atomic>
#include <optional>

#include "extract/annotation/labelled_clip.h"
#include "extract/annotation/session/session.h"
#include "extract/video/frame_store.h"

namespace stride::annotation {

/// Tracks the clicks through the frames between them, for the window; or a network's points, which
/// the clicks correct, if they are given. Nothing if `given_up` became true.
std::optional<Prediction> predict(const Keypoints& keypoints, video::FrameStore& frames,
                                  const std::atomic<bool>& given_up,
                                  const tracking::LabelledClip* network = nullptr);

}  // namespace stride::annotation
