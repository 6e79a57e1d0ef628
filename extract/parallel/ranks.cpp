#include "extract/parallel/ranks.h"

#include <cstdlib>
#include <numeric>

#ifdef STRIDE_MPI
#define OMPI_SKIP_MPICXX 1  // the C interface
#include <mpi.h>
#endif

#include "extract/io/error.h"

namespace stride::parallel {
namespace {

/// How many processes a launcher says it has started: Open MPI's, or one that speaks PMI, as srun
/// and MPICH's do; 1 without one.
int launched() {
  for (const char* name : {"OMPI_COMM_WORLD_SIZE", "PMI_SIZE"})
    if (const char* text = std::getenv(name)) return std::atoi(text);
  return 1;
}

}  // namespace

Ranks& Ranks::world() {
  static Ranks ranks(launched() > 1);  // starting MPI takes longer than many a command
  return ranks;
}

Ranks& Ranks::alone() {
  static Ranks ranks(false);
  return ranks;
}

#ifdef STRIDE_MPI

Ranks::Ranks(bool started) : started_(started) {
  if (!started) return;
  int provided = 0;
  MPI_Init_thread(nullptr, nullptr, MPI_THREAD_FUNNELED, &provided);
  require(provided >= MPI_THREAD_FUNNELED, "MPI: does not allow for threads; use Open MPI");
  MPI_Comm_rank(MPI_COMM_WORLD, &rank_);
  MPI_Comm_size(MPI_COMM_WORLD, &size_);
}

void Ranks::wait_for_all() {
  if (started_) MPI_Barrier(MPI_COMM_WORLD);
}

void Ranks::broadcast(void* bytes, std::size_t size) {
  if (started_) MPI_Bcast(bytes, static_cast<int>(size), MPI_BYTE, 0, MPI_COMM_WORLD);
}

std::vector<std::string> Ranks::gather(std::string_view message) {
  if (!started_) return {std::string(message)};
  const auto n = static_cast<std::size_t>(size_);
  const int own = static_cast<int>(message.size());
  std::vector<int> sizes(n), starts(n);
  MPI_Allgather(&own, 1, MPI_INT, sizes.data(), 1, MPI_INT, MPI_COMM_WORLD);
  std::exclusive_scan(sizes.begin(), sizes.end(), starts.begin(), 0);
  std::string all(static_cast<std::size_t>(starts.back() + sizes.back()), '\0');
  MPI_Allgatherv(message.data(), own, MPI_BYTE, all.data(), sizes.data(), starts.data(), MPI_BYTE,
                 MPI_COMM_WORLD);
  std::vector<std::string> messages;
  for (std::size_t i = 0; i < n; ++i)
    messages.push_back(
        all.substr(static_cast<std::size_t>(starts[i]), static_cast<std::size_t>(sizes[i])));
  return messages;
}

void Ranks::finish() {
  if (started_) MPI_Finalize();
  started_ = false;
}

#else

Ranks::Ranks(bool started) {
  require(!started,
          "mpirun started {} processes, but this program was built without MPI and each would do "
          "all the work: install libopenmpi-dev and build it anew, or give each process its share "
          "with `stride experiment NAME --only ARM/SEED`",
          launched());
}

void Ranks::wait_for_all() {}
void Ranks::broadcast(void*, std::size_t) {}
std::vector<std::string> Ranks::gather(std::string_view message) { return {std::string(message)}; }
void Ranks::finish() {}

#endif

}  // namespace stride::parallel
