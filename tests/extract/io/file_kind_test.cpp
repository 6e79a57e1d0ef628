#include "extract/io/file_kind.h"

#include <gtest/gtest.h>

namespace stride {
namespace {

using namespace std::string_view_literals;

TEST(FileKind, IsToldFromTheFirstBytes) {
  EXPECT_EQ(kind_of_content(""), FileKind::empty);
  EXPECT_EQ(kind_of_content("# stride trajectory 1\n"), FileKind::trajectory);
  EXPECT_EQ(kind_of_content("# stride curve 1\n"), FileKind::table);
  EXPECT_EQ(kind_of_content("{\n \"format\": \"stride keypoints\"}"), FileKind::keypoints);
  EXPECT_EQ(kind_of_content("[1, {\"a\": 2}]"), FileKind::json);
  EXPECT_EQ(kind_of_content("\0\0\0\x20"
                            "ftypisom"sv),
            FileKind::video);
  EXPECT_EQ(kind_of_content("\x89HDF\r\n\x1a\n\0\0"sv), FileKind::hdf5);
  EXPECT_EQ(kind_of_content("PK\3\4xl"), FileKind::zip);
  EXPECT_EQ(kind_of_content("\xff\xfe"
                            "f\0r\0"sv),
            FileKind::utf16);
  EXPECT_EQ(kind_of_content("<?xml?>\n<KinoveaVideoAnalysis>"), FileKind::kinovea_xml);
  EXPECT_EQ(kind_of_content("frame;x\n1;2"), FileKind::text);
  EXPECT_EQ(kind_of_content("a\0b"sv), FileKind::binary);
}

TEST(FileKind, OfOurOwnFilesIsTheirs) {
  const std::filesystem::path videos = std::filesystem::path(STRIDE_SOURCE_DIR) / "videos";
  EXPECT_EQ(kind_of(videos / "human.mp4"), FileKind::video);
  EXPECT_EQ(kind_of(videos / "human.keypoints.json"), FileKind::keypoints);
  EXPECT_EQ(kind_of(videos), FileKind::missing);
  EXPECT_EQ(kind_of("/dev/null"), FileKind::missing);
}

}  // namespace
}  // namespace stride
