#include "extract/io/data_file.h"

#include <dlfcn.h>

#include <cstdlib>
#include <vector>

#include <stride_version.h>
#include "extract/io/error.h"

namespace stride {
namespace fs = std::filesystem;
namespace {

/// The folder of the program, or of the shared library that this function is linked into.
fs::path binary_folder() {
  Dl_info info{};
  std::error_code none;
  // Of a program, dladdr() knows the name by which it was called, which may be without its folder.
  const fs::path program = fs::read_symlink("/proc/self/exe", none);
  if (dladdr(reinterpret_cast<const void*>(&binary_folder), &info) == 0 ||
      info.dli_fname == nullptr)
    return program.parent_path();
  const fs::path library = fs::weakly_canonical(info.dli_fname, none);
  return library.extension() == ".so" ? library.parent_path() : program.parent_path();
}

}  // namespace

std::vector<fs::path> data_folders() {
  if (const char* folder = std::getenv("STRIDE_DATA"); folder != nullptr && *folder != '\0')
    return {folder};
  const fs::path binary = binary_folder();
  return {(binary / "../share/stride").lexically_normal(),
          (binary / "../../../../share/stride").lexically_normal(), STRIDE_SOURCE_TREE};
}

fs::path data_file(const fs::path& path) {
  const std::vector<fs::path> folders = data_folders();
  for (const fs::path& folder : folders)
    if (std::error_code none; fs::exists(folder / path, none)) return folder / path;
  std::string looked;
  for (const fs::path& folder : folders) looked += (looked.empty() ? "" : ", ") + folder.string();
  throw Error(
      fmt::format("{}: is not in {}; set STRIDE_DATA to the folder share/stride of the "
                  "installation, or to the source tree",
                  path.string(), looked));
}

std::string version() { return STRIDE_VERSION; }

}  // namespace stride
