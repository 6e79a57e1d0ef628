#include "shaping/pipeline/convert.h"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include "extract/annotation/journal.h"
#include "extract/io/file.h"
#include "extract/skeleton/trajectory.h"
#include "tests/support/environment_variable.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/throws.h"

namespace stride {
namespace {

const std::filesystem::path kVideos = std::filesystem::path(STRIDE_SOURCE_DIR) / "videos";

/// The rendered runner's true points as a trajectory to convert.
void put_human(const TemporaryFolder& folder) {
  std::filesystem::copy_file(kVideos / "human.truth.csv", folder / "human.trajectory.csv");
}

pipeline::ConvertOptions into(const TemporaryFolder& folder) {
  pipeline::ConvertOptions options;
  options.out = folder / "out";
  options.pictures = false;
  return options;
}

TEST(Convert, MakesAPotentialOfARunner) {
  const TemporaryFolder folder;
  put_human(folder);
  const auto results = pipeline::convert({folder / "human.trajectory.csv"}, into(folder));
  ASSERT_EQ(results.size(), 1u);
  EXPECT_FALSE(results[0].failed) << results[0].verdict;
  const Potential potential = load_potential(folder / "out" / "human.potential.json");
  EXPECT_NEAR(potential.period_s, 0.6867, 0.003);
  EXPECT_EQ(potential.keyframes.size(), 8u);
  EXPECT_EQ(potential.source, "human.mp4");
}

TEST(Convert, SaysWhosePointsAPotentialIsMadeOf) {
  const TemporaryFolder folder;
  for (const char* ending : {".mp4", ".keypoints.json"})
    std::filesystem::copy_file(kVideos / (std::string("human") + ending),
                               folder / (std::string("human") + ending));
  const auto results = pipeline::convert({folder / "human.mp4"}, into(folder));
  EXPECT_EQ(results[0].points, "clicks");
  EXPECT_THAT(read_file(folder / "out" / "human.potential.json"),
              testing::HasSubstr(R"("points": "clicks")"));
  EXPECT_GT(load_potential(folder / "out" / "human.potential.json").period_s, 0);
}

TEST(Convert, SaysHowAVideoIsFollowedWithoutClicks) {
  const TemporaryFolder folder;
  std::filesystem::copy_file(kVideos / "human.mp4", folder / "human.mp4");
  const EnvironmentVariable home("XDG_DATA_HOME", folder.path().string()),
      machine("XDG_DATA_DIRS", "/nowhere");
  const auto results = pipeline::convert({folder / "human.mp4"}, into(folder));
  EXPECT_TRUE(results[0].failed);
  EXPECT_THAT(results[0].verdict, testing::HasSubstr("./setup.sh --pose"));
}

TEST(Convert, LeavesAloneWhatHasNotChanged) {
  const TemporaryFolder folder;
  put_human(folder);
  const std::vector<std::filesystem::path> inputs{folder / "human.trajectory.csv"};
  pipeline::ConvertOptions options = into(folder);
  EXPECT_FALSE(pipeline::convert(inputs, options)[0].unchanged);
  const auto again = pipeline::convert(inputs, options);
  EXPECT_TRUE(again[0].unchanged);
  EXPECT_NEAR(again[0].period_s, 0.6867, 0.003);
  options.clip.keyframes.weight = 2;
  EXPECT_FALSE(pipeline::convert(inputs, options)[0].unchanged);
  // A run on the model's proportions, as an agent's own, is converted too, and to the same stride.
  const auto run = pipeline::convert({folder / "out" / "human.calibrated.csv"}, [&] {
    pipeline::ConvertOptions other = options;
    other.out = folder / "other";
    return other;
  }());
  EXPECT_FALSE(run[0].failed) << run[0].verdict;
  EXPECT_EQ(read_file(folder / "other" / "human.potential.json"),
            read_file(folder / "out" / "human.potential.json"));
}

TEST(Convert, MakesAnewWhatIsGoneOrNotItsOwn) {
  const TemporaryFolder folder;
  put_human(folder);
  const std::vector<std::filesystem::path> inputs{folder / "human.trajectory.csv"};
  const pipeline::ConvertOptions options = into(folder);
  pipeline::convert(inputs, options);
  std::filesystem::remove(folder / "out" / "human.calibrated.csv");
  EXPECT_FALSE(pipeline::convert(inputs, options)[0].unchanged);
  EXPECT_TRUE(std::filesystem::exists(folder / "out" / "human.calibrated.csv"));
  const auto stamp = folder / "out" / "human.converted.json";
  for (const char* other : {"{\"inputs\": 3}", "{}", "{\"inputs\": [1]}"}) {
    write_file_atomically(stamp, other);
    const auto result = pipeline::convert(inputs, options)[0];
    EXPECT_FALSE(result.failed) << result.verdict;
    EXPECT_FALSE(result.unchanged);
  }
  write_file_atomically(stamp, "my notes");
  EXPECT_THAT(pipeline::convert(inputs, options)[0].verdict,
              testing::HasSubstr("human.converted.json: there is a text of that name"));
  EXPECT_EQ(read_file(stamp), "my notes");
}

TEST(Convert, PassesOverItsOwnVideosInAFolder) {
  const TemporaryFolder folder;
  for (const char* name : {"a.mp4", "a.overlay.mp4", "a.loop.mp4"})
    std::filesystem::copy_file(STRIDE_SOURCE_DIR "/videos/small.mp4", folder / name);
  for (const char* name : {"a", "a.overlay", "a.loop"})
    write_file_atomically(folder / (std::string(name) + ".keypoints.json"), "{}");
  const auto inputs = pipeline::expand_inputs({folder.path()});
  ASSERT_EQ(inputs.size(), 1U);
  EXPECT_EQ(inputs[0].filename(), "a.mp4");
}

TEST(Convert, GoesOnWhereItWasKilled) {
  const TemporaryFolder folder;
  std::vector<std::filesystem::path> inputs;
  for (const char* name : {"a", "b"}) {
    inputs.push_back(folder / (std::string(name) + ".trajectory.csv"));
    std::filesystem::copy_file(kVideos / "human.truth.csv", inputs.back());
  }
  // Killed as soon as the first clip is done: the second is then under way.
  const pid_t killed = ::fork();
  if (killed == 0) {
    pipeline::ConvertOptions options = into(folder);
    options.threads = 1;
    options.progress = [](const std::string&) { ::_exit(0); };
    pipeline::convert(inputs, options);
  }
  ::waitpid(killed, nullptr, 0);
  std::string progress;
  pipeline::ConvertOptions options = into(folder);
  options.threads = 1;
  options.progress = [&](const std::string& line) { progress += line + "\n"; };
  const auto results = pipeline::convert(inputs, options);
  EXPECT_TRUE(results[0].unchanged);
  EXPECT_FALSE(results[1].unchanged || results[1].failed) << results[1].verdict;
  EXPECT_THAT(progress, testing::HasSubstr("1 of 2: a: unchanged"));
  EXPECT_THAT(progress, testing::HasSubstr("2 of 2: b: ok"));
}

TEST(Convert, SaysHowLongItWillTake) {
  const TemporaryFolder folder;
  put_human(folder);
  std::filesystem::copy_file(kVideos / "human.truth.csv", folder / "other.trajectory.csv");
  std::vector<std::string> progress;
  pipeline::ConvertOptions options = into(folder);
  options.threads = 1;
  options.progress = [&](const std::string& line) { progress.push_back(line); };
  pipeline::convert({folder / "human.trajectory.csv", folder / "other.trajectory.csv"}, options);
  ASSERT_EQ(progress.size(), 2u);
  EXPECT_THAT(progress[0], testing::MatchesRegex("1 of 2: human: ok .about [0-9]+ s left."));
  EXPECT_THAT(progress[1], testing::Not(testing::HasSubstr("left")));
}

TEST(Convert, TakesTheClicksThatAKilledWindowLeft) {
  const TemporaryFolder folder;
  for (const char* name : {"human.mp4", "human.keypoints.json"})
    std::filesystem::copy_file(kVideos / name, folder / name);
  const auto clicks = folder / "human.keypoints.json";
  EXPECT_FALSE(pipeline::convert({folder / "human.mp4"}, into(folder))[0].failed);
  const auto frame = load_keypoints(clicks).frames.begin()->first;
  const pid_t window = ::fork();
  if (window == 0) {
    annotation::AnnotationJournal journal(clicks, Keypoints());
    const Click click{{1.5, 2.5}, ClickState::seen, ""};
    journal.apply({"a click", {{frame, 0, BodyPart::head, click}}, {}});
    ::_exit(0);
  }
  ::waitpid(window, nullptr, 0);
  EXPECT_FALSE(load_keypoints(clicks).frames.at(frame)[BodyPart::head]);
  EXPECT_FALSE(pipeline::convert({folder / "human.mp4"}, into(folder))[0].unchanged);
  EXPECT_EQ(load_keypoints(clicks).frames.at(frame)[BodyPart::head]->p_px.x(), 1.5);
}

TEST(Convert, OneFailureStopsNoOther) {
  const TemporaryFolder folder;
  put_human(folder);
  write_file_atomically(folder / "garbage.trajectory.csv", "not a table of ours\n1\n");
  const auto results = pipeline::convert(
      {folder / "garbage.trajectory.csv", folder / "human.trajectory.csv"}, into(folder));
  EXPECT_TRUE(results[0].failed);
  EXPECT_THAT(results[0].verdict, testing::HasSubstr("not a file of ours"));
  EXPECT_FALSE(results[1].failed);
  EXPECT_THAT(pipeline::table_of(results), testing::HasSubstr("failed: "));
}

TEST(Convert, RefusesACalibratedRunThatNobodyRuns) {
  const TemporaryFolder folder;
  put_human(folder);
  pipeline::convert({folder / "human.trajectory.csv"}, into(folder));
  std::string run = read_file(folder / "out" / "human.calibrated.csv");
  const auto begin = run.find("# period_s: "), end = run.find('\n', begin);
  run.replace(begin, end - begin, "# period_s: 1e9");
  write_file_atomically(folder / "slow.calibrated.csv", run);
  pipeline::ConvertOptions options = into(folder);
  EXPECT_THAT(pipeline::convert({folder / "slow.calibrated.csv"}, options)[0].verdict,
              testing::HasSubstr("a stride takes 1000000000.00 s"));
  options.clip.force = true;
  EXPECT_FALSE(pipeline::convert({folder / "slow.calibrated.csv"}, options)[0].failed);
}

TEST(Convert, NamesAFileThatItCannotUse) {
  const TemporaryFolder folder;
  write_file_atomically(folder / "a.txt", "x");
  EXPECT_ERROR(pipeline::expand_inputs({folder / "a.txt"}), "a.txt: is a text; must be a video");
  EXPECT_ERROR(pipeline::expand_inputs({folder / "none.mp4"}), "none.mp4: no such file");
  EXPECT_ERROR(pipeline::expand_inputs({folder.path()}), "no video with NAME.keypoints.json");
}

TEST(Convert, ReadsSettingsOfAllClipsAndOfOne) {
  const TemporaryFolder folder;
  pipeline::ConvertOptions options;
  write_file_atomically(folder / "a.toml",
                        "weight = 0.5\nfunction = \"pf2\"\n[clip.human]\nheight = 1.8\n");
  pipeline::load_convert_config(folder / "a.toml", options);
  EXPECT_EQ(options.clip.keyframes.weight, 0.5);
  EXPECT_FALSE(options.clip.size.height_m);
  const pipeline::ClipOptions& human = options.by_clip.at("human");
  EXPECT_EQ(human.size.height_m, 1.8);
  EXPECT_EQ(human.keyframes.function, InverseDistance::pf2);
  write_file_atomically(folder / "b.toml", "wieght = 0.5\n");
  EXPECT_ERROR(pipeline::load_convert_config(folder / "b.toml", options),
               "key 'wieght' is not known; use");
  for (const char* wrong :
       {"weight = -1\n", "epsilon = 0\n", "keyframes = 8.5\n", "weight = nan\n"}) {
    write_file_atomically(folder / "d.toml", wrong);
    EXPECT_ERROR(pipeline::load_convert_config(folder / "d.toml", options), "must be");
  }
  write_file_atomically(folder / "c.toml", "function = \"pf9\"\n");
  EXPECT_ERROR(pipeline::load_convert_config(folder / "c.toml", options),
               "function = 'pf9': must be one of");
}

}  // namespace
}  // namespace stride
