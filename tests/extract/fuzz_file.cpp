// A libFuzzer target for each of our formats that people edit or programs leave half written: a
// file loads or is refused by Error, and what loads can be saved. See fuzz_import.cpp for how to
// build and run.
#include <cstdlib>
#include <fstream>
#include <string_view>

#include "extract/annotation/journal.h"
#include "extract/io/file.h"
#include "extract/skeleton/trajectory.h"
#include "extract/video/edit_list.h"
#include "tests/support/fuzz.h"

namespace stride {
namespace fs = std::filesystem;

/// A folder in memory: every input becomes a file.
const fs::path& folder() {
  static const fs::path made = [] {
    std::string name = "/dev/shm/fuzz.XXXXXX";
    if (!::mkdtemp(name.data())) std::abort();
    return fs::path(name);
  }();
  return made;
}

fs::path file_of(std::string_view content, const char* name) {
  const fs::path file = folder() / name;
  std::ofstream(file, std::ios::binary) << content;
  return file;
}

void check(bool holds) {
  if (!holds) std::abort();
}

void keypoints(std::string_view content) {
  const Keypoints loaded = load_keypoints(file_of(content, "a.keypoints.json"));
  const fs::path again = folder() / "b.keypoints.json";
  save(loaded, again);
  check(text_of(load_keypoints(again)) == text_of(loaded));
}

void trajectory(std::string_view content) {
  const Trajectory loaded = load_trajectory(file_of(content, "a.trajectory.csv"));
  const fs::path first = folder() / "b.trajectory.csv", second = folder() / "c.trajectory.csv";
  save(loaded, first);
  save(load_trajectory(first), second);
  check(read_file(first) == read_file(second));
}

void edit_list(std::string_view content) { video::text_of(video::edits_in(content)); }

void journal(std::string_view content) {
  const fs::path file = folder() / "a.keypoints.json";
  fs::remove(file);
  file_of(content, "a.keypoints.journal");
  Keypoints fresh;
  fresh.video = "a.mp4";
  fresh.video_sha256 = std::string(64, 'a');
  fresh.width_px = 640;
  fresh.height_px = 360;
  std::string recovered;
  {
    const annotation::AnnotationJournal opened(file, fresh);
    if (opened.recovered() > 0) recovered = text_of(opened.document().keypoints());
  }
  if (!recovered.empty()) check(text_of(load_keypoints(file)) == recovered);
}

}  // namespace stride

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return stride::read_or_refuse(data, size, stride::STRIDE_FUZZED_READER);
}
