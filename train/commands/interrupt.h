#pragma once

#include <atomic>
#include <csignal>
#include <initializer_list>

namespace stride::training {

/// Becomes true when one of the signals arrives, which then does not end the program.
inline const std::atomic<bool>& stopped_by(std::initializer_list<int> signals) {
  static std::atomic<bool> stopped = false;
  for (const int signal : signals) std::signal(signal, [](int) { stopped = true; });
  return stopped;
}

}  // namespace stride::training
