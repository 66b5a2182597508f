// SPDX-License-Identifier: Apache-2.0
#include "common/core/base/crash_trace.hpp"

#include <execinfo.h>
#include <signal.h>
#include <unistd.h>

#include <array>
#include <cstddef>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <string_view>

namespace rodeira::base {
namespace {

// The foreign code that the thread runs; null: none.
thread_local const char* t_function = nullptr;
thread_local const char* t_owner = nullptr;
thread_local const char* t_node = nullptr;  // that it works for; null: the process has one

#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)

constexpr std::array kCrashSignals{SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT};
constexpr int kMaxFrames = 64;
constexpr std::size_t kStackBytes = 64 * 1024;
const char* g_advice = nullptr;  // null: TraceCrashes was not called

void WriteText(std::string_view text) {
  [[maybe_unused]] const ssize_t written = ::write(STDERR_FILENO, text.data(), text.size());
}

void WritePlace() {
  if (t_function == nullptr) return;
  WriteText(" in ");
  WriteText(t_function);
  WriteText(" of ");
  WriteText(t_owner);
}

// Only functions that are safe in a signal handler.
void OnCrash(int number) {
  if (t_node != nullptr) {
    WriteText("rodeira: crash: node '");
    WriteText(t_node);
    WriteText("'\n");
  }
  const char* name = ::sigabbrev_np(number);
  WriteText("rodeira: crash: SIG");
  WriteText(name == nullptr ? "?" : name);
  WritePlace();
  WriteText("; backtrace:\n");
  std::array<void*, kMaxFrames> frames;
  ::backtrace_symbols_fd(frames.data(), ::backtrace(frames.data(), kMaxFrames), STDERR_FILENO);
  WriteText(g_advice);
  ::signal(number, SIG_DFL);
  ::raise(number);
}

// Other threads still run: nothing of the program is destroyed.
void OnExit() {
  if (t_function == nullptr) return;
  WriteText("rodeira: crash: exit");
  WritePlace();
  WriteText("\n");
  WriteText(g_advice);
  ::_exit(1);
}

// The handler's stack, one a thread: a crash may be the end of the thread's own stack. It lies on the heap: as
// thread-local storage it would be taken from the stack of every thread of the program.
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

void PrepareThread() {
  if (g_advice == nullptr) return;
  static const int registered = std::atexit(OnExit);
  thread_local const SignalStack stack;
  (void)registered;
  (void)stack;
}

#else

void PrepareThread() {}

#endif

}  // namespace

void TraceCrashes([[maybe_unused]] const char* advice) {
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
  g_advice = advice;
  void* frame = nullptr;
  (void)::backtrace(&frame, 1);  // loads its library now, not in the handler
  struct sigaction action {};
  action.sa_handler = OnCrash;
  action.sa_flags = static_cast<int>(SA_ONSTACK | SA_RESETHAND | SA_NODEFER);
  for (const int number : kCrashSignals) ::sigaction(number, &action, nullptr);
#endif
}

NodeCall::NodeCall(const char* node) noexcept : outer_node_(t_node) { t_node = node; }
NodeCall::~NodeCall() { t_node = outer_node_; }
const char* CurrentNode() noexcept { return t_node; }

ForeignCall::ForeignCall(const char* function, const char* owner) noexcept
    : outer_function_(t_function), outer_owner_(t_owner) {
  PrepareThread();
  t_owner = owner;
  t_function = function;
}

ForeignCall::~ForeignCall() {
  t_function = outer_function_;
  t_owner = outer_owner_;
}

}  // namespace rodeira::base
