#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>
#include <string>
#include <vector>

namespace stride {

/// A table recorded from OpenSim (tests/train/data/opensim): cells as text, columns by name.
struct Reference {
  explicit Reference(const std::string& name) {
    const std::filesystem::path file = std::filesystem::path(STRIDE_TEST_DATA) / "opensim" / name;
    std::ifstream in(file);
    EXPECT_TRUE(in) << file;
    std::string line;
    std::getline(in, line);
    for (const std::string& column : cells(line)) {
      const int index = static_cast<int>(columns.size());
      columns[column] = index;
    }
    while (std::getline(in, line)) rows.push_back(cells(line));
    EXPECT_FALSE(rows.empty()) << file;
  }

  const std::string& text(std::size_t row, const std::string& column) const {
    return rows[row][columns.at(column)];
  }
  double number(std::size_t row, const std::string& column) const {
    return std::strtod(text(row, column).c_str(), nullptr);
  }

  std::map<std::string, int> columns;
  std::vector<std::vector<std::string>> rows;

 private:
  static std::vector<std::string> cells(const std::string& line) {
    std::vector<std::string> out;
    std::istringstream in(line);
    for (std::string cell; std::getline(in, cell, ',');) out.push_back(cell);
    return out;
  }
};

/// |actual - expected| ≤ relative · |expected| + absolute. The files have twelve digits.
inline ::testing::AssertionResult close(double actual, double expected, double relative,
                                        double absolute = 0) {
  const double error = std::abs(actual - expected);
  if (error <= relative * std::abs(expected) + absolute) return ::testing::AssertionSuccess();
  return ::testing::AssertionFailure() << actual << " is not " << expected << " (off by " << error
                                       << ", relative " << error / std::abs(expected) << ")";
}

}  // namespace stride
