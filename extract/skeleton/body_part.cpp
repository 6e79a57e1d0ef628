#include "extract/skeleton/body_part.h"

#include <fmt/ranges.h>

#include <algorithm>
#include <vector>

#include "extract/io/error.h"

namespace stride {

BodyPart body_part(std::string_view name) {
  const auto found = std::ranges::find(kBodyPartRows, name, &BodyPartRow::name);
  if (found != kBodyPartRows.end()) return found->part;
  std::vector<std::string_view> names;
  for (const BodyPartRow& row : kBodyPartRows) names.push_back(row.name);
  throw Error(
      fmt::format("body part '{}': not known; use one of {}", name, fmt::join(names, ", ")));
}

}  // namespace stride
