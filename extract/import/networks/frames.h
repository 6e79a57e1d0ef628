#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "extract/import/parsing/detections.h"
#include "extract/import/parsing/format.h"
#include "extract/io/json/json_file.h"

/// What the readers of pose networks' results share. None of these libraries has a file format of
/// its own, so the readers go by names and shapes. A network is never as sure as a person: its
/// confidence counts 0.95 times.
namespace stride::imports {

inline constexpr double kSurestNetwork = 0.95;  // confidence: a person's click has 1

/// Whether it may be JSON of a network: everything but OpenPose's, which has a format.
bool is_of_a_network(const FileText& text);

/// What a JSON file holds of one frame.
struct FrameValue {
  int frame = 0;
  JsonValue value;
};

/// The frames of a file: a list, or a list under one of the usual names, or an object whose names
/// are numbers. A frame's number is what it says of itself, else its place in the list.
std::vector<FrameValue> frames_of(const JsonValue& root, int deepest = 3);

/// The value under the first of some names that it has; nothing if it has none, or null there.
std::optional<JsonValue> first_of(const JsonValue& value,
                                  std::initializer_list<std::string_view> names);

/// A number or a text as the name of a person; empty for anything else.
std::string name_of(const std::optional<JsonValue>& value);

/// Coordinates that all lie below 2 are shares of the picture: says so of every person.
void tell_normalised(ImportedFile& content);

}  // namespace stride::imports
