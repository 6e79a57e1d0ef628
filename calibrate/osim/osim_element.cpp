#include "calibrate/osim/osim_element.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "extract/io/error.h"
#include "extract/io/file.h"
#include "extract/io/outputs.h"

namespace stride::osim {
namespace {

std::ptrdiff_t line_at(const std::string& text, std::ptrdiff_t offset) {
  const auto end = text.begin() + std::clamp<std::ptrdiff_t>(offset, 0, std::ssize(text));
  return 1 + std::count(text.begin(), end, '\n');
}

/// Elements that say how a model looks, where it comes from, or how other programs use it.
constexpr std::string_view kWithoutEffect[] = {"Appearance",
                                               "FrameGeometry",
                                               "MarkerSet",
                                               "ModelVisualPreferences",
                                               "ProbeSet",
                                               "VisibleObject",
                                               "WrapObjectSet",
                                               "appearance",
                                               "assembly_accuracy",
                                               "attached_geometry",
                                               "compute_dissipation_energy",
                                               "credits",
                                               "display",
                                               "display_preference",
                                               "groups",
                                               "is_free_to_satisfy_constraints",
                                               "max_control",
                                               "min_control",
                                               "optimal_force",
                                               "prescribed_function",
                                               "publications"};

}  // namespace

OsimDocument::OsimDocument(const std::filesystem::path& path)
    : file(path.string()), text(read_file(path)) {
  const FileKind kind = kind_of(path);
  require(!is_binary(kind) && !is_json(kind), "{}: is {}, an OpenSim model (.osim) is needed", file,
          name(kind));
  const pugi::xml_parse_result result = tree.load_buffer(text.data(), text.size());
  require(static_cast<bool>(result), "{}:{}: not XML: {}", file, line_at(text, result.offset),
          result.description());
}

void OsimElement::fail(std::string_view what) const {
  const std::string label =
      name().empty() ? fmt::format("<{}>", tag()) : fmt::format("<{} name=\"{}\">", tag(), name());
  throw Error(fmt::format("{}:{}: {}: {}", document_->file,
                          line_at(document_->text, node_.offset_debug()), label, what));
}

OsimElement OsimElement::need(const char* tag) const {
  const OsimElement found = child(tag);
  if (!found) fail(fmt::format("has no <{}>, which is needed", tag));
  return found;
}

std::vector<OsimElement> OsimElement::children() const {
  std::vector<OsimElement> all;
  for (pugi::xml_node each : node_.children())
    if (each.type() == pugi::node_element) all.emplace_back(*document_, each);
  return all;
}

std::vector<OsimElement> OsimElement::objects(const char* tag) const {
  const OsimElement set = child(tag);
  if (!set) return {};
  const OsimElement inner = set.child("objects");
  std::vector<OsimElement> all = (inner ? inner : set).children();
  std::erase_if(all, [](const OsimElement& each) { return each.tag() == "groups"; });
  return all;
}

OsimElement OsimElement::object(const char* tag) const {
  if (const OsimElement wrapped = child(tag)) {
    const std::vector<OsimElement> inside = wrapped.children();
    if (inside.size() != 1) wrapped.fail("must hold exactly one function");
    return inside.front();
  }
  const OsimElement named{*document_, node_.find_child_by_attribute("name", tag)};
  if (!named) fail(fmt::format("has no <{}>, which is needed", tag));
  return named;
}

void OsimElement::only(const std::vector<std::string_view>& read) const {
  for (const OsimElement& each : children()) {
    const std::string tag = each.tag();
    const bool says_nothing = each.children().empty() && each.text().empty();
    if (says_nothing) continue;
    if (std::find(read.begin(), read.end(), tag) != read.end()) continue;
    if (std::find(read.begin(), read.end(), each.name()) != read.end()) continue;
    if (std::find(std::begin(kWithoutEffect), std::end(kWithoutEffect), tag) !=
        std::end(kWithoutEffect))
      continue;
    each.fail(fmt::format(
        "not understood inside <{}>, and it might change the motion; take it out of the model",
        this->tag()));
  }
}

void OsimElement::none_of(std::initializer_list<const char*> sets) const {
  for (const char* set : sets)
    for (const OsimElement& each : objects(set))
      each.fail(fmt::format(
          "<{}> is not understood, and it might change the motion; take it out of the model", set));
}

std::string OsimElement::text() const {
  const std::string all = node_.text().get();
  const auto first = all.find_first_not_of(" \t\r\n");
  if (first == std::string::npos) return "";
  return all.substr(first, all.find_last_not_of(" \t\r\n") - first + 1);
}

std::vector<double> OsimElement::numbers() const {
  std::vector<double> all;
  const std::string content = text();
  const char *at = content.data(), *end = at + content.size();
  while (at != end) {
    double value = 0;
    const auto [next, error] = std::from_chars(at, end, value);
    if (error != std::errc{} || !std::isfinite(value))
      fail(fmt::format("\"{}\": must be finite numbers", content));
    all.push_back(value);
    at = std::find_if(next, end,
                      [](char c) { return !std::isspace(static_cast<unsigned char>(c)); });
  }
  return all;
}

double OsimElement::number() const {
  const std::vector<double> all = numbers();
  if (all.size() != 1) fail(fmt::format("\"{}\": must be one number", text()));
  return all.front();
}

double OsimElement::number(const char* tag, double otherwise) const {
  const OsimElement found = child(tag);
  return found ? found.number() : otherwise;
}

Vec3 OsimElement::vec3(const char* tag, const Vec3& otherwise) const {
  const OsimElement found = child(tag);
  if (!found) return otherwise;
  const std::vector<double> all = found.numbers();
  if (all.size() != 3) found.fail(fmt::format("\"{}\": must be three numbers", found.text()));
  return {all[0], all[1], all[2]};
}

bool OsimElement::flag(const char* tag, bool otherwise) const {
  const OsimElement found = child(tag);
  if (!found) return otherwise;
  const std::string value = found.text();
  if (value != "true" && value != "false")
    found.fail(fmt::format("\"{}\": must be true or false", value));
  return value == "true";
}

}  // namespace stride::osim
