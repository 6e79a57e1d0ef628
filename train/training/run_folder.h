#pragma once

#include <filesystem>

namespace stride::training {

/// Keeps a second program from training in the same folder. Throws Error if one is.
class FolderLock {
 public:
  explicit FolderLock(const std::filesystem::path& run);
  ~FolderLock();
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;

 private:
  int descriptor_;
};

/// Removes files that a kill left half written (write_file_atomically()).
void remove_unfinished_files(const std::filesystem::path& folder);

}  // namespace stride::training
