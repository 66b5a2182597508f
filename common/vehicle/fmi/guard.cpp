// SPDX-License-Identifier: Apache-2.0
#include "common/vehicle/fmi/guard.hpp"

#include <setjmp.h>
#include <signal.h>

#include <array>
#include <cstddef>
#include <memory>

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
// It lies on the heap: as thread-local storage it would be taken from the stack of every thread of the program.
class SignalStack {
 public:
  SignalStack() {
    stack_t now{};
    if (::sigaltstack(nullptr, &now) != 0 || (now.ss_flags & SS_DISABLE) == 0) return;
    bytes_ = std::make_unique<std::array<std::byte, kStackBytes>>();
    const stack_t own{.ss_sp = bytes_->data(), .ss_flags = 0, .ss_size = bytes_->size()};
    if (::sigaltstack(&own, nullptr) != 0) bytes_.reset();
  }
  ~SignalStack() {
    const stack_t none{.ss_sp = nullptr, .ss_flags = SS_DISABLE, .ss_size = 0};
    if (bytes_ != nullptr) (void)::sigaltstack(&none, nullptr);
  }
  SignalStack(const SignalStack&) = delete;
  SignalStack& operator=(const SignalStack&) = delete;

 private:
  std::unique_ptr<std::array<std::byte, kStackBytes>> bytes_;
};

}  // namespace

int CallGuarded(void (*code)(void* context), void* context) {
  static const bool installed = Install();
  thread_local const SignalStack stack;
  (void)installed;
  (void)stack;
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
