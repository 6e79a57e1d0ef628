#pragma once

#include <atomic>
#include <condition_variable>
#include <functional>
#include <mutex>
#include <optional>
#include <thread>

#include "extract/annotation/session/session.h"

namespace stride::annotation {

/// Tracks the newest clicks in its own thread; abandons work on older ones.
class BackgroundTracker {
 public:
  /// Returns a prediction, or nothing soon after `given_up` has become true.
  using Predict =
      std::function<std::optional<Prediction>(const Keypoints&, const std::atomic<bool>& given_up)>;

  explicit BackgroundTracker(Predict predict);
  ~BackgroundTracker();
  BackgroundTracker(const BackgroundTracker&) = delete;
  BackgroundTracker& operator=(const BackgroundTracker&) = delete;

  /// Does nothing if the clicks of this revision are being tracked or done.
  void submit(const Keypoints& keypoints, int revision);
  /// The prediction finished since the last call, if any.
  std::optional<Prediction> poll();
  /// Waits until the clicks submitted last are tracked.
  Prediction wait();

 private:
  void work();

  Predict predict_;
  std::mutex mutex_;
  std::condition_variable changed_;
  Keypoints keypoints_;
  int submitted_ = -1, finished_ = -1;
  std::optional<Prediction> result_;
  bool stop_ = false;
  std::atomic<bool> given_up_ = false;
  std::thread thread_;
};

}  // namespace stride::annotation
