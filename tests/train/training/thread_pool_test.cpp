#include "train/training/thread_pool.h"

#include <gtest/gtest.h>

#include <atomic>
#include <numeric>
#include <stdexcept>

namespace stride {
namespace {

TEST(ThreadPool, DoesEachTaskOnceWhateverItsSize) {
  for (const int threads : {1, 2, 5}) {
    training::ThreadPool pool(threads);
    for (int repetition = 0; repetition < 200; ++repetition) {
      std::vector<std::atomic<int>> done(17);
      pool.run(17, [&](int task) { ++done[static_cast<std::size_t>(task)]; });
      for (const auto& count : done) ASSERT_EQ(count, 1);
    }
  }
}

TEST(ThreadPool, CarriesAnExceptionToTheCallerAndStaysUsable) {
  training::ThreadPool pool(2);
  EXPECT_THROW(pool.run(8,
                        [](int task) {
                          if (task == 3) throw std::runtime_error("three");
                        }),
               std::runtime_error);
  int sum = 0;
  std::mutex mutex;
  pool.run(4, [&](int task) {
    const std::lock_guard lock(mutex);
    sum += task;
  });
  EXPECT_EQ(sum, 6);
}

}  // namespace
}  // namespace stride
