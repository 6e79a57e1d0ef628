#pragma once

#include <functional>
#include <memory>

class QObject;

namespace stride::annotation {

/// What OpenCV's Qt window keeps from a program. It magnifies the whole canvas at each turn of the
/// wheel, after the mouse callback, and cannot be told not to; and Qt takes the tabulator key for
/// itself. Construct it after the first window; it lasts as long as the window is used.
class QtEvents {
 public:
  /// `wheel` is called with +1 away from the user and −1 towards him, `tab` at that key.
  QtEvents(std::function<void(int)> wheel, std::function<void()> tab);
  ~QtEvents();
  QtEvents(const QtEvents&) = delete;
  QtEvents& operator=(const QtEvents&) = delete;

 private:
  std::unique_ptr<QObject> filter_;
};

}  // namespace stride::annotation
