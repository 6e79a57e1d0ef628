#pragma once

#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <thread>

#include "extract/io/random.h"

namespace stride {

/// Calls `train` twelve times, each in a child process that is killed after at most a sixth of
/// `duration`, which is that of an uninterrupted run: so the first calls cannot finish, however
/// fast the machine is. Returns how many children were still running.
template <class Train>
int killed_at_random_moments(const Train& train, std::chrono::nanoseconds duration) {
  Random random(17);
  int kills = 0;
  for (int i = 0; i < 12; ++i) {
    const pid_t child = ::fork();
    if (child == 0) {
      train();
      ::_exit(0);
    }
    std::this_thread::sleep_for(duration * uniform(random) / 6);
    ::kill(child, SIGKILL);
    int status = 0;
    ::waitpid(child, &status, 0);
    kills += WIFSIGNALED(status);
  }
  return kills;
}

}  // namespace stride
