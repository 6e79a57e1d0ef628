#include "extract/io/outputs.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "extract/io/error.h"
#include "extract/io/file.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/throws.h"

namespace stride {
namespace {

namespace fs = std::filesystem;

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

TEST_F(Outputs, AreDifferentFiles) {
  EXPECT_ERROR(check_outputs({}, {{"-o", folder_ / "a.csv", FileKind::trajectory},
                                  {"--export", folder_ / "./a.csv", FileKind::points_csv}}),
               "are one file");
}

}  // namespace
}  // namespace stride
