#pragma once

#include "videos/clip.h"

namespace stride::videos {

// The same run filmed otherwise: what is true of one is true of the other.

/// Frames of `factor` times the size.
Clip resized(Clip clip, double factor);
/// The same time at another frame rate.
Clip at_rate(Clip clip, double rate_hz);
/// `factor` times as many frames, shown at the same rate.
Clip in_slow_motion(Clip clip, double factor);
/// From the runner's other side: the run goes the other way through the image.
Clip from_other_side(Clip clip);
/// By a camera that stands and shows the whole way; the runner is the smaller for it.
Clip from_one_place(Clip clip);

}  // namespace stride::videos
