#include "extract/annotation/journal.h"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include <csignal>
#include <fstream>
#include <random>

#include "extract/annotation/change_json.h"
#include "extract/io/file.h"
#include "tests/support/killed_after.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/throws.h"

namespace stride {
namespace {

Keypoints fresh() {
  Keypoints k;
  k.video = "run.mp4";
  k.video_sha256 = "00";
  k.width_px = 640;
  k.height_px = 360;
  return k;
}

annotation::Change click(int frame, BodyPart part, double x_px) {
  return {"a click", {{frame, frame / 30.0, part, Click{{x_px, 0.1}, ClickState::seen, ""}}}, {}};
}

std::string slurp(const std::filesystem::path& file) { return read_file(file); }

TEST(AnnotationDocument, TakesBackAndMakesAgainWithoutLimit) {
  annotation::AnnotationDocument document(fresh());
  std::vector<std::string> states{text_of(document.keypoints())};
  std::mt19937_64 random(7);
  for (int i = 0; i < 300; ++i) {
    annotation::Change change =
        click(static_cast<int>(random() % 20), kBodyParts[random() % kBodyPartCount], i);
    if (i % 7 == 0) change.clicks[0].click.reset();
    if (i % 11 == 0) {
      change.settings = annotation::settings_of(document.keypoints());
      change.settings->slow_motion = 1 + static_cast<double>(i % 4);
      change.settings->notes = std::to_string(i);
    }
    document.apply(change);
    states.push_back(text_of(document.keypoints()));
  }
  for (int i = 299; i >= 0; --i) {
    ASSERT_TRUE(document.undo());
    ASSERT_TRUE(text_of(document.keypoints()) == states[static_cast<std::size_t>(i)]) << i;
  }
  EXPECT_FALSE(document.undo());
  for (std::size_t i = 1; i <= 300; ++i) {
    ASSERT_TRUE(document.redo());
    ASSERT_TRUE(text_of(document.keypoints()) == states[i]) << i;
  }
  EXPECT_FALSE(document.redo());
}

TEST(AnnotationDocument, RefusesWhatTheFormatDoesNotAllowAndStaysAsItWas) {
  annotation::AnnotationDocument document(fresh());
  document.apply(click(1, BodyPart::head, 5));
  const std::string before = text_of(document.keypoints());
  EXPECT_ERROR(document.apply(click(2, BodyPart::head, 700)), "outside the frame");
  EXPECT_EQ(text_of(document.keypoints()), before);
}

TEST(AnnotationDocument, ChangesSurviveTheirJson) {
  annotation::Change change = click(3, BodyPart::toe_l, 1.0 / 3);
  change.clicks.push_back({4, 0.2, BodyPart::head, std::nullopt});
  change.settings = annotation::ClipSettings{Facing::left,
                                             Side::right,
                                             2.5,
                                             true,
                                             FrameRange{1, 9},
                                             FloorLine{{0, 1}, {2, 3.25}},
                                             CalibrationLine{7, {1.5, 2}, {1.5, 102}, 0.75},
                                             "a \"note\""};
  const annotation::Change back = annotation::change_of(annotation::line_of(change), "here");
  EXPECT_EQ(annotation::line_of(back), annotation::line_of(change));
  EXPECT_EQ(back.clicks[0].click->p_px.x(), 1.0 / 3);
  EXPECT_EQ(back.settings->trim->last, 9);
  EXPECT_EQ(back.settings->calibration_line->frame, 7);
  EXPECT_EQ(back.settings->calibration_line->length_m, 0.75);
  EXPECT_ERROR(annotation::change_of("{\"what\":1}", "here"),
               "here: not a line of an annotation journal");
  std::string damaged = annotation::line_of(change);
  damaged.replace(damaged.find("\"frame\":3"), 9, "\"frame\":3e99");
  EXPECT_ERROR(annotation::change_of(damaged, "here"), "here: frame 3e+99: must not be");
}

TEST(AnnotationJournal, FoldsWhenItCloses) {
  const TemporaryFolder folder;
  const auto file = folder / "run.keypoints.json";
  {
    annotation::AnnotationJournal journal(file, fresh());
    journal.apply(click(3, BodyPart::knee_r, 12.25));
    EXPECT_ERROR(annotation::AnnotationJournal(file, fresh()),
                 "another window is annotating this video");
    annotation::fold_left_over_journal(file);
    EXPECT_TRUE(std::filesystem::exists(annotation::journal_file_of(file)));
  }
  EXPECT_FALSE(std::filesystem::exists(annotation::journal_file_of(file)));
  EXPECT_EQ(load_keypoints(file).frames.at(3)[BodyPart::knee_r]->p_px.x(), 12.25);
}

TEST(AnnotationJournal, UndoesWhatAnEarlierWindowDid) {
  const TemporaryFolder folder;
  const auto file = folder / "run.keypoints.json";
  {
    annotation::AnnotationJournal journal(file, fresh());
    journal.apply(click(3, BodyPart::pelvis, 10));
    journal.apply(click(3, BodyPart::pelvis, 20));
  }
  {
    annotation::AnnotationJournal journal(file, fresh());
    journal.apply(click(4, BodyPart::head, 30));
  }
  annotation::AnnotationJournal journal(file, fresh());
  EXPECT_EQ(journal.recovered(), 0);
  ASSERT_TRUE(journal.undo());
  EXPECT_FALSE(journal.document().keypoints().frames.contains(4));
  ASSERT_TRUE(journal.undo());
  EXPECT_EQ(journal.document().keypoints().frames.at(3)[BodyPart::pelvis]->p_px.x(), 10);
  ASSERT_TRUE(journal.undo());
  EXPECT_TRUE(journal.document().keypoints().frames.empty());
  EXPECT_FALSE(journal.undo());
}

TEST(AnnotationJournal, UndoesNothingInAFileThatWasEditedMeanwhile) {
  const TemporaryFolder folder;
  const auto file = folder / "run.keypoints.json";
  {
    annotation::AnnotationJournal journal(file, fresh());
    journal.apply(click(3, BodyPart::pelvis, 10));
  }
  Keypoints edited = load_keypoints(file);
  edited.notes = "by another program";
  save(edited, file);
  annotation::AnnotationJournal journal(file, fresh());
  EXPECT_FALSE(journal.undo());
}

TEST(AnnotationJournal, LeavesNoFileWhereNothingWasClicked) {
  const TemporaryFolder folder;
  { annotation::AnnotationJournal journal(folder / "run.keypoints.json", fresh()); }
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

TEST(AnnotationJournal, NeverReplacesAFileThatWasEditedMeanwhile) {
  const TemporaryFolder folder;
  const auto file = folder / "run.keypoints.json";
  Keypoints others = fresh();
  others.notes = "edited elsewhere";
  {
    annotation::AnnotationJournal journal(file, fresh());
    journal.apply(click(3, BodyPart::knee_r, 12));
    save(others, file);
    journal.apply(click(4, BodyPart::knee_r, 13));
    EXPECT_ERROR(journal.fold(), "run.keypoints.mine1.json from now on");
    journal.apply(click(5, BodyPart::knee_r, 14));
  }
  EXPECT_EQ(load_keypoints(file).notes, "edited elsewhere");
  EXPECT_EQ(load_keypoints(folder / "run.keypoints.mine1.json").frames.size(), 3u);
}

TEST(AnnotationJournal, RefusesKeypointsOfANewerProgramOrAnotherVideo) {
  const TemporaryFolder folder;
  const auto file = folder / "run.keypoints.json";
  save(fresh(), file);
  Keypoints other = fresh();
  other.video_sha256 = "11";
  EXPECT_ERROR(annotation::AnnotationJournal(file, other), "was clicked on another video");
  std::string text = slurp(file);
  text.replace(text.find("\"version\": 1"), 12, "\"version\": 9");
  std::ofstream(file) << text;
  EXPECT_ERROR(annotation::AnnotationJournal(file, fresh()),
               "version 9: this program reads up to version 1");
  EXPECT_EQ(slurp(file), text);
}

TEST(AnnotationJournal, AKilledWindowLosesNoClick) {
  const TemporaryFolder folder(memory_folder());
  std::mt19937_64 random(99);
  for (int round = 0; round < 100; ++round) {
    const auto file = folder / fmt::format("run{}.keypoints.json", round);
    const int confirmed = killed_after(static_cast<int>(random() % 40), [&](auto confirm) {
      annotation::AnnotationJournal journal(file, fresh());
      for (int i = 0; i < 60; ++i) {
        journal.apply(click(i, BodyPart::knee_r, i));
        confirm();
        if (i % 5 == 4) {
          journal.undo();
          journal.redo();
        }
        if (i % 8 == 7) journal.fold();
      }
      for (;;) ::pause();
    });
    if (round % 2 == 0) annotation::fold_left_over_journal(file);
    annotation::AnnotationJournal journal(file, fresh());
    const auto& frames = journal.document().keypoints().frames;
    // The last one may have been undone, to be redone, when the program died.
    ASSERT_GE(static_cast<int>(frames.size()), confirmed - (confirmed % 5 == 0 ? 1 : 0));
    ASSERT_LE(static_cast<int>(frames.size()), confirmed + 1);
    for (const auto& [number, frame] : frames) ASSERT_EQ(frame[BodyPart::knee_r]->p_px.x(), number);
  }
}

TEST(AnnotationJournal, SaysWhenTheDiskIsFullAndKeepsWhatWasSaved) {
  const TemporaryFolder folder;
  const auto file = folder / "run.keypoints.json";
  std::signal(SIGXFSZ, SIG_IGN);
  rlimit before;
  ASSERT_EQ(::getrlimit(RLIMIT_FSIZE, &before), 0);
  int saved = 0;
  {
    annotation::AnnotationJournal journal(file, fresh());
    rlimit small = before;
    small.rlim_cur = 5000;  // a file that may not grow behaves as a disk without room
    ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &small), 0);
    try {
      for (;; ++saved) journal.apply(click(saved, BodyPart::knee_r, saved));
    } catch (const Error& error) {
      EXPECT_THAT(std::string(error.what()), ::testing::HasSubstr("run.keypoints.journal: not "
                                                                  "saved (File too large); what "
                                                                  "was saved before is safe"));
    }
    EXPECT_EQ(static_cast<int>(journal.document().keypoints().frames.size()), saved);
    ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &before), 0);
  }
  EXPECT_GT(saved, 10);
  EXPECT_EQ(static_cast<int>(load_keypoints(file).frames.size()), saved);
}

TEST(AnnotationJournal, SaysWhenTheFolderCannotBeWritten) {
  EXPECT_ERROR(annotation::AnnotationJournal("/proc/run.keypoints.json", fresh()),
               "/proc/run.keypoints.journal: cannot be written");
}

}  // namespace
}  // namespace stride
