#pragma once

#include <opencv2/core/mat.hpp>
#include <optional>
#include <string>
#include <vector>

#include "extract/annotation/checks.h"
#include "extract/annotation/journal.h"
#include "extract/annotation/session/keys.h"
#include "extract/annotation/session/view.h"
#include "extract/skeleton/trajectory.h"
#include "extract/video/frame_store.h"

namespace stride::annotation {

/// An event of a window: mouse positions in pixels of the canvas, keys as from cv::waitKeyEx.
struct AnnotationEvent {
  enum class Kind { press, release, move, wheel, key };
  enum class Button { left, right, middle };

  Kind kind = Kind::move;
  Eigen::Vector2d p_canvas = Eigen::Vector2d::Zero();
  Button button = Button::left;
  int wheel = 0;  // > 0: zoom in
  int key = 0;
};

/// The result of tracking the clicks.
struct Prediction {
  Trajectory trajectory;
  double stride_frames = 0;   // 0: unknown
  std::vector<int> suspects;  // frames where left and right seem to be swapped
  int revision = -1;          // AnnotationDocument::revision() of the clicks it was made from
  std::string problem;        // why there is none, for the user
  std::string doubt;          // of the clip's time, with the cure
};

struct AnnotationOptions {
  cv::Size canvas_px{1280, 860};
  bool hips = false, head = false;  // also ask for them
  bool corrects = false;            // clicks correct a network's points, the worst first
};

/// `stride annotate` without a window: events in, a picture and keypoints out. It asks for one part
/// after the other, moves on to the next phase frame when a frame is complete, and has every edit
/// on disk when handle() returns. Problems appear on the canvas; handle() throws nothing that a
/// user can cause.
class AnnotationSession {
 public:
  /// What a click does.
  enum class Mode {
    ask_direction,
    ask_near_leg,
    click,
    floor_from,
    floor_to,
    length_from,
    length_to,
    type
  };

  AnnotationSession(AnnotationJournal& journal, video::FrameStore& frames,
                    const AnnotationOptions& options = {});

  void handle(const AnnotationEvent& event);
  void set_prediction(Prediction prediction);
  /// Call when there are no events: folds the journal. Returns whether anything changed.
  bool rest();

  cv::Mat picture();

  /// Another size of the window, at least 800 x 500.
  void resize(cv::Size canvas_px);

  bool playing() const { return playing_; }
  /// While it plays: the next frame; after the last one the first.
  void show_next();
  double frame_s() const;  // of the video, how long one is shown

  bool done() const { return done_; }
  int frame() const { return frame_; }
  int frame_count() const;  // known so far
  Mode mode() const { return mode_; }
  std::optional<BodyPart> asked() const { return asked_; }
  const Keypoints& keypoints() const { return journal_.document().keypoints(); }
  int revision() const { return journal_.document().revision(); }
  const View& view() const { return view_; }
  const std::string& message() const { return message_; }  // result or problem of the last event
  bool has_problem() const { return wrong_; }
  double stride_frames() const;
  void go_to(int frame);

 private:
  friend class AnnotationCanvas;
  struct Typing {
    Command what = Command::none;
    std::string text;
  };
  struct Grip {
    enum class What { nothing, point, timeline, pan } what = What::nothing;
    BodyPart part = BodyPart::pelvis;
    Eigen::Vector2d from_canvas = Eigen::Vector2d::Zero();
    bool moved = false;
    ClickState state = ClickState::seen;  // of a click here
  };

  void press(const AnnotationEvent& event);
  void move(const AnnotationEvent& event);
  void release(const AnnotationEvent& event);
  void press_key(int key);
  void answer(int key);
  void type(int key);
  void finish_typing();
  void command(Command command, int key);
  void step(Command command);
  void go_to_worst();
  void choose_part(int digit);
  void mark_absent();
  void accept_ghost();
  void take_back(bool again);
  void close_up();
  void zoom_to_runner();
  void mark_floor_from_feet();

  void place(BodyPart part, const Eigen::Vector2d& p_px, ClickState state);
  void place_asked(const Eigen::Vector2d& canvas, ClickState state);
  /// A click on the part that was placed just before, for the first time.
  bool is_double_click(const Grip& grip);
  void advance(BodyPart after);
  void ask_first_missing();
  void nudge(const Eigen::Vector2d& move_px);
  void swap_legs();
  void copy_from_neighbour();
  void erase();
  void set_trim();
  void mark_floor(const Eigen::Vector2d& p_px);
  void mark_length(const Eigen::Vector2d& p_px);
  void take_length(std::string text);
  void take_line_away();
  void edit(Change change);
  void edit_settings(const std::string& what, const ClipSettings& settings);
  void tell(std::string message, bool wrong = false);

  const cv::Mat& shown_image();  // of the frame; empty while it is still being decoded
  const cv::Mat& shown_area();   // the part that the view shows, without drawings
  const ClickedFrame* clicked(int frame) const;
  const TrajectoryFrame* predicted(int frame) const;
  std::optional<BodyPart> predicted_at(const Eigen::Vector2d& canvas) const;
  std::optional<BodyPart> click_at(const Eigen::Vector2d& canvas) const;
  std::vector<BodyPart> order() const;
  double phase_step() const;
  std::optional<Eigen::Vector2d> pelvis_px(int frame) const;  // clicked or predicted
  Side near_leg() const;

  AnnotationJournal& journal_;
  video::FrameStore& frames_;
  AnnotationOptions options_;
  View view_;
  Prediction prediction_;
  Mode mode_ = Mode::click;
  Typing typing_;
  Grip grip_;
  int frame_ = 0;
  std::optional<BodyPart> asked_, last_;  // asked for now; placed or chosen last
  std::optional<BodyPart> doubled_;       // asked for when a double click was caught
  std::optional<int> range_from_;
  Eigen::Vector2d mouse_ = Eigen::Vector2d::Constant(-1);  // on the canvas
  Eigen::Vector2d floor_from_ = Eigen::Vector2d::Zero();
  CalibrationLine measured_;               // while it is being drawn
  double step_factor_ = 1;                 // the user's factor for the spacing of phase frames
  std::vector<int> passed_by_;             // worst frames seen since the last prediction
  std::vector<WorstPoint> passed_points_;  // of a network: worst points that were left as they are
  int shown_ = -1;                         // the frame of shown_image_
  cv::Mat shown_image_, shown_area_;
  View area_view_;  // of shown_area_
  int area_frame_ = -1;
  std::string message_;
  bool wrong_ = false, help_ = false, playing_ = false, done_ = false;
};

}  // namespace stride::annotation
