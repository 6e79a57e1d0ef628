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

/// The text and the tree of an OpenSim document; both outlive the elements that point into them.
struct OsimDocument {
  explicit OsimDocument(const std::filesystem::path& file);

  std::string file, text;
  pugi::xml_document tree;
};

/// An element of an OpenSim document that knows where it stands, so that every complaint names file
/// and line.
class OsimElement {
 public:
  OsimElement(const OsimDocument& document, pugi::xml_node node)
      : document_(&document), node_(node) {}

  explicit operator bool() const { return static_cast<bool>(node_); }
  std::string tag() const { return node_.name(); }
  std::string name() const { return node_.attribute("name").value(); }

  /// Throws Error "FILE:LINE: <tag name="...">: what".
  [[noreturn]] void fail(std::string_view what) const;

  /// The child of that tag; false if there is none.
  OsimElement child(const char* tag) const { return {*document_, node_.child(tag)}; }
  OsimElement need(const char* tag) const;
  std::vector<OsimElement> children() const;
  /// The elements of a set: <tag><objects>…</objects></tag>, or <tag>…</tag>; none if it is absent.
  std::vector<OsimElement> objects(const char* tag) const;
  /// A property that is an object: <tag><Type/></tag>, or <Type name="tag"/>, as version 4 writes
  /// it.
  OsimElement object(const char* tag) const;

  /// Fails at the first child that is neither among `read` nor known to leave the motion alone
  /// (appearance, notes, bookkeeping of the OpenSim application).
  void only(const std::vector<std::string_view>& read) const;
  /// Fails unless the sets are empty or absent: things that change the motion and are not
  /// understood.
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
