#include "extract/annotation/session/session.h"

#include <gtest/gtest.h>

#include <fstream>
#include <opencv2/core.hpp>
#include <random>

#include "extract/annotation/asking.h"
#include "extract/annotation/checks.h"
#include "extract/annotation/session/draw.h"
#include "extract/annotation/session/predict.h"
#include "extract/annotation/session/script.h"
#include "extract/io/file.h"
#include "tests/support/killed_after.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/throws.h"

namespace stride {
namespace {

const std::filesystem::path kShipped = std::filesystem::path(STRIDE_SOURCE_DIR) / "videos";
const std::filesystem::path kAnnotated = std::filesystem::path(STRIDE_TEST_DATA) / "annotation";

using Kind = annotation::AnnotationEvent::Kind;
using Button = annotation::AnnotationEvent::Button;
using Mode = annotation::AnnotationSession::Mode;

/// A session on the runner's clip, with nothing clicked.
class Annotating : public ::testing::Test {
 protected:
  Annotating() : frames(kShipped / "human.mp4") {
    frames.wait();
    fresh.video = "human.mp4";
    fresh.video_sha256 = "00";
    fresh.width_px = frames.info().width_px;
    fresh.height_px = frames.info().height_px;
    journal =
        std::make_unique<annotation::AnnotationJournal>(folder / "human.keypoints.json", fresh);
    session = std::make_unique<annotation::AnnotationSession>(*journal, frames);
  }

  void key(int code) {
    annotation::AnnotationEvent event;
    event.kind = Kind::key;
    event.key = code;
    session->handle(event);
  }
  void mouse(Kind kind, const Eigen::Vector2d& canvas, Button button = Button::left) {
    annotation::AnnotationEvent event;
    event.kind = kind;
    event.p_canvas = canvas;
    event.button = button;
    session->handle(event);
  }
  Eigen::Vector2d canvas(double x_px, double y_px) const {
    return session->view().to_canvas({x_px, y_px});
  }
  void click(double x_px, double y_px, Button button = Button::left) {
    const Eigen::Vector2d p = canvas(x_px, y_px);
    mouse(Kind::press, p, button);
    mouse(Kind::release, p, button);
  }
  void answer() {
    key('r');
    key(annotation::key::kEnter);
  }
  void complete_frame(double x_px) {
    for (int i = 0; i < 7; ++i) click(x_px, 40 + 40 * i);
  }
  const ClickedFrame& clicked(int frame) const { return session->keypoints().frames.at(frame); }

  TemporaryFolder folder;
  video::FrameStore frames;
  Keypoints fresh;
  std::unique_ptr<annotation::AnnotationJournal> journal;
  std::unique_ptr<annotation::AnnotationSession> session;
};

TEST_F(Annotating, AsksForDirectionAndNearLegOnce) {
  EXPECT_EQ(session->mode(), Mode::ask_direction);
  click(100, 100);
  EXPECT_TRUE(session->keypoints().frames.empty());
  key('l');
  EXPECT_EQ(session->mode(), Mode::ask_near_leg);
  key(annotation::key::kEnter);
  EXPECT_EQ(session->keypoints().direction, Facing::left);
  EXPECT_EQ(session->keypoints().near_leg, Side::left);
  annotation::AnnotationSession again(*journal, frames);
  EXPECT_EQ(again.mode(), Mode::click);
}

TEST_F(Annotating, AsksForThePartsInTurnAndGoesOnToTheNextPhaseFrame) {
  answer();
  for (const BodyPart part :
       {BodyPart::pelvis, BodyPart::knee_r, BodyPart::ankle_r, BodyPart::toe_r, BodyPart::knee_l,
        BodyPart::ankle_l, BodyPart::toe_l}) {
    ASSERT_EQ(session->asked(), part);
    click(50 + 30 * index(part), 100);
    EXPECT_NEAR(clicked(0)[part]->p_px.x(), 50 + 30 * index(part), 1e-9);
  }
  // An eighth of 0.7 s at 30 frames a second.
  EXPECT_EQ(session->frame(), 3);
  EXPECT_EQ(session->asked(), BodyPart::pelvis);
}

TEST_F(Annotating, OfAJumpTheHeadIsAskedForToo) {
  annotation::ClipSettings settings;
  settings.movement = "jump";
  journal->apply({"a jump", {}, settings});
  session = std::make_unique<annotation::AnnotationSession>(*journal, frames);
  answer();
  for (int part = 0; part < 7; ++part) {
    EXPECT_NE(session->asked(), BodyPart::head);
    click(50 + 30 * part, 100);
  }
  EXPECT_EQ(session->frame(), 0);
  EXPECT_EQ(session->asked(), BodyPart::head);
  click(300, 40);
  EXPECT_GT(session->frame(), 0);
  EXPECT_EQ(session->keypoints().movement, "jump");
}

TEST_F(Annotating, TellsSeenEstimatedAndAbsentApart) {
  answer();
  click(100, 50);
  click(110, 90, Button::right);
  key('x');
  EXPECT_EQ(clicked(0)[BodyPart::pelvis]->state, ClickState::seen);
  EXPECT_EQ(clicked(0)[BodyPart::knee_r]->state, ClickState::estimated);
  EXPECT_EQ(clicked(0)[BodyPart::ankle_r]->state, ClickState::absent);
}

TEST_F(Annotating, DigitsChooseAPartAndNudgesMoveItByAQuarterPixel) {
  answer();
  key('5');
  EXPECT_EQ(session->asked(), BodyPart::knee_l);
  click(200, 100);
  key('i');
  key('l');
  key('l');
  EXPECT_NEAR(clicked(0)[BodyPart::knee_l]->p_px.x(), 200.5, 1e-9);
  EXPECT_NEAR(clicked(0)[BodyPart::knee_l]->p_px.y(), 99.75, 1e-9);
  EXPECT_EQ(session->asked(), BodyPart::ankle_l);
  key('0');
  EXPECT_EQ(session->asked(), BodyPart::head);
  key('8');
  EXPECT_EQ(session->asked(), BodyPart::hip_r);
}

TEST_F(Annotating, DragsAPointAndStillPlacesOneOnTopOfAnother) {
  answer();
  click(200, 100);
  mouse(Kind::press, canvas(201, 101));
  mouse(Kind::move, canvas(231, 111));
  mouse(Kind::release, canvas(231, 111));
  EXPECT_NEAR(clicked(0)[BodyPart::pelvis]->p_px.x(), 230, 1e-9);
  EXPECT_FALSE(clicked(0)[BodyPart::knee_r]);
  // Without a move it is a click: legs do cross. The first of them may be a double click's second.
  click(231, 111);
  EXPECT_FALSE(clicked(0)[BodyPart::knee_r]);
  EXPECT_NE(session->message().find("a double click?"), std::string::npos);
  click(231, 111);
  EXPECT_NEAR(clicked(0)[BodyPart::knee_r]->p_px.x(), 231, 1e-9);
}

TEST_F(Annotating, UndoAndRedoCoverEverything) {
  answer();
  complete_frame(100);
  key('s');
  key('m');
  const std::string last = text_of(session->keypoints());
  for (int i = 0; i < 40; ++i) key('u');
  EXPECT_TRUE(session->keypoints().frames.empty());
  EXPECT_EQ(session->keypoints().direction, std::nullopt);
  EXPECT_TRUE(session->has_problem());
  EXPECT_EQ(session->message(), "nothing to be undone");
  for (int i = 0; i < 40; ++i) key('r');
  EXPECT_EQ(session->mode(), Mode::click);
  EXPECT_EQ(text_of(session->keypoints()), last);
}

TEST_F(Annotating, SwapsLegsHereOrInARange) {
  answer();
  complete_frame(100);
  complete_frame(120);
  const double knee_r = clicked(0)[BodyPart::knee_r]->p_px.y();
  const double knee_l = clicked(0)[BodyPart::knee_l]->p_px.y();
  session->go_to(0);
  key('b');
  session->go_to(20);
  key('s');
  for (const int frame : {0, 3}) {
    EXPECT_EQ(clicked(frame)[BodyPart::knee_r]->p_px.y(), knee_l);
    EXPECT_EQ(clicked(frame)[BodyPart::knee_l]->p_px.y(), knee_r);
  }
  session->go_to(3);
  key('s');
  EXPECT_EQ(clicked(3)[BodyPart::knee_r]->p_px.y(), knee_r);
  EXPECT_EQ(clicked(0)[BodyPart::knee_r]->p_px.y(), knee_l);
  key('u');
  key('u');
  EXPECT_EQ(clicked(3)[BodyPart::knee_r]->p_px.y(), knee_r);
  EXPECT_EQ(clicked(0)[BodyPart::knee_r]->p_px.y(), knee_r);
}

TEST_F(Annotating, CopiesWhatIsMissingFromTheNearestClickedFrame) {
  answer();
  complete_frame(100);
  click(150, 50);
  key('c');
  EXPECT_NEAR(clicked(3)[BodyPart::pelvis]->p_px.x(), 150, 1e-9);
  EXPECT_NEAR(clicked(3)[BodyPart::toe_l]->p_px.x(), 100, 1e-9);
  EXPECT_FALSE(session->asked());
}

TEST_F(Annotating, ZoomedInAClickIsFinerThanAPixel) {
  answer();
  mouse(Kind::move, canvas(300, 200));
  key('z');
  EXPECT_NEAR(session->view().scale, 8, 1e-12);
  EXPECT_NEAR(canvas(300, 200).x(), session->view().to_canvas({300, 200}).x(), 1e-9);
  mouse(Kind::press, canvas(300, 200) + Eigen::Vector2d(1, 0));
  EXPECT_NEAR(clicked(0)[BodyPart::pelvis]->p_px.x(), 300.125, 1e-9);
  key('z');
  EXPECT_NEAR(session->view().scale, session->view().fitting_scale(), 1e-12);
}

TEST_F(Annotating, TakesFloorTrimSlowMotionAndNotes) {
  answer();
  click(100, 50);
  key('o');
  click(10, 300);
  click(600, 310);
  EXPECT_NEAR(session->keypoints().floor->to_px.y(), 310, 1e-9);
  session->go_to(5);
  key('b');
  session->go_to(60);
  key('t');
  EXPECT_EQ(session->keypoints().trim->first, 5);
  EXPECT_EQ(session->keypoints().trim->last, 60);
  key('y');
  for (const char c : {'2', '.', '5'}) key(c);
  key(annotation::key::kEnter);
  EXPECT_EQ(session->keypoints().slow_motion, 2.5);
  key('y');
  key('q');  // a letter here, not the command
  key(annotation::key::kEnter);
  EXPECT_TRUE(session->has_problem());
  EXPECT_THAT(session->message(), ::testing::HasSubstr("slow motion = 'q': must be"));
  key('g');
  for (const char c : {'h', 'i'}) key(c);
  key(annotation::key::kEnter);
  EXPECT_EQ(session->keypoints().notes, "hi");
  EXPECT_FALSE(session->done());
}

TEST_F(Annotating, TakesALineOfKnownLengthAsOneEdit) {
  answer();
  complete_frame(300);  // a leg of 4 x 40 px from pelvis to far ankle
  session->go_to(0);
  const auto draw_line = [&](double to_y_px, const std::string& length) {
    key('\'');
    click(100, 60);
    click(100, to_y_px);
    for (const char c : length) key(c);
    key(annotation::key::kEnter);
  };
  draw_line(260, "1,5");
  ASSERT_TRUE(session->keypoints().calibration_line) << session->message();
  const CalibrationLine line = *session->keypoints().calibration_line;
  EXPECT_EQ(line.frame, 0);
  EXPECT_NEAR(line.metres_per_pixel(), 1.5 / 200, 1e-9);
  EXPECT_THAT(session->message(), ::testing::HasSubstr("the leg is "));
  EXPECT_EQ(session->keypoints().frames.size(), 1u);  // nothing was clicked beside it
  EXPECT_THAT(read_file(annotation::journal_file_of(folder / "human.keypoints.json")),
              ::testing::HasSubstr("calibration_line"));
  key('u');
  EXPECT_FALSE(session->keypoints().calibration_line);
  key('r');
  ASSERT_TRUE(session->keypoints().calibration_line);
  session->rest();
  EXPECT_EQ(load_keypoints(folder / "human.keypoints.json").calibration_line->length_m, 1.5);

  // What cannot be is refused and leaves the line as it was.
  for (const auto& [to_y_px, length] :
       {std::pair{260.0, "0"}, {260.0, "-1"}, {260.0, "many"}, {260.0, "500"}, {260.0, "20"}}) {
    draw_line(to_y_px, length);
    EXPECT_TRUE(session->has_problem()) << length;
    EXPECT_EQ(session->keypoints().calibration_line->length_m, 1.5) << length;
    EXPECT_EQ(session->mode(), Mode::click);
  }
  key('\'');
  click(100, 60);
  click(105, 62);
  EXPECT_THAT(session->message(), ::testing::HasSubstr("must be 10 px or more apart"));
  EXPECT_EQ(session->mode(), Mode::length_to);
  key(annotation::key::kEscape);
  key('\'');
  key(annotation::key::kBackspace);
  EXPECT_FALSE(session->keypoints().calibration_line);
  key('u');
  EXPECT_TRUE(session->keypoints().calibration_line);
}

TEST_F(Annotating, EveryEditIsOnDiskWhenTheEventReturns) {
  answer();
  click(100, 50);
  click(110, 80);
  const std::string log = read_file(annotation::journal_file_of(folder / "human.keypoints.json"));
  EXPECT_THAT(log, ::testing::HasSubstr("knee_r"));
  session->rest();
  EXPECT_TRUE(load_keypoints(folder / "human.keypoints.json").frames.at(0)[BodyPart::knee_r]);
}

TEST_F(Annotating, AWindowKilledAtAHundredMomentsKeepsEveryClick) {
  const TemporaryFolder memory(memory_folder());
  std::mt19937_64 random(7);
  for (int round = 0; round < 100; ++round) {
    const auto file = memory / fmt::format("run{}.keypoints.json", round);
    const auto placed = [](const Keypoints& keypoints) {
      int clicks = 0;
      for (const auto& [number, frame] : keypoints.frames)
        for (const BodyPart part : kBodyParts) clicks += frame.placed(part);
      return clicks;
    };
    const int confirmed = killed_after(static_cast<int>(random() % 50), [&](auto confirm) {
      journal = std::make_unique<annotation::AnnotationJournal>(file, fresh);
      session = std::make_unique<annotation::AnnotationSession>(*journal, frames);
      answer();
      for (int i = 0; i < 60; ++i) {
        click(100 + 7 * i, 60 + 40 * (i % 7));
        confirm();
        if (i % 9 == 8) session->rest();
      }
      for (;;) ::pause();
    });
    const annotation::AnnotationJournal recovered(file, fresh);
    const Keypoints& keypoints = recovered.document().keypoints();
    ASSERT_GE(placed(keypoints), confirmed);
    ASSERT_LE(placed(keypoints), confirmed + 1);  // one that was not yet confirmed
    if (confirmed > 0) {
      ASSERT_EQ(keypoints.near_leg, Side::right);
    }
  }
}

TEST_F(Annotating, PredictsBetweenClicks) {
  const Keypoints truth = load_keypoints(kShipped / "human.keypoints.json");
  const annotation::Prediction prediction =
      annotation::predict(truth, frames, std::atomic<bool>(false)).value();
  EXPECT_NEAR(prediction.stride_frames, 0.689 * 30, 0.3);  // the period the clip was made with
  EXPECT_TRUE(prediction.suspects.empty());
  const std::atomic<bool> given_up = true;
  EXPECT_FALSE(annotation::predict(truth, frames, given_up));
  answer();
  complete_frame(100);
  session->set_prediction(prediction);
  session->go_to(30);
  key(annotation::key::kEnter);
  const Point& ghost = prediction.trajectory.frames[30][BodyPart::pelvis];
  EXPECT_EQ(clicked(30)[BodyPart::pelvis]->p_px, ghost.p_px);
}

TEST_F(Annotating, GoesToTheWorstFramesInTurnAndToSuspectedSwaps) {
  answer();
  complete_frame(100);
  annotation::Prediction prediction;
  prediction.suspects = {7, 10};
  for (int f = 0; f < 90; ++f) {
    TrajectoryFrame& frame = prediction.trajectory.frames.emplace_back();
    frame.frame = f;
    for (Point& point : frame.points)
      point = {{100, 100}, Source::tracked, f == 60 ? 0.1 : f == 40 ? 0.2 : f == 1 ? 0 : 0.9};
    if (f == 20) frame[BodyPart::toe_l].confidence = 0.3;
  }
  session->set_prediction(prediction);
  key('n');
  EXPECT_EQ(session->frame(), 60);
  key('n');
  EXPECT_EQ(session->frame(), 40);
  key('n');
  EXPECT_EQ(session->frame(), 20);  // by one part alone
  key('n');                         // frame 1 is beside a click
  EXPECT_EQ(session->message(), "everything else has been followed in the picture");
  key('f');
  EXPECT_EQ(session->frame(), 7);
  key('f');
  EXPECT_EQ(session->frame(), 10);
  key('f');
  EXPECT_EQ(session->frame(), 7);
}

TEST_F(Annotating, AZoomedViewGoesWithTheRunner) {
  answer();
  annotation::AnnotationEvent wheel;
  wheel.kind = Kind::wheel;
  wheel.p_canvas = {640, 340};
  wheel.wheel = 1;
  for (int turn = 0; turn < 4; ++turn) session->handle(wheel);
  click(310, 180);
  session->go_to(4);
  click(330, 180);
  const double there = canvas(330, 180).x();
  session->go_to(0);
  EXPECT_NEAR(canvas(310, 180).x(), there, 1e-9);
  session->go_to(8);  // nothing is known of it: the runner continues at the same speed
  EXPECT_NEAR(canvas(350, 180).x(), there, 1e-9);
}

TEST_F(Annotating, TheTimelineIsClickable) {
  answer();
  mouse(Kind::press, {96 + (1280 - 108) * 40.5 / 96, 720});
  EXPECT_EQ(session->frame(), 40);
  mouse(Kind::move, {96 + (1280 - 108) * 50.5 / 96, 500});
  mouse(Kind::release, {0, 0});
  EXPECT_EQ(session->frame(), 50);
}

TEST_F(Annotating, DrawsAClickWhereItWasMade) {
  answer();
  click(300, 100);
  const cv::Mat picture = session->picture();
  EXPECT_EQ(picture.size(), cv::Size(1280, 860));
  const Eigen::Vector2d p = canvas(300, 100);
  const auto pixel = picture.at<cv::Vec3b>(cvRound(p.y()), cvRound(p.x()));
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(pixel[i], annotation::colour::kMiddle[i], 12);
}

TEST_F(Annotating, RandomEventsNeverBreakIt) {
  std::mt19937_64 random(5);
  const std::string keys = "abcdefghijklmnoprstuvxyz0123456789[]-=. ?/";
  for (int i = 0; i < 1500; ++i) {
    switch (random() % 4) {
      case 0:
        key(random() % 8 == 0 ? annotation::key::kEnter : keys[random() % keys.size()]);
        break;
      default: {
        annotation::AnnotationEvent event;
        event.kind = static_cast<Kind>(random() % 4);
        event.button = static_cast<Button>(random() % 3);
        event.wheel = random() % 2 == 0 ? 1 : -1;
        event.p_canvas = {static_cast<double>(random() % 1400) - 50,
                          static_cast<double>(random() % 1000) - 50};
        session->handle(event);
      }
    }
    if (i % 100 == 0) session->picture();
  }
  session->picture();
  check(session->keypoints(), "random");
}

TEST(AnnotationView, MapsBackAndForthAtEveryZoom) {
  annotation::View view;
  view.image_px = {1920, 1080};
  view.area = {0, 26, 1280, 634};
  view.fit();
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> x(0, 1279), y(26, 659);
  for (int i = 0; i < 200; ++i) {
    const Eigen::Vector2d at(x(random), y(random));
    const Eigen::Vector2d before = view.to_image(at);
    EXPECT_LT((view.to_canvas(view.to_image(at)) - at).norm(), 1e-9);
    view.zoom(view.scale * 1.2, at);
    EXPECT_LT((view.to_image(at) - before).norm(), 700 / view.scale);
    if (i % 20 == 19) view.fit();
    view.pan({random() % 100 - 50.0, 3});
    for (const Eigen::Vector2d& corner : {Eigen::Vector2d(0, 26), Eigen::Vector2d(1279, 659)})
      if (view.scale > 2) {
        EXPECT_GE(view.to_image(corner).x(), -1);
        EXPECT_LE(view.to_image(corner).x(), 1920);
      }
  }
}

TEST(AnnotationAsking, PhaseFramesAreEquallySpacedFromTheFirstClick) {
  Keypoints k;
  k.frames[4];
  std::vector<int> frames{4};
  for (int i = 0; i < 8; ++i) frames.push_back(annotation::next_phase_frame(k, frames.back(), 2.6));
  EXPECT_EQ(frames, (std::vector<int>{4, 7, 9, 12, 14, 17, 20, 22, 25}));
  EXPECT_EQ(annotation::next_phase_frame(k, 10, 2.6), 12);
  EXPECT_EQ(annotation::next_phase_frame(k, 4, 0.5), 5);
}

TEST(AnnotationChecks, WarnsOfABoneOfAnotherLength) {
  Keypoints k;
  k.width_px = k.height_px = 500;
  for (int i = 0; i < 5; ++i) {
    k.frames[i].time_s = i;
    k.frames[i][BodyPart::knee_r] = Click{{100, 100}, ClickState::seen, ""};
    k.frames[i][BodyPart::ankle_r] = Click{{100, 180.0 + i}, ClickState::seen, ""};
  }
  EXPECT_TRUE(annotation::bone_warnings(k, 3).empty());
  k.frames[3][BodyPart::ankle_r]->p_px.y() = 195;
  const auto warnings = annotation::bone_warnings(k, 3);
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_EQ(warnings[0].from, BodyPart::knee_r);
  EXPECT_NEAR(warnings[0].length_px, 95, 1e-9);
}

TEST(AnnotationChecks, FindsTheFloorUnderTheStandingFeet) {
  Trajectory t;
  t.width_px = 1000;
  for (int f = 0; f < 100; ++f) {
    TrajectoryFrame& frame = t.frames.emplace_back();
    frame.frame = f;
    for (const auto& [part, phase] : {std::pair(BodyPart::toe_r, 0.0), {BodyPart::toe_l, 0.5}}) {
      const double turn = 2 * 3.14159265358979 * (f / 20.0 + phase), x = 9 * f;
      frame[part].p_px = {x, 400 + 0.05 * x - 40 * (1 - std::cos(turn))};
    }
  }
  const auto floor = annotation::floor_from_feet(t, 20);
  ASSERT_TRUE(floor);
  const Eigen::Vector2d along = floor->to_px - floor->from_px;
  EXPECT_NEAR(along.y() / along.x(), 0.05, 0.005);
  t.width_px = 20000;
  EXPECT_FALSE(annotation::floor_from_feet(t, 20));
}

TEST(AnnotationScript, AWholeAnnotationGivesTheGoldenFile) {
  const TemporaryFolder folder;
  const auto file = folder / "human.keypoints.json";
  {
    video::FrameStore frames(kShipped / "human.mp4");
    frames.wait();
    Keypoints fresh;
    fresh.video = "human.mp4";
    fresh.video_sha256 = sha256_of_file(kShipped / "human.mp4");
    fresh.width_px = frames.info().width_px;
    fresh.height_px = frames.info().height_px;
    annotation::AnnotationJournal journal(file, fresh);
    annotation::AnnotationSession session(journal, frames);
    annotation::run_script(session, kAnnotated / "human.jsonl", [] {});
  }
  const Keypoints made = load_keypoints(file);
  const Keypoints golden = load_keypoints(kShipped / "human.keypoints.json");
  EXPECT_EQ(made.video_sha256, golden.video_sha256);
  EXPECT_EQ(made.direction, golden.direction);
  EXPECT_EQ(made.near_leg, golden.near_leg);
  ASSERT_EQ(made.frames.size(), golden.frames.size());
  for (const auto& [number, frame] : golden.frames) {
    ASSERT_TRUE(made.frames.contains(number));
    const ClickedFrame& other = made.frames.at(number);
    EXPECT_NEAR(other.time_s, frame.time_s, 1e-9);
    for (const BodyPart part : kBodyParts) {
      ASSERT_EQ(other[part].has_value(), frame[part].has_value()) << number << name(part);
      if (!frame[part]) continue;
      EXPECT_EQ(other[part]->state, frame[part]->state);
      EXPECT_LT((other[part]->p_px - frame[part]->p_px).norm(), 1e-6) << number << name(part);
    }
  }
}

TEST(AnnotationKeys, TheirPageHasThemAll) {
  const std::string page =
      read_file(std::filesystem::path(STRIDE_SOURCE_DIR) / "extract/annotation/keys.md");
  for (const annotation::KeyHelp& help : annotation::key_help())
    EXPECT_THAT(page, ::testing::HasSubstr(fmt::format("| {} | {} |", help.keys, help.does)));
}

TEST_F(Annotating, AScriptSaysWhereItFails) {
  std::ofstream(folder / "s.jsonl")
      << "{\"key\": \"r\"}\n{\"key\": \"Enter\"}\n{\"key\": \"f12\"}\n";
  EXPECT_ERROR(annotation::run_script(*session, folder / "s.jsonl", [] {}),
               "s.jsonl:3: key 'f12': must be");
  std::ofstream(folder / "s.jsonl") << "\n{\"key\": \"[\"}\n";
  EXPECT_ERROR(annotation::run_script(*session, folder / "s.jsonl", [] {}),
               "s.jsonl:2: no clicked frame before this one");
  std::ofstream(folder / "s.jsonl") << "{\"click\": [300, 400]}\n";  // it would be in the timeline
  EXPECT_ERROR(annotation::run_script(*session, folder / "s.jsonl", [] {}),
               "s.jsonl:1: (300, 400): must be in the piece of the image that is shown");
}

/// A network's points on every frame, one of them of another confidence.
annotation::Prediction seen_by_network(int another_frame, BodyPart another, double confidence) {
  annotation::Prediction prediction;
  for (int i = 0; i < 90; ++i) {
    TrajectoryFrame& frame = prediction.trajectory.frames.emplace_back();
    frame.frame = i;
    for (const BodyPart part : kBodyParts)
      frame[part] = {{100.0 + 20 * index(part), 200}, Source::detected, 0.9};
  }
  prediction.trajectory.frames[static_cast<std::size_t>(another_frame)][another].confidence =
      confidence;
  return prediction;
}

TEST_F(Annotating, CorrectsANetworkWhereThatTeachesMost) {
  answer();
  annotation::AnnotationOptions options;
  options.corrects = true;
  session = std::make_unique<annotation::AnnotationSession>(*journal, frames, options);
  session->set_prediction(seen_by_network(40, BodyPart::ankle_l, 0.95));
  EXPECT_EQ(session->frame(), 40);
  ASSERT_EQ(session->asked(), BodyPart::ankle_l);
  click(300, 220);
  EXPECT_NEAR(clicked(40)[BodyPart::ankle_l]->p_px.x(), 300, 1e-9);
  EXPECT_FALSE(clicked(40)[BodyPart::knee_l]);
  EXPECT_FALSE(session->asked());  // one point was wrong, not the frame
  // A point of the network is dragged to its place.
  const double x = 100 + 20 * index(BodyPart::knee_l);
  mouse(Kind::press, canvas(x, 200));
  mouse(Kind::move, canvas(x + 30, 210));
  mouse(Kind::release, canvas(x + 30, 210));
  ASSERT_TRUE(clicked(40)[BodyPart::knee_l]);
  EXPECT_NEAR(clicked(40)[BodyPart::knee_l]->p_px.x(), x + 30, 1e-9);
  // An empty place is no point.
  click(500, 300);
  EXPECT_TRUE(session->has_problem());
  key('n');
  EXPECT_NE(session->frame(), 40);
  EXPECT_TRUE(session->asked());
}

TEST(WorstPoint, IsFirstWhatTeachesAllFramesAndThenTheLeastCertainOne) {
  const std::vector<BodyPart> parts{BodyPart::knee_r, BodyPart::ankle_r, BodyPart::knee_l,
                                    BodyPart::ankle_l};
  const Trajectory seen = seen_by_network(40, BodyPart::knee_r, 0.1).trajectory;
  Keypoints keypoints;
  // An ankle, whose place on the shank differs most between people and networks.
  const auto first = annotation::worst_point(seen, keypoints, parts, {});
  ASSERT_TRUE(first);
  EXPECT_TRUE(first->part == BodyPart::ankle_r || first->part == BodyPart::ankle_l);
  // Once they are known, the point that the network is unsure of.
  std::vector<annotation::WorstPoint> asked{*first};
  while (asked.back().part != BodyPart::knee_r || asked.back().frame != 40) {
    ASSERT_LT(asked.size(), 20);
    keypoints.frames[asked.back().frame][asked.back().part] = Click{{1, 2}, ClickState::seen, ""};
    const auto next = annotation::worst_point(seen, keypoints, parts, {});
    ASSERT_TRUE(next);
    asked.push_back(*next);
  }
  EXPECT_FALSE(annotation::worst_point(seen, keypoints, {}, {}));
}

}  // namespace
}  // namespace stride
