#include "extract/skeleton/movement.h"

#include <gtest/gtest.h>

#include "extract/skeleton/keypoints.h"
#include "extract/skeleton/trajectory.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/throws.h"

namespace stride {
namespace {

TEST(Movement, OfNoNameIsARun) {
  EXPECT_EQ(movement("").name, "run");
  EXPECT_TRUE(movement("run").repeats);
  EXPECT_EQ(movement("run").legs, Legs::in_turn);
  EXPECT_EQ(movement("run").task, "distance");
}

TEST(Movement, ThatIsNotKnownIsToldWithTheListOfNames) {
  EXPECT_ERROR(movement("crawl", "--movement"),
               "--movement = 'crawl': must be one of run, walk, run-at, jump, jump-up");
}

TEST(Movement, ThatEndsHasMomentsToClick) {
  for (const Movement& each : movements())
    EXPECT_EQ(each.repeats, each.moments.empty()) << each.name;
}

TEST(Movement, OfARunIsNotWrittenSoThatItsFilesStayAsTheyWere) {
  Keypoints clicks;
  clicks.video = "a.mp4";
  clicks.width_px = 640;
  clicks.height_px = 360;
  EXPECT_EQ(text_of(clicks).find("movement"), std::string::npos);
  clicks.movement = "jump";
  const TemporaryFolder folder;
  save(clicks, folder.path() / "a.keypoints.json");
  EXPECT_EQ(load_keypoints(folder.path() / "a.keypoints.json").movement, "jump");

  Trajectory points;
  EXPECT_FALSE(table_of(points).has_meta("movement"));
  points.movement = "walk";
  EXPECT_EQ(table_of(points).meta("movement"), "walk");
}

}  // namespace
}  // namespace stride
