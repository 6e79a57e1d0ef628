#include "extract/annotation/session/background_tracker.h"

#include <exception>
#include <utility>

namespace stride::annotation {

BackgroundTracker::BackgroundTracker(Predict predict)
    : predict_(std::move(predict)), thread_([this] { work(); }) {}

BackgroundTracker::~BackgroundTracker() {
  {
    const std::lock_guard lock(mutex_);
    stop_ = true;
    given_up_ = true;
  }
  changed_.notify_all();
  thread_.join();
}

void BackgroundTracker::submit(const Keypoints& keypoints, int revision) {
  {
    const std::lock_guard lock(mutex_);
    if (revision == submitted_) return;
    keypoints_ = keypoints;
    submitted_ = revision;
    given_up_ = true;
  }
  changed_.notify_all();
}

std::optional<Prediction> BackgroundTracker::poll() {
  const std::lock_guard lock(mutex_);
  return std::exchange(result_, std::nullopt);
}

Prediction BackgroundTracker::wait() {
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [&] { return finished_ == submitted_; });
  return std::exchange(result_, std::nullopt).value_or(Prediction());
}

void BackgroundTracker::work() {
  for (;;) {
    Keypoints keypoints;
    int revision = 0;
    {
      std::unique_lock lock(mutex_);
      changed_.wait(lock, [&] { return stop_ || submitted_ != finished_; });
      if (stop_) return;
      keypoints = keypoints_;
      revision = submitted_;
      given_up_ = false;
    }
    std::optional<Prediction> prediction;
    try {
      prediction = predict_(keypoints, given_up_);
    } catch (const std::exception& error) {
      prediction = Prediction();
      prediction->problem = error.what();
    }
    if (!prediction) continue;
    prediction->revision = revision;
    {
      const std::lock_guard lock(mutex_);
      if (revision != submitted_) continue;
      result_ = std::move(prediction);
      finished_ = revision;
    }
    changed_.notify_all();
  }
}

}  // namespace stride::annotation
