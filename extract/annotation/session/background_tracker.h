#pragma once

#include <atomic>
#include <condition_variable>
#include <functional>
#include <mutex>
#include <optional>
#include <thread>

#include "extract/annotation/session/session.h"

namespace stride::annotation {

/// Tracks in a thread of its own, always from the newest clicks: work on older ones is given up.
class BackgroundTracker {
 public:
  /// Makes a prediction, or nothing soon after `given_up` has become true.
  using Predict =
      std::function<std::optional<Prediction>(const Keypoints&, const std::atomic<bool>& given_up)>;

  explicit BackgroundTracker(Predict predict);
  ~BackgroundTracker();
  BackgroundTracker(const BackgroundTracker&) = delete;
  BackgroundTracker& operator=(const BackgroundTracker&) = delete;

  /// Nothing happens where the clicks of this revision are in work or done already.
  void submit(const Keypoints& keypoints, int revision);
  /// A prediction that was finished since the last call.
  std::optional<Prediction> poll();
  /// Until the clicks submitted last are done.
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
