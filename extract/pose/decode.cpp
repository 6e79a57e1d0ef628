#include "extract/pose/decode.h"

#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <opencv2/core/types.hpp>
#include <opencv2/dnn.hpp>
#include <span>

#include "extract/io/error.h"

namespace stride::pose {
namespace {

/// The shape of a network's output, for messages.
std::vector<int> shape(const cv::Mat& blob) { return {blob.size.p, blob.size.p + blob.dims}; }

void require_shape(bool holds, const cv::Mat& blob, const std::string& expected) {
  require(holds && blob.type() == CV_32F, "the network's output is {}: must be {}", shape(blob),
          expected);
}

/// Where the parabola through (−1, before), (0, top), (1, after) is highest.
double vertex(double before, double top, double after) {
  if (before > 0 && top > 0 && after > 0) {
    before = std::log(before);
    top = std::log(top);
    after = std::log(after);
  }
  const double curvature = before - 2 * top + after;
  return curvature < 0 ? std::clamp((before - after) / (2 * curvature), -0.5, 0.5) : 0;
}

struct Peak {
  double place = 0, height = 0;  // place in pixels of the input
};

/// The highest of evenly spread values over `length_px`.
Peak peak_of(std::span<const float> values, double length_px) {
  const auto top = std::ranges::max_element(values);
  return {
      static_cast<double>(top - values.begin()) * length_px / static_cast<double>(values.size()),
      *top};
}

}  // namespace

PosePerson decode_heatmaps(const cv::Mat& maps, cv::Size input_px, int keypoints) {
  require_shape(maps.dims == 4 && maps.size[0] == 1 && maps.size[1] >= keypoints, maps,
                fmt::format("1 × {} or more × height × width", keypoints));
  const int height = maps.size[2], width = maps.size[3];
  PosePerson person;
  for (int k = 0; k < keypoints; ++k) {
    const cv::Mat map(height, width, CV_32F, const_cast<float*>(maps.ptr<float>(0, k)));
    double top = 0;
    cv::Point at;
    cv::minMaxLoc(map, nullptr, &top, nullptr, &at);
    Eigen::Vector2d cell(at.x, at.y);
    if (at.x > 0 && at.x + 1 < width)
      cell.x() += vertex(map.at<float>(at.y, at.x - 1), top, map.at<float>(at.y, at.x + 1));
    if (at.y > 0 && at.y + 1 < height)
      cell.y() += vertex(map.at<float>(at.y - 1, at.x), top, map.at<float>(at.y + 1, at.x));
    const Eigen::Vector2d cell_px(static_cast<double>(input_px.width) / width,
                                  static_cast<double>(input_px.height) / height);
    person.keypoints.push_back({cell.cwiseProduct(cell_px), top});
  }
  return person;
}

PosePerson decode_simcc(const cv::Mat& x, const cv::Mat& y, cv::Size input_px, int keypoints) {
  const auto check = [&](const cv::Mat& bins, int length_px) {
    require_shape(bins.dims == 3 && bins.size[0] == 1 && bins.size[1] == keypoints &&
                      bins.size[2] % length_px == 0,
                  bins, fmt::format("1 × {} × a multiple of {}", keypoints, length_px));
  };
  check(x, input_px.width);
  check(y, input_px.height);
  PosePerson person;
  for (int k = 0; k < keypoints; ++k) {
    const auto row = [k](const cv::Mat& bins) {
      return std::span(bins.ptr<float>(0, k), static_cast<std::size_t>(bins.size[2]));
    };
    const Peak across = peak_of(row(x), input_px.width), down = peak_of(row(y), input_px.height);
    person.keypoints.push_back({{across.place, down.place}, std::min(across.height, down.height)});
  }
  return person;
}

std::vector<PosePerson> decode_yolo_pose(const cv::Mat& rows, int keypoints, double min_confidence,
                                         double overlap) {
  const int columns = 5 + 3 * keypoints;
  require_shape(
      rows.dims == 3 && rows.size[0] == 1 && (rows.size[1] == columns || rows.size[2] == columns),
      rows, fmt::format("1 × {} × N or 1 × N × {}", columns, columns));
  cv::Mat table(rows.size[1], rows.size[2], CV_32F, const_cast<float*>(rows.ptr<float>(0)));
  if (rows.size[1] == columns) table = table.t();

  std::vector<cv::Rect2d> boxes;
  std::vector<float> confidences;
  for (int i = 0; i < table.rows; ++i) {
    const float* row = table.ptr<float>(i);
    boxes.emplace_back(row[0] - row[2] / 2, row[1] - row[3] / 2, row[2], row[3]);
    confidences.push_back(row[4]);
  }
  std::vector<int> best;
  cv::dnn::NMSBoxes(boxes, confidences, static_cast<float>(min_confidence),
                    static_cast<float>(overlap), best);
  std::vector<PosePerson> people;
  for (const int i : best) {
    const float* row = table.ptr<float>(i);
    PosePerson& person = people.emplace_back();
    person.confidence = row[4];
    for (int k = 0; k < keypoints; ++k)
      person.keypoints.push_back({{row[5 + 3 * k], row[6 + 3 * k]}, row[7 + 3 * k]});
  }
  return people;
}

}  // namespace stride::pose
