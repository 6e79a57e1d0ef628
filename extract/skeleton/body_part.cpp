#include "extract/skeleton/body_part.h"

#include <fmt/ranges.h>

#include <algorithm>
#include <ranges>

#include "extract/io/error.h"

namespace stride {

BodyPart body_part(std::string_view name) {
  const auto found = std::ranges::find(kBodyPartRows, name, &BodyPartRow::name);
  require(found != kBodyPartRows.end(), "body part '{}': not known; use one of {}", name,
          fmt::join(kBodyPartRows | std::views::transform(&BodyPartRow::name), ", "));
  return found->part;
}

}  // namespace stride
