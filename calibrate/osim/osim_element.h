#pragma once

#include <array>
#include <cstddef>
#include <filesystem>
#include <initializer_list>
#include <memory>
#include <pugixml.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "calibrate/osim/model.h"

namespace stride::osim {

/// Text and tree of an OpenSim document. It must outlive the elements that refer to it.
struct OsimDocument {
  explicit OsimDocument(const std::filesystem::path& file);

  std::string file, text;
  pugi::xml_document tree;
};

/// An element of an OpenSim document. Its errors name file and line.
class OsimElement {
 public:
  OsimElement(const OsimDocument& document, pugi::xml_node node)
      : document_(&document), node_(node) {}

  explicit operator bool() const { return static_cast<bool>(node_); }
  std::string tag() const { return node_.name(); }
  std::string name() const { return node_.attribute("name").value(); }

  /// Throws Error "FILE:LINE: <tag name="...">: what".
  [[noreturn]] void fail(std::string_view what) const;

  /// The child with that tag, or an element that converts to false.
  OsimElement child(const char* tag) const { return {*document_, node_.child(tag)}; }
  OsimElement need(const char* tag) const;
  std::vector<OsimElement> children() const;
  /// The elements of a set, <tag><objects>…</objects></tag> or <tag>…</tag>; none if it is absent.
  std::vector<OsimElement> objects(const char* tag) const;
  /// A property that is an object: <tag><Type/></tag>, or <Type name="tag"/> (version 4).
  OsimElement object(const char* tag) const;

  /// Fails at the first child that is neither in `read` nor known to have no effect on the motion
  /// (appearance, notes, data of the OpenSim application).
  void only(const std::vector<std::string_view>& read) const;
  /// Fails unless the sets are empty or absent; they would change the motion and are not supported.
  void none_of(std::initializer_list<const char*> sets) const;

  std::string text() const;
  std::vector<double> numbers() const;
  double number() const;

  std::string text(const char* tag) const { return need(tag).text(); }
  double number(const char* tag, double otherwise) const;
  Vec3 vec3(const char* tag, const Vec3& otherwise = {}) const;
  bool flag(const char* tag, bool otherwise) const;

 private:
  const OsimDocument* document_;
  pugi::xml_node node_;
};

}  // namespace stride::osim
