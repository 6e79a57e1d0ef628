#pragma once

#include <string>
#include <vector>

namespace stride::osim {

/// OpenSim's storage, .mot and .sto: a head, then tab-separated rows, the first of whose columns is
/// time in s.
struct Storage {
  std::string name;
  bool in_degrees = false;           // the angles
  std::vector<std::string> columns;  // without time
  struct Row {
    double time_s = 0;
    std::vector<double> values;
  };
  std::vector<Row> rows;
};

/// The file's text; numbers in the shortest form that reads back as the same, time rounded to 0.1
/// ms.
std::string to_text(const Storage& storage);

}  // namespace stride::osim
