#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace stride::parallel {

/// The processes that mpirun started together, each with a number, its rank; without mpirun there
/// is one. Every call but size() and rank() is collective: all ranks make it, in the same order.
/// An error in one rank ends the others: a process that ends without its farewell makes mpirun stop
/// them all and say so.
class Ranks {
 public:
  /// Those of this process. Throws Error if mpirun started several and the program was built
  /// without MPI.
  static Ranks& world();
  /// This process by itself, whoever else there is.
  static Ranks& alone();

  Ranks(const Ranks&) = delete;
  Ranks& operator=(const Ranks&) = delete;

  int rank() const { return rank_; }
  int size() const { return size_; }
  bool first() const { return rank_ == 0; }

  /// Whether item number `i` of a list that the ranks share is this one's.
  bool owns(int i) const { return i % size_ == rank_; }

  /// Returns when all ranks have come here.
  void wait_for_all();

  /// Replaces `bytes` by those of the first rank; the size is the same everywhere.
  void broadcast(void* bytes, std::size_t size);

  /// The messages of all ranks, in their order, to every rank.
  std::vector<std::string> gather(std::string_view message);

  /// The last call of a program that succeeded.
  void finish();

 private:
  explicit Ranks(bool started);

  int rank_ = 0, size_ = 1;
  bool started_ = false;
};

}  // namespace stride::parallel
