#pragma once

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>

namespace stride {

/// Runs `act(confirm)` in a child process, which is killed by SIGKILL after so many confirmations.
/// Returns the number of confirmations.
template <typename Act>
int killed_after(int confirmed, Act act) {
  int pipe_ends[2];
  EXPECT_EQ(::pipe(pipe_ends), 0);
  const pid_t child = ::fork();
  if (child == 0) {
    ::close(pipe_ends[0]);
    act([&] { return ::write(pipe_ends[1], ".", 1) == 1; });
    ::_exit(0);
  }
  ::close(pipe_ends[1]);
  int read = 0;
  char byte;
  while (read < confirmed && ::read(pipe_ends[0], &byte, 1) == 1) ++read;
  ::kill(child, SIGKILL);
  while (::read(pipe_ends[0], &byte, 1) == 1) ++read;  // confirmed before it died
  ::close(pipe_ends[0]);
  ::waitpid(child, nullptr, 0);
  return read;
}

}  // namespace stride
