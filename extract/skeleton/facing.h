#pragma once

#include <optional>
#include <string_view>

#include "extract/io/names.h"

namespace stride {

/// The way a runner faces in the image.
enum class Facing { right, left };
inline constexpr Names<Facing> kFacings({{Facing::right, "right"}, {Facing::left, "left"}});

/// As files say it: nothing where it is not known.
template <typename Enum>
constexpr std::string_view name_or_empty(const Names<Enum>& names, std::optional<Enum> value) {
  return value ? names[*value] : std::string_view();
}

}  // namespace stride
