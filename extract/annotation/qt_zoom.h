#pragma once

#include <filesystem>
#include <opencv2/core/mat.hpp>
#include <string>

namespace stride::annotation {

/// Undoes the zoom of OpenCV's Qt window, which magnifies the whole canvas at every turn of the
/// wheel, after the mouse callback, and cannot be turned off. highgui can save and restore the
/// state of a window through a settings file; this class keeps that file in a temporary folder.
/// Construct it before the first window of the program, which fixes the folder of such files.
class QtZoom {
 public:
  explicit QtZoom(std::string title);
  ~QtZoom();
  QtZoom(const QtZoom&) = delete;
  QtZoom& operator=(const QtZoom&) = delete;

  void will_change();  // call in the callback of the wheel
  void take_back();    // call outside of callbacks, then show() the picture
  /// A window that was magnified differs by a row afterwards: mouse positions are updated only when
  /// its size changes.
  void show(const cv::Mat& picture);

 private:
  std::string title_;
  std::filesystem::path folder_;
  bool changed_ = false, odd_ = false;
};

}  // namespace stride::annotation
