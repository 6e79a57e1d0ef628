#include "extract/io/outputs.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include "extract/io/error.h"
#include "extract/io/file.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/throws.h"

namespace stride {
namespace {

namespace fs = std::filesystem;
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
  const std::string png("\x89PNG\r\n\x1a\n\0\0\0\rIHDR", 16);
  EXPECT_EQ(kind_of_content(png), FileKind::image);
  EXPECT_EQ(kind_of_content(png + "acTL"), FileKind::video);  // an animated one
  EXPECT_EQ(kind_of_content("frame;x\n1;2"), FileKind::text);
  EXPECT_EQ(
      kind_of_content("<!DOCTYPE html>\n<html>\n<meta name=\"generator\" content=\"stride\">"),
      FileKind::page);
  EXPECT_EQ(kind_of_content("<!DOCTYPE html>\n<html>"), FileKind::xml);
  EXPECT_EQ(kind_of_content("a\0b"sv), FileKind::binary);
}

TEST(FileKind, ASectionOfTomlIsNoJson) {
  EXPECT_EQ(kind_of_content("[run]\nlearner = \"ppo\"\n"), FileKind::text);
  EXPECT_EQ(kind_of_content("\n[[arms]]  # one\nname = \"a\"\n"), FileKind::text);
  EXPECT_EQ(kind_of_content("[run]  # mine: a, b\nlearner = \"ppo\"\n"), FileKind::text);
  EXPECT_EQ(kind_of_content("[true, {\"a\": 1}]"), FileKind::json);
  EXPECT_EQ(kind_of_content("[\n {\"a\": 1}]"), FileKind::json);
}

TEST(FileKind, OfOurOwnFilesIsTheirs) {
  const std::filesystem::path videos = std::filesystem::path(STRIDE_SOURCE_DIR) / "videos";
  EXPECT_EQ(kind_of(videos / "human.mp4"), FileKind::video);
  EXPECT_EQ(kind_of(videos / "human.keypoints.json"), FileKind::keypoints);
  EXPECT_EQ(kind_of(videos), FileKind::missing);
  EXPECT_EQ(kind_of("/dev/null"), FileKind::missing);
}

class Outputs : public ::testing::Test {
 protected:
  void SetUp() override {
    write_file_atomically(folder_ / "run.mp4", std::string("\0\0\0\x20"
                                                           "ftypisom",
                                                           12));
    write_file_atomically(folder_ / "clicks.json", "{\"format\": \"stride keypoints\"}");
    write_file_atomically(folder_ / "old.csv", "# stride trajectory 1\n");
  }
  TemporaryFolder folder_;
};

TEST_F(Outputs, AreNeverInputsUnderWhateverName) {
  const fs::path video = folder_ / "run.mp4";
  fs::create_symlink(video, folder_ / "link.mp4");
  fs::create_hard_link(video, folder_ / "hard.mp4");
  for (const fs::path& name :
       {video, folder_ / "./x/../run.mp4", folder_ / "link.mp4", folder_ / "hard.mp4"})
    EXPECT_ERROR(check_outputs({video}, {{"--overlay", name, FileKind::video}}),
                 "is an input too and would be overwritten");
}

TEST_F(Outputs, AreNotWrittenOverAFileAmongTheInputs) {
  EXPECT_ERROR(check_outputs({folder_.path()}, {{"-o", folder_ / "old.csv", FileKind::trajectory}}),
               "is an input too");
  check_outputs({folder_.path()}, {{"-o", folder_ / "new.csv", FileKind::trajectory}});
}

TEST_F(Outputs, ReplaceOnlyFilesOfTheirKind) {
  check_outputs({}, {{"-o", folder_ / "old.csv", FileKind::trajectory}});
  EXPECT_ERROR(check_outputs({}, {{"-o", folder_ / "clicks.json", FileKind::trajectory}}),
               "there is a file of clicks of that name, and a trajectory in pixels would replace");
  EXPECT_ERROR(check_outputs({}, {{"-o", folder_.path(), FileKind::trajectory}}),
               "is a folder: name a file in it");
}

TEST_F(Outputs, HaveNamesThatCanBeWritten) {
  const auto check = [&](const fs::path& file, FileKind kind) {
    check_outputs({folder_ / (std::string(251, 'v') + ".mp4")}, {{"-o", file, kind}});
  };
  check(folder_ / (std::string(236, 'x') + ".csv"), FileKind::trajectory);
  EXPECT_ERROR(check(folder_ / (std::string(251, 'x') + ".csv"), FileKind::trajectory),
               "the name has 255 bytes, at most 240 can be written");
  EXPECT_ERROR(check(folder_ / "new/", FileKind::trajectory), "new/: is a folder");
  EXPECT_ERROR(check("-", FileKind::trajectory), "-o -: is not the standard output");
  EXPECT_ERROR(check(folder_ / "a.avi", FileKind::video), "videos are written as .mp4");
}

TEST_F(Outputs, GoWhereTheUserMayWrite) {
  if (::geteuid() == 0) GTEST_SKIP() << "root may write anywhere";
  fs::permissions(folder_.path(), fs::perms::owner_read | fs::perms::owner_exec);
  EXPECT_ERROR(check_outputs({}, {{"-o", folder_ / "new/deep/a.csv", FileKind::trajectory}}),
               "is not yours to write in");
  fs::permissions(folder_.path(), fs::perms::owner_all);
  check_outputs({}, {{"-o", folder_ / "new/deep/a.csv", FileKind::trajectory}});
  fs::permissions(folder_ / "run.mp4", fs::perms::owner_write);
  EXPECT_EQ(kind_of(folder_ / "run.mp4"), FileKind::unreadable);
}

TEST_F(Outputs, AreDifferentFiles) {
  EXPECT_ERROR(check_outputs({}, {{"-o", folder_ / "a.csv", FileKind::trajectory},
                                  {"--export", folder_ / "./a.csv", FileKind::points_csv}}),
               "are one file");
}

}  // namespace
}  // namespace stride
