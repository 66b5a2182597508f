// SPDX-License-Identifier: Apache-2.0
#include "common/core/base/crash_trace.hpp"

#include <execinfo.h>
#include <signal.h>
#include <unistd.h>

#include <array>
#include <cstring>
#include <string_view>

namespace rodeira::base {
namespace {

#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)

constexpr std::array kCrashSignals{SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT};
constexpr int kMaxFrames = 64;

void WriteText(std::string_view text) {
  [[maybe_unused]] const ssize_t written = ::write(STDERR_FILENO, text.data(), text.size());
}

// Only functions that are safe in a signal handler.
void OnCrash(int number) {
  const char* name = ::sigabbrev_np(number);
  WriteText("rodeira: crash: SIG");
  WriteText(name == nullptr ? "?" : name);
  WriteText("; backtrace:\n");
  std::array<void*, kMaxFrames> frames;
  ::backtrace_symbols_fd(frames.data(), ::backtrace(frames.data(), kMaxFrames), STDERR_FILENO);
  ::signal(number, SIG_DFL);
  ::raise(number);
}

#endif

}  // namespace

void TraceCrashes() {
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
  void* frame = nullptr;
  (void)::backtrace(&frame, 1);  // loads its library now, not in the handler
  struct sigaction action {};
  action.sa_handler = OnCrash;
  action.sa_flags = static_cast<int>(SA_ONSTACK | SA_RESETHAND | SA_NODEFER);
  for (const int number : kCrashSignals) ::sigaction(number, &action, nullptr);
#endif
}

}  // namespace rodeira::base
