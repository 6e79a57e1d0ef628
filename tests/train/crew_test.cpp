#include "train/crew.h"

#include <gtest/gtest.h>

#include <atomic>
#include <numeric>
#include <stdexcept>

namespace stride {
namespace {

TEST(Crew, DoesEachTaskOnceWhateverItsSize) {
  for (const int threads : {1, 2, 5}) {
    Crew crew(threads);
    for (int repetition = 0; repetition < 200; ++repetition) {
      std::vector<std::atomic<int>> done(17);
      crew.run(17, [&](int task) { ++done[static_cast<std::size_t>(task)]; });
      for (const auto& count : done) ASSERT_EQ(count, 1);
    }
  }
}

TEST(Crew, CarriesAnExceptionToTheCallerAndStaysUsable) {
  Crew crew(2);
  EXPECT_THROW(crew.run(8,
                        [](int task) {
                          if (task == 3) throw std::runtime_error("three");
                        }),
               std::runtime_error);
  int sum = 0;
  std::mutex mutex;
  crew.run(4, [&](int task) {
    const std::lock_guard lock(mutex);
    sum += task;
  });
  EXPECT_EQ(sum, 6);
}

}  // namespace
}  // namespace stride
