#include "train/training/run_folder.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <vector>

#include "extract/io/error.h"

namespace stride::training {
namespace fs = std::filesystem;

FolderLock::FolderLock(const fs::path& run)
    : descriptor_(::open((run / "config.toml").c_str(), O_RDONLY | O_CLOEXEC)) {
  require(descriptor_ >= 0 && ::flock(descriptor_, LOCK_EX | LOCK_NB) == 0,
          "{}: another stride is training in this folder", run.string());
}

FolderLock::~FolderLock() { ::close(descriptor_); }

void remove_unfinished_files(const fs::path& folder) {
  if (!fs::exists(folder)) return;
  std::vector<fs::path> unfinished;
  for (const auto& entry : fs::directory_iterator(folder))
    if (entry.path().extension().string().starts_with(".tmp")) unfinished.push_back(entry.path());
  for (const fs::path& file : unfinished) fs::remove(file);
}

}  // namespace stride::training
