#pragma once

#include <functional>
#include <memory>

class QObject;

namespace stride::annotation {

/// Takes the turns of the mouse wheel from OpenCV's Qt window, which would magnify the whole canvas
/// at each of them, after the mouse callback, and cannot be told not to. Construct it after the
/// first window; it lasts as long as the window is used.
class QtWheel {
 public:
  /// `turned` is called with +1 away from the user and −1 towards him.
  explicit QtWheel(std::function<void(int)> turned);
  ~QtWheel();
  QtWheel(const QtWheel&) = delete;
  QtWheel& operator=(const QtWheel&) = delete;

 private:
  std::unique_ptr<QObject> filter_;
};

}  // namespace stride::annotation
