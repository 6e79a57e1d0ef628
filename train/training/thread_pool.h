#pragma once

#include <condition_variable>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

namespace stride::training {

/// A thread pool. The caller is one of its threads, so a pool of one starts none.
class ThreadPool {
 public:
  /// `threads` ≤ 0: one for each core.
  explicit ThreadPool(int threads);
  ~ThreadPool();
  ThreadPool(const ThreadPool&) = delete;
  ThreadPool& operator=(const ThreadPool&) = delete;

  /// Calls work(0) … work(tasks − 1) once each, started in this order, and returns when all are
  /// done. Rethrows the first exception of a task.
  void run(int tasks, const std::function<void(int)>& work);

  int size() const { return static_cast<int>(threads_.size()) + 1; }

 private:
  void serve();
  void take_tasks(std::unique_lock<std::mutex>& lock);

  std::mutex mutex_;
  std::condition_variable start_, finish_;
  const std::function<void(int)>* work_ = nullptr;
  int next_ = 0, tasks_ = 0, unfinished_ = 0;
  std::exception_ptr failure_;
  bool stop_ = false;
  std::vector<std::thread> threads_;
};

}  // namespace stride::training
