#include "extract/annotation/qt_zoom.h"

#include <cstdlib>
#include <opencv2/highgui.hpp>
#include <utility>

#include "extract/io/error.h"

namespace stride::annotation {
namespace fs = std::filesystem;

QtZoom::QtZoom(std::string title) : title_(std::move(title)) {
  std::string name = (fs::temp_directory_path() / "stride_window_XXXXXX").string();
  require(::mkdtemp(name.data()) != nullptr, "{}: cannot be made; set TMPDIR to a folder with room",
          name);
  folder_ = name;
  ::setenv("XDG_CONFIG_HOME", name.c_str(), 1);
}

QtZoom::~QtZoom() {
  std::error_code ignored;
  fs::remove_all(folder_, ignored);
}

void QtZoom::will_change() {
  if (!changed_) cv::saveWindowParameters(title_);
  changed_ = true;
}

void QtZoom::take_back() {
  if (!std::exchange(changed_, false)) return;
  cv::loadWindowParameters(title_);
  odd_ = !odd_;
}

void QtZoom::show(const cv::Mat& picture) {
  cv::Mat shown = picture;
  if (odd_) cv::copyMakeBorder(picture, shown, 0, 1, 0, 0, cv::BORDER_REPLICATE);
  cv::imshow(title_, shown);
}

}  // namespace stride::annotation
