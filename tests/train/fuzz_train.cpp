// A libFuzzer target for each file that training reads: any bytes are read or Error is thrown.
//     cmake -B build/fuzz -G Ninja -DCMAKE_CXX_COMPILER=clang++ -DSTRIDE_FUZZ=ON
//     cmake --build build/fuzz --target fuzz_train_potential
//     build/fuzz/tests/train/fuzz_train_potential -max_total_time=600 CORPUS_FOLDER
// Corpus: a file of the kind; `fuzz_train_checkpoint` begins with one of its own in any case.
#include <stdlib.h>
#include <sys/mman.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string_view>

#include "extract/io/file.h"
#include "extract/io/table.h"
#include "shaping/potential.h"
#include "tests/support/fuzz.h"
#include "tests/train/support/point_mass.h"
#include "train/network/policy.h"
#include "train/network/safetensors.h"
#include "train/training/checkpoint.h"
#include "train/training/options.h"

namespace stride {
using namespace network;
using namespace training;
namespace {

namespace fs = std::filesystem;

/// The bytes as a file that is in memory only.
class MemoryFile {
 public:
  explicit MemoryFile(std::string_view content) : descriptor_(::memfd_create("fuzz", 0)) {
    if (::write(descriptor_, content.data(), content.size()) !=
        static_cast<ssize_t>(content.size()))
      ::abort();
  }
  ~MemoryFile() { ::close(descriptor_); }
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;
  fs::path path() const { return "/proc/self/fd/" + std::to_string(descriptor_); }

 private:
  int descriptor_;
};

}  // namespace

void potential(std::string_view content) { load_potential(MemoryFile(content).path()); }
void curve(std::string_view content) { load_table(MemoryFile(content).path(), "curve", 1); }
void safetensors(std::string_view content) { load_tensors(MemoryFile(content).path()); }

void config(std::string_view content) {
  TrainOptions options;
  read_toml(MemoryFile(content).path(), options);
  options.check();
}

void agent(std::string_view content) {
  const MemoryFile file(content);
  const PolicyNames names = load_policy_names(file.path());
  load_policy<float>(file.path(), names.features, names.actions);
}

/// A run of a point mass with a checkpoint and its replay segment. One of the two files is replaced
/// by the bytes: the first of them, if it is even, the checkpoint.
class SmallRun {
 public:
  SmallRun() {
    std::string name = (fs::temp_directory_path() / "stride_fuzz_XXXXXX").string();
    run_ = ::mkdtemp(name.data());
    options_.run.environments = 2;
    options_.run.round = 2;
    options_.observation = {.centre = false, .derived = false, .activations = false};
    options_.agent.actor_hidden = options_.agent.critic_hidden = {3};
    options_.replay.capacity = 40;
    Training<float> training = start();
    const Policy<float> policy = policy_of(training, options_);
    for (int round = 0; round < 5; ++round) {
      for (int slot = 0; slot < 2; ++slot)
        for (int i = 0; i < 2; ++i) {
          const std::int64_t at = training.buffer.rounds() + i;
          training.explorers[static_cast<std::size_t>(slot)].decide(
              policy, training.buffer, training.buffer.record(at, slot),
              training.buffer.features(at, slot), training.buffer.action(at, slot));
        }
      training.buffer.publish(2);
    }
    save_checkpoint(training, run_);
    segment_ = fs::directory_iterator(run_ / "replay")->path();
    checkpoint_bytes_ = read_file(checkpoint_file(run_));
    segment_bytes_ = read_file(segment_);
  }
  ~SmallRun() { fs::remove_all(run_); }
  SmallRun(const SmallRun&) = delete;
  SmallRun& operator=(const SmallRun&) = delete;

  void load(std::string_view content) {
    const bool of_checkpoint = content.empty() || content[0] % 2 == 0;
    if (!content.empty()) content.remove_prefix(1);
    write(checkpoint_file(run_), of_checkpoint ? content : checkpoint_bytes_);
    write(segment_, of_checkpoint ? std::string_view(segment_bytes_) : content);
    Training<float> training = start();
    load_checkpoint(training, run_);
  }

 private:
  Training<float> start() const {
    return start_training<float>(options_, nullptr,
                                 [](int) { return std::make_unique<PointMass>(); });
  }
  static void write(const fs::path& file, std::string_view content) {
    std::ofstream(file, std::ios::binary).write(content.data(), static_cast<long>(content.size()));
  }

  TrainOptions options_;
  fs::path run_, segment_;
  std::string checkpoint_bytes_, segment_bytes_;
};

void checkpoint(std::string_view content) {
  static SmallRun run;
  run.load(content);
}

}  // namespace stride

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return stride::read_or_refuse(data, size, stride::STRIDE_FUZZED_READER);
}
