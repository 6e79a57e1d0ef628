#include "extract/annotation/session/script.h"

#include <map>
#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>
#include <sstream>

#include "extract/io/error.h"
#include "extract/io/file.h"

namespace stride::annotation {
namespace {

using ScriptJson = nlohmann::json;
using Kind = AnnotationEvent::Kind;
using Button = AnnotationEvent::Button;

int key_of(const std::string& name) {
  static const std::map<std::string, int> names{
      {"Enter", key::kEnter}, {"Escape", key::kEscape}, {"Backspace", key::kBackspace},
      {"Space", key::kSpace}, {"Tab", key::kTab},       {"Home", key::kHome},
      {"End", key::kEnd},     {"Left", key::kLeft},     {"Right", key::kRight}};
  if (name.size() == 1) return static_cast<unsigned char>(name[0]);
  const auto found = names.find(name);
  require(found != names.end(), "key '{}': must be one letter, or Enter, Escape, …", name);
  return found->second;
}

Button button_of(const ScriptJson& event) {
  const std::string name = event.value("button", "left");
  if (name == "left") return Button::left;
  if (name == "right") return Button::right;
  require(name == "middle", "button '{}': must be left, right or middle", name);
  return Button::middle;
}

class Player {
 public:
  Player(AnnotationSession& session, const std::filesystem::path& folder,
         const std::function<void()>& wait_for_tracking)
      : session_(session), folder_(folder), wait_for_tracking_(wait_for_tracking) {}

  void play(const ScriptJson& event) {
    if (event.contains("key")) {
      send_key(key_of(event.at("key")));
    } else if (event.contains("type")) {
      for (const unsigned char c : event.at("type").get<std::string>()) send_key(c);
    } else if (event.contains("click")) {
      press_and_release(event.at("click"), event.at("click"), button_of(event));
    } else if (event.contains("drag")) {
      press_and_release(event.at("drag").at(0), event.at("drag").at(1), button_of(event));
    } else if (event.contains("move")) {
      send_mouse(Kind::move, event.at("move"), Button::left);
    } else if (event.contains("wheel")) {
      AnnotationEvent wheel;
      wheel.kind = Kind::wheel;
      wheel.p_canvas = canvas(event.at("at"));
      wheel.wheel = event.at("wheel").get<int>() > 0 ? 1 : -1;
      for (int i = std::abs(event.at("wheel").get<int>()); i > 0; --i) session_.handle(wheel);
    } else if (event.contains("frame")) {
      session_.go_to(event.at("frame"));
    } else if (event.contains("wait")) {
      wait_for_tracking_();
    } else if (event.contains("picture")) {
      const std::string file = folder_ / event.at("picture").get<std::string>();
      require(cv::imwrite(file, session_.picture()), "{}: cannot be written", file);
    } else {
      throw Error(fmt::format("no event that is known: {}", event.dump()));
    }
  }

 private:
  Eigen::Vector2d canvas(const ScriptJson& image) const {
    const Eigen::Vector2d p_px(image.at(0).get<double>(), image.at(1).get<double>());
    Eigen::Vector2d p = session_.view().to_canvas(p_px);
    require(session_.view().contains(p),
            "({}, {}): must be in the piece of the image that is shown", p_px.x(), p_px.y());
    return p;
  }

  void send_key(int code) {
    AnnotationEvent event;
    event.kind = Kind::key;
    event.key = code;
    session_.handle(event);
  }

  void send_mouse(Kind kind, const ScriptJson& image, Button button) {
    AnnotationEvent event;
    event.kind = kind;
    event.p_canvas = canvas(image);
    event.button = button;
    session_.handle(event);
  }

  void press_and_release(const ScriptJson& from, const ScriptJson& to, Button button) {
    // The view may change at the press (a click can lead to another frame); the mouse stays.
    const Eigen::Vector2d end = canvas(to);
    send_mouse(Kind::press, from, button);
    AnnotationEvent event;
    event.p_canvas = end;
    event.button = button;
    for (const Kind kind : {Kind::move, Kind::release}) {
      event.kind = kind;
      session_.handle(event);
    }
  }

  AnnotationSession& session_;
  std::filesystem::path folder_;
  const std::function<void()>& wait_for_tracking_;
};

}  // namespace

void run_script(AnnotationSession& session, const std::filesystem::path& script,
                const std::function<void()>& wait_for_tracking) {
  std::istringstream lines(read_file(script));
  Player player(session, script.parent_path(), wait_for_tracking);
  std::string line;
  for (int number = 1; std::getline(lines, line) && !session.done(); ++number) {
    if (line.find_first_not_of(" \t\r") == std::string::npos || line.starts_with("#")) continue;
    try {
      player.play(ScriptJson::parse(line));
    } catch (const ScriptJson::exception&) {
      throw Error(fmt::format("{}:{}: expected an event as one JSON object, as {{\"key\": \"r\"}}",
                              script.string(), number));
    } catch (const std::exception& error) {
      throw Error(fmt::format("{}:{}: {}", script.string(), number, error.what()));
    }
    require(!session.has_problem(), "{}:{}: {}", script.string(), number, session.message());
  }
}

}  // namespace stride::annotation
