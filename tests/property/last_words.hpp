// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <signal.h>
#include <unistd.h>

#include <cstdio>
#include <cstring>
#include <string>

// Which input is being tried, said where that ends the process: what a crash leaves to be repeated with.
namespace rodeira::property {

inline char g_last_words[160] = "";

inline void SayAndDie(int number) {
  [[maybe_unused]] const ssize_t written = ::write(STDERR_FILENO, g_last_words, std::strlen(g_last_words));
  ::signal(number, SIG_DFL);
  ::raise(number);
}

// Sanitizers end a process by SIGABRT (ASAN_OPTIONS=abort_on_error=1); SIGPROF and SIGALRM are for what hangs.
inline void SayWhereItDies() {
  for (const int number : {SIGALRM, SIGPROF, SIGABRT, SIGFPE, SIGSEGV}) ::signal(number, SayAndDie);
}

inline void NowTrying(const std::string& format, std::size_t number) {
  std::snprintf(g_last_words, sizeof(g_last_words), "%s %zu (RODEIRA_FUZZ_FIRST=%zu RODEIRA_FUZZ_FILES=1)\n",
                format.c_str(), number, number);
}

}  // namespace rodeira::property
