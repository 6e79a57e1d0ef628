#pragma once

#include <filesystem>
#include <functional>

#include "extract/annotation/session/session.h"

namespace stride::annotation {

/// Drives a session by a file with one JSON object a line, positions in pixels of the image:
///
///     {"key": "r"}                        also Enter, Escape, Backspace, Space, Tab, Home, End
///     {"click": [312.5, 90], "button": "right"}
///     {"drag": [[312, 90], [320, 95]]}    "button": "middle" pans
///     {"move": [312, 90]}  {"wheel": 2, "at": [312, 90]}
///     {"frame": 12}                       a click in the timeline
///     {"type": "some text"}               one key a letter
///     {"wait": "tracking"}                until the clicks so far are tracked
///     {"picture": "window.png"}           what the window shows, relative to the script's folder
///
/// Stops when the session is done. Throws Error with file and line, also if the session refuses an
/// event.
void run_script(AnnotationSession& session, const std::filesystem::path& script,
                const std::function<void()>& wait_for_tracking);

}  // namespace stride::annotation
