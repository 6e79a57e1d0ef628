#pragma once

#include <cstdlib>
#include <filesystem>
#include <string>

#include "extract/io/error.h"

namespace stride::page {

/// A folder for what is made on the way to a page; it goes with its owner.
struct Scratch {
  Scratch() {
    std::string name = (std::filesystem::temp_directory_path() / "stride-page-XXXXXX").string();
    require(::mkdtemp(name.data()) != nullptr, "{}: cannot be made; set TMPDIR", name);
    folder = name;
  }
  ~Scratch() {
    std::error_code ignored;
    std::filesystem::remove_all(folder, ignored);
  }
  Scratch(const Scratch&) = delete;
  Scratch& operator=(const Scratch&) = delete;

  std::filesystem::path folder;
};

}  // namespace stride::page
