// Videos that say by a matrix how they are to be turned, as phones write them.
#include <gtest/gtest.h>

#include <array>
#include <opencv2/imgproc.hpp>

#include "extract/io/file.h"
#include "extract/video/video.h"
#include "extract/video/video_writer.h"
#include "tests/support/temporary_folder.h"

namespace stride {
namespace {

constexpr int kWidth = 96, kHeight = 64;

/// Linear part of QuickTime's matrix: a pixel at (x, y) is shown at (a x + c y, b x + d y), moved
/// into the picture.
struct Matrix {
  int a, b, c, d;

  /// Where a corner of the stored frame, −1 or 1 from its middle, is shown.
  std::array<int, 2> shown(int x, int y) const { return {a * x + c * y, b * x + d * y}; }
};

/// A frame that is black but for one corner.
cv::Mat corner_lit(int x, int y) {
  cv::Mat image(kHeight, kWidth, CV_8UC3, cv::Scalar::all(20));
  const cv::Rect lit(x < 0 ? 0 : kWidth / 2, y < 0 ? 0 : kHeight / 2, kWidth / 2, kHeight / 2);
  image(lit).setTo(cv::Scalar::all(220));
  return image;
}

/// Writes the matrix into the header of the track.
std::string with_matrix(std::string mp4, const Matrix& m) {
  const std::size_t matrix = mp4.find("tkhd") + 44;
  const auto put = [&](std::size_t entry, int value) {
    const auto fixed = static_cast<std::uint32_t>(value * 65536);
    for (std::size_t i = 0; i < 4; ++i)
      mp4[matrix + 4 * entry + i] = static_cast<char>(fixed >> (24 - 8 * i) & 0xff);
  };
  put(0, m.a), put(1, m.b), put(3, m.c), put(4, m.d);
  return mp4;
}

TEST(Rotation, ShowsEachCornerWhereTheMatrixPutsIt) {
  constexpr std::array kMatrices{Matrix{1, 0, 0, 1},  Matrix{0, 1, -1, 0}, Matrix{-1, 0, 0, -1},
                                 Matrix{0, -1, 1, 0}, Matrix{-1, 0, 0, 1}, Matrix{1, 0, 0, -1},
                                 Matrix{0, 1, 1, 0},  Matrix{0, -1, -1, 0}};
  const TemporaryFolder folder;
  for (const auto& [x, y] : {std::pair{-1, -1}, std::pair{1, -1}}) {
    video::VideoWriter writer(folder / "stored.mp4", 25);
    for (int i = 0; i < 3; ++i) writer.write(corner_lit(x, y));
    writer.finish();
    const std::string stored = read_file(folder / "stored.mp4");
    for (const char* name : {"turned.mp4", "turned.mov"})
      for (const Matrix& m : kMatrices) {
        write_file_atomically(folder / name, with_matrix(stored, m));
        video::Video decoder(folder / name);
        const bool lies = m.a == 0;
        EXPECT_EQ(decoder.info().width_px, lies ? kHeight : kWidth);
        EXPECT_EQ(decoder.info().height_px, lies ? kWidth : kHeight);
        video::VideoFrame frame;
        for (int i = 0; i < 3; ++i) {
          ASSERT_TRUE(decoder.read(frame));
          const auto [shown_x, shown_y] = m.shown(x, y);
          const int w = frame.image.cols, h = frame.image.rows;
          const cv::Rect lit(shown_x < 0 ? 0 : w / 2, shown_y < 0 ? 0 : h / 2, w / 2, h / 2);
          EXPECT_GT(cv::mean(frame.image(lit))[0], 180)
              << "corner " << x << ", " << y << ", matrix " << m.a << m.b << m.c << m.d;
          EXPECT_LT(cv::mean(frame.image)[0], 100);
        }
      }
  }
}

}  // namespace
}  // namespace stride
