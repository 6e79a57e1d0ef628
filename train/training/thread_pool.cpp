#include "train/training/thread_pool.h"

#include <algorithm>
#include <exception>
#include <utility>

namespace stride::training {

ThreadPool::ThreadPool(int threads) {
  if (threads <= 0) threads = static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
  for (int i = 1; i < threads; ++i) threads_.emplace_back([this] { serve(); });
}

ThreadPool::~ThreadPool() {
  {
    const std::lock_guard lock(mutex_);
    stop_ = true;
  }
  start_.notify_all();
  for (std::thread& thread : threads_) thread.join();
}

void ThreadPool::take_tasks(std::unique_lock<std::mutex>& lock) {
  while (next_ < tasks_) {
    const int task = next_++;
    lock.unlock();
    std::exception_ptr failure;
    try {
      (*work_)(task);
    } catch (...) {  // rethrown in the caller of run()
      failure = std::current_exception();
    }
    lock.lock();
    if (failure && !failure_) failure_ = failure;
    if (--unfinished_ == 0) finish_.notify_one();
  }
}

void ThreadPool::serve() {
  std::unique_lock lock(mutex_);
  for (;;) {
    start_.wait(lock, [this] { return stop_ || next_ < tasks_; });
    if (stop_) return;
    take_tasks(lock);
  }
}

void ThreadPool::run(int tasks, const std::function<void(int)>& work) {
  std::unique_lock lock(mutex_);
  work_ = &work;
  next_ = 0;
  tasks_ = unfinished_ = tasks;
  start_.notify_all();
  take_tasks(lock);
  finish_.wait(lock, [this] { return unfinished_ == 0; });
  if (failure_) std::rethrow_exception(std::exchange(failure_, nullptr));
}

}  // namespace stride::training
