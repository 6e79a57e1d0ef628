#include "calibrate/osim/storage.h"

#include <fmt/format.h>

namespace stride::osim {

std::string to_text(const Storage& storage) {
  std::string text = fmt::format(
      "{}\nversion=1\nnRows={}\nnColumns={}\ninDegrees={}\nWritten by stride. SI units, {}.\n"
      "endheader\ntime",
      storage.name, storage.rows.size(), 1 + storage.columns.size(),
      storage.in_degrees ? "yes" : "no", storage.in_degrees ? "degrees" : "rad");
  for (const std::string& column : storage.columns) text += '\t' + column;
  for (const Storage::Row& row : storage.rows) {
    text += fmt::format("\n{:.4f}", row.time_s);
    for (const double value : row.values) text += fmt::format("\t{}", value);
  }
  return text + '\n';
}

}  // namespace stride::osim
