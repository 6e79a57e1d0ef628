#pragma once

#include "videos/clip.h"

namespace stride::videos {

// Variants of a clip that show the same run.

/// Scales the frames by `factor`.
Clip resized(Clip clip, double factor);
/// The same duration at another frame rate.
Clip at_rate(Clip clip, double rate_hz);
/// `factor` times as many frames, shown at the same rate.
Clip in_slow_motion(Clip clip, double factor);
/// Films the runner from the other side, so the run goes the other way through the image.
Clip from_other_side(Clip clip);
/// Films with a static camera that shows the whole run, so the runner is smaller.
Clip from_one_place(Clip clip);

}  // namespace stride::videos
