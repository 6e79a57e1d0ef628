#include "extract/pose/network.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "extract/io/error.h"

namespace stride::pose {
namespace {

constexpr const char* kOnnxCure =
    "export it with fixed shapes and opset 11, without its last layers if need be, or run it "
    "elsewhere and --import its points (extract/pose/README.md)";

/// The first sentence of what OpenCV says.
std::string reason(const cv::Exception& error) {
  const std::string& text = error.err.empty() ? error.msg : error.err;
  return text.substr(0, text.find('\n'));
}

/// From pixels of the input to pixels of the image: the region in the middle of the input, as
/// large as fits.
struct Letterbox {
  double image_px = 1;  // a pixel of the input
  Eigen::Vector2d middle_px, input_middle_px;

  Letterbox(const cv::Rect2d& region, const PoseSidecar& s)
      : image_px(std::max(region.width / s.width_px, region.height / s.height_px)),
        middle_px(region.x + region.width / 2, region.y + region.height / 2),
        input_middle_px((s.width_px - 1) / 2.0, (s.height_px - 1) / 2.0) {}

  Eigen::Vector2d in_image(const Eigen::Vector2d& p_input) const {
    return middle_px + image_px * (p_input - input_middle_px);
  }
};

/// The normalised crop, 1 × 3 × height × width.
cv::Mat input_of(const cv::Mat& bgr, const Letterbox& crop, const PoseSidecar& s) {
  const Eigen::Vector2d first = crop.in_image({0, 0});
  const cv::Matx23d to_image(crop.image_px, 0, first.x(), 0, crop.image_px, first.y());
  cv::Mat image = bgr;
  // Before it is made smaller, what the smaller image cannot show goes.
  if (crop.image_px > 1.5) cv::GaussianBlur(bgr, image, {}, 0.4 * crop.image_px);
  cv::Mat small;
  cv::warpAffine(image, small, to_image, {s.width_px, s.height_px},
                 cv::INTER_LINEAR | cv::WARP_INVERSE_MAP, cv::BORDER_CONSTANT,
                 cv::Scalar::all(s.border));
  if (s.rgb) cv::cvtColor(small, small, cv::COLOR_BGR2RGB);
  small.convertTo(small, CV_32F);
  small = (small - cv::Scalar(s.mean[0], s.mean[1], s.mean[2]));
  cv::divide(small, cv::Scalar(s.std[0], s.std[1], s.std[2]), small);
  return cv::dnn::blobFromImage(small);
}

}  // namespace

cv::Mat self_check_input(int width_px, int height_px) {
  const int shape[]{1, 3, height_px, width_px};
  cv::Mat input(4, shape, CV_32F);
  auto* values = input.ptr<float>();
  for (std::size_t i = 0; i < input.total(); ++i)
    values[i] = static_cast<float>(std::sin(static_cast<double>(i)));
  return input;
}

std::vector<double> self_check_values(const std::vector<cv::Mat>& outputs, std::size_t count) {
  std::vector<float> all;
  for (const cv::Mat& output : outputs)
    all.insert(all.end(), output.ptr<float>(), output.ptr<float>() + output.total());
  std::vector<double> values;
  for (std::size_t k = 0; k < count; ++k) values.push_back(all[k * all.size() / count]);
  return values;
}

PoseNetwork::PoseNetwork(const std::filesystem::path& onnx, PoseSidecar sidecar)
    : file_(onnx.string()), sidecar_(std::move(sidecar)) {
  require(std::filesystem::exists(onnx), "{}: no such file", file_);
  try {
    net_ = cv::dnn::readNetFromONNX(file_);
  } catch (const cv::Exception& error) {
    throw Error(fmt::format("{}: OpenCV {} cannot read it ({}); {}", file_, CV_VERSION,
                            reason(error), kOnnxCure));
  }
  require(!net_.empty(), "{}: is an empty network", file_);
  check_itself();
}

std::vector<cv::Mat> PoseNetwork::run(const cv::Mat& input) {
  try {
    net_.setInput(input);
    std::vector<cv::Mat> outputs;
    if (sidecar_.outputs.empty()) {
      outputs.push_back(net_.forward());
    } else {
      // Copied, because OpenCV reuses the memory.
      for (const std::string& name : sidecar_.outputs)
        outputs.push_back(net_.forward(name).clone());
    }
    return outputs;
  } catch (const cv::Exception& error) {
    throw Error(fmt::format("{}: OpenCV {} cannot run it on an input of 1 × 3 × {} × {} ({}); {}",
                            file_, CV_VERSION, sidecar_.height_px, sidecar_.width_px, reason(error),
                            kOnnxCure));
  }
}

void PoseNetwork::check_itself() {
  const std::vector<cv::Mat> outputs = run(self_check_input(sidecar_.width_px, sidecar_.height_px));
  const std::vector<double>& expected = sidecar_.check_values;
  const std::vector<double> found = self_check_values(outputs, expected.size());
  for (std::size_t k = 0; k < expected.size(); ++k)
    require(std::abs(found[k] - expected[k]) <= sidecar_.check_tolerance,
            "{}: the self-check failed: value {} of {} is {:.6g}, {} says {:.6g} ± {}: OpenCV {} "
            "reads this network wrongly, or the sidecar is another network's; {}",
            file_, k, expected.size(), found[k], sidecar_.file, expected[k],
            sidecar_.check_tolerance, CV_VERSION, kOnnxCure);
}

std::vector<PosePerson> PoseNetwork::find(const cv::Mat& bgr, const cv::Rect2d& region) {
  const Letterbox crop(region, sidecar_);
  const std::vector<cv::Mat> outputs = run(input_of(bgr, crop, sidecar_));
  const cv::Size input_px(sidecar_.width_px, sidecar_.height_px);
  const auto keypoints = static_cast<int>(sidecar_.keypoints.size());
  std::vector<PosePerson> people;
  try {
    switch (sidecar_.decoder) {
      case PoseDecoder::heatmap:
        people = {decode_heatmaps(outputs[0], input_px, keypoints)};
        break;
      case PoseDecoder::simcc:
        people = {decode_simcc(outputs[0], outputs[1], input_px, keypoints)};
        break;
      case PoseDecoder::yolo_pose:
        people = decode_yolo_pose(outputs[0], keypoints, sidecar_.min_confidence);
        break;
    }
  } catch (const Error& error) {
    throw Error(fmt::format("{}: {} for {} keypoints and this decoder ({})", file_, error.what(),
                            keypoints, sidecar_.file));
  }
  for (PosePerson& person : people)
    for (Keypoint& keypoint : person.keypoints)
      keypoint.p_px = crop.in_image(keypoint.p_px + Eigen::Vector2d::Constant(sidecar_.offset_px));
  return people;
}

}  // namespace stride::pose
