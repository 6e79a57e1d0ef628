#pragma once

#include <filesystem>
#include <opencv2/core/mat.hpp>
#include <string>

namespace stride::annotation {

/// Qt's window magnifies the whole canvas at every turn of the wheel, after the mouse callback has
/// been told of it, and highgui cannot turn that off. What it can do is save how a window looks and
/// load that again, by a settings file; we keep this one in a folder of our own, made anew for
/// every window. To be made before the first window of the program, which fixes where such files
/// are.
class QtZoom {
 public:
  explicit QtZoom(std::string title);
  ~QtZoom();
  QtZoom(const QtZoom&) = delete;
  QtZoom& operator=(const QtZoom&) = delete;

  void will_change();  // in the callback of a turn of the wheel
  void take_back();    // outside of callbacks; show() the picture next
  /// A window that was magnified shows a row more or less than before: the places of the mouse
  /// follow only when its size changes.
  void show(const cv::Mat& picture);

 private:
  std::string title_;
  std::filesystem::path folder_;
  bool changed_ = false, odd_ = false;
};

}  // namespace stride::annotation
