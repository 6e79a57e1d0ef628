#include "videos/sheet.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "extract/io/error.h"
#include "extract/skeleton/keypoints.h"
#include "extract/video/video.h"

namespace stride::videos {
namespace {

constexpr int kColumns = 8, kWidth_px = 128, kHeight_px = 144;
constexpr int kFirst = 8;  // clicked frame with which a row begins: the second stride

const cv::Scalar kRight(60, 220, 255), kLeft(255, 170, 60), kPelvis(255, 255, 255);

cv::Mat cut_out(const cv::Mat& image, const ClickedFrame& clicked) {
  constexpr int kTimes = 4;  // enlarged before the clicks are drawn
  const double scale = static_cast<double>(kHeight_px) / image.rows;
  const Eigen::Vector2d pelvis = clicked[BodyPart::pelvis]->p_px;
  cv::Mat large;
  cv::resize(image, large, {}, kTimes * scale, kTimes * scale, cv::INTER_AREA);
  for (const BodyPart part : kBodyParts) {
    if (!clicked.placed(part)) continue;
    const bool right = name(part).ends_with("_r");
    const Eigen::Vector2d p = kTimes * scale * clicked[part]->p_px;
    const cv::Point at(static_cast<int>(std::lround(p.x())), static_cast<int>(std::lround(p.y())));
    cv::circle(large, at, 7, {30, 30, 30}, cv::FILLED, cv::LINE_AA);
    cv::circle(large, at, 5,
               part == BodyPart::pelvis ? kPelvis
               : right                  ? kRight
                                        : kLeft,
               cv::FILLED, cv::LINE_AA);
  }
  const int left =
      static_cast<int>(std::lround(pelvis.x() * kTimes * scale)) - kTimes * kWidth_px / 2;
  const cv::Rect window(std::clamp(left, 0, large.cols - kTimes * kWidth_px), 0, kTimes * kWidth_px,
                        std::min(large.rows, kTimes * kHeight_px));
  cv::Mat small;
  cv::resize(large(window), small, {kWidth_px, kHeight_px}, 0, 0, cv::INTER_AREA);
  return small;
}

}  // namespace

void write_sheet(const std::vector<Clip>& clips, const std::filesystem::path& folder,
                 const std::filesystem::path& picture) {
  cv::Mat sheet(static_cast<int>(clips.size()) * kHeight_px, kColumns * kWidth_px, CV_8UC3,
                cv::Scalar::all(0));
  for (std::size_t row = 0; row < clips.size(); ++row) {
    const auto file = folder / (clips[row].name + ".mp4");
    const Keypoints keypoints = load_keypoints(keypoints_file_of(file));
    std::vector<int> numbers;
    for (const auto& [number, frame] : keypoints.frames) numbers.push_back(number);
    video::Video video(file);
    video::VideoFrame frame;
    int column = 0;
    while (column < kColumns && video.read(frame)) {
      if (frame.index != numbers[kFirst + column]) continue;
      cut_out(frame.image, keypoints.frames.at(frame.index))
          .copyTo(sheet(cv::Rect(column * kWidth_px, static_cast<int>(row) * kHeight_px, kWidth_px,
                                 kHeight_px)));
      ++column;
    }
  }
  require(cv::imwrite(picture.string(), sheet, {cv::IMWRITE_JPEG_QUALITY, 84}),
          "{}: cannot be written", picture.string());
}

}  // namespace stride::videos
