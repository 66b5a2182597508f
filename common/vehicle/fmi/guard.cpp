// SPDX-License-Identifier: Apache-2.0
#include "common/vehicle/fmi/guard.hpp"

#include <setjmp.h>
#include <signal.h>

#include <array>
#include <cstddef>

namespace rodeira::fmi {
namespace {

constexpr std::array kCrashes = {SIGSEGV, SIGBUS, SIGILL, SIGFPE, SIGABRT};
constexpr std::size_t kStackBytes = 64 * 1024;

// Where this thread goes on when the foreign code in it crashes; null while there is none.
thread_local sigjmp_buf* t_way_out = nullptr;
std::array<struct sigaction, kCrashes.size()> g_before;

extern "C" void OnCrash(int signal, siginfo_t*, void*) {
  if (t_way_out != nullptr) ::siglongjmp(*t_way_out, signal);
  // Not of foreign code: what would have been done.
  for (std::size_t i = 0; i < kCrashes.size(); ++i) {
    if (kCrashes[i] == signal) (void)::sigaction(signal, &g_before[i], nullptr);
  }
  (void)::raise(signal);
}

bool Install() {
  struct sigaction action {};
  action.sa_sigaction = &OnCrash;
  action.sa_flags = SA_SIGINFO | SA_ONSTACK | SA_NODEFER;  // not held back when the handler is left by the jump
  for (std::size_t i = 0; i < kCrashes.size(); ++i) (void)::sigaction(kCrashes[i], &action, &g_before[i]);
  return true;
}

// The handler's stack: the thread's own may be what has run out. Where there is one already (a sanitizer's) it stays.
bool GiveStack() {
  thread_local std::array<std::byte, kStackBytes> t_stack;
  stack_t now{};
  if (::sigaltstack(nullptr, &now) != 0 || (now.ss_flags & SS_DISABLE) == 0) return false;
  const stack_t own{.ss_sp = t_stack.data(), .ss_flags = 0, .ss_size = t_stack.size()};
  return ::sigaltstack(&own, nullptr) == 0;
}

}  // namespace

int CallGuarded(void (*code)(void* context), void* context) {
  static const bool installed = Install();
  thread_local const bool has_stack = GiveStack();
  (void)installed;
  (void)has_stack;
  sigjmp_buf here;
  sigjmp_buf* const outer = t_way_out;
  const int signal = sigsetjmp(here, 0);
  if (signal == 0) {
    t_way_out = &here;
    code(context);
  }
  t_way_out = outer;
  return signal;
}

}  // namespace rodeira::fmi
