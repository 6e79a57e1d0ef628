#pragma once

#include <atomic>
#include <csignal>
#include <initializer_list>

namespace stride::training {

/// Becomes true when one of the signals comes, which no longer ends the program then.
inline const std::atomic<bool>& stopped_by(std::initializer_list<int> signals) {
  static std::atomic<bool> stopped = false;
  for (const int signal : signals) std::signal(signal, [](int) { stopped = true; });
  return stopped;
}

}  // namespace stride::training
