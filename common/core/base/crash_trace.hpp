// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace rodeira::base {

// From here on a crash (SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT) writes the signal, the foreign code that it happened
// in (ForeignCall) and a backtrace to standard error before it ends the process by the same signal: one line a frame,
// "PROGRAM(+0xOFFSET)", for addr2line. `advice` is written after them; it outlives the process. Call it once, before
// other threads start. Without effect under sanitizers, which have their own.
void TraceCrashes(const char* advice = "");

// While it lives, this thread works for one of the nodes that share the process; null: for none. After TraceCrashes a
// crash says so in a line of its own: "rodeira: crash: node 'ego'". The name outlives the object.
class NodeCall {
 public:
  explicit NodeCall(const char* node) noexcept;
  ~NodeCall();
  NodeCall(const NodeCall&) = delete;
  NodeCall& operator=(const NodeCall&) = delete;

 private:
  const char* outer_node_;
};

// The node that this thread works for; null: none, or the process has one node.
const char* CurrentNode() noexcept;

// While it lives, this thread runs code that is not Rodeira's, such as a shared object of a laboratory. After
// TraceCrashes a crash says so: "rodeira: crash: SIGSEGV in fmi2DoStep of FMU '/a/car.fmu'; backtrace:". Foreign code
// that calls exit() is said the same way ("rodeira: crash: exit in ..."), and ends the process with status 1 at once.
// Both texts outlive the object and hold no line end.
class ForeignCall {
 public:
  ForeignCall(const char* function, const char* owner) noexcept;
  ~ForeignCall();
  ForeignCall(const ForeignCall&) = delete;
  ForeignCall& operator=(const ForeignCall&) = delete;

 private:
  const char* outer_function_;
  const char* outer_owner_;
};

}  // namespace rodeira::base
