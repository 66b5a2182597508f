// SPDX-License-Identifier: Apache-2.0
// What the exchange of samples costs apart from the nodes' arithmetic: in the steady state a step allocates nothing and
// makes no system call, from a node's message through its bytes to the message that other nodes read. Between processes
// DDS comes on top.
#include <execinfo.h>
#include <gtest/gtest.h>
#include <linux/filter.h>
#include <linux/seccomp.h>
#include <sys/prctl.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <csignal>
#include <cstddef>
#include <cstdlib>
#include <memory>
#include <new>
#include <string>
#include <vector>

#include "common/core/base/random.hpp"
#include "common/runtime/lockstep/stepped_run.hpp"
#include "idl/codec.hpp"
#include "idl/messages.hpp"

namespace {

// Of the calling thread, while it counts.
struct Allocations {
  bool counts = false;
  std::size_t number = 0;
  std::array<void*, 24> first_from{};  // return addresses of the first one
  int depth = 0;
};
thread_local Allocations allocations;

}  // namespace

// All other forms of new and delete of the standard library call these.
void* operator new(std::size_t size) {
  if (allocations.counts && allocations.number++ == 0) {
    allocations.counts = false;  // backtrace allocates where it is called first
    allocations.depth = ::backtrace(allocations.first_from.data(), static_cast<int>(allocations.first_from.size()));
    allocations.counts = true;
  }
  if (void* const allocated = std::malloc(size)) return allocated;
  throw std::bad_alloc();
}
void operator delete(void* allocated) noexcept { std::free(allocated); }
void operator delete(void* allocated, std::size_t) noexcept { std::free(allocated); }

namespace rodeira::lockstep {
namespace {

constexpr Step kWarm = 500, kCounted = 1000;

// Folds all that it reads into one number, and publishes it.
class PulseNode final : public Node {
 public:
  PulseNode(const Roster& roster, NodeIndex index) : topics_(TopicsOf(roster, index)), value_(index) {}

  base::Status Initialise(Outbox& outbox) override {
    Publish(outbox);
    return {};
  }
  base::Status Step(const StepInfo&, const Inbox& inbox, Outbox& outbox) override {
    for (const Inbox::PortSamples& port : inbox.ports()) {
      for (const Sample& sample : port.samples) {
        const auto pulse = idl::Decode<msg::Pulse>(*sample.payload);
        if (!pulse) return pulse.error();
        value_ = base::RandomBits({value_, sample.source(), pulse.value().value()});
      }
    }
    Publish(outbox);
    return {};
  }
  void Save(base::StateWriter& out) const override { out.Put("value", value_); }
  void Restore(base::StateReader& in) override { in.Get("value", value_); }

 private:
  static std::vector<std::string> TopicsOf(const Roster& roster, NodeIndex index) {
    std::vector<std::string> topics;
    for (const SourceIndex source : roster.node(index).outputs) topics.push_back(roster.source(source).topic);
    return topics;
  }
  void Publish(Outbox& outbox) const {
    for (const std::string& topic : topics_) {
      msg::Pulse pulse;
      pulse.value(value_);
      outbox.Put(topic, idl::Encode(pulse));
    }
  }

  const std::vector<std::string> topics_;
  std::uint64_t value_;
};

// A fast node, a slow one that sees the fast one's state and all of its events, and a sink.
Roster MakeRoster() {
  return Roster::Create(1'000'000, 20,
                        {{"fast", "t", Role::kStepped, 1, 0, 0, {"a", "b"}, {{"c", PortKind::kState, {"slow"}}}},
                         {"slow",
                          "t",
                          Role::kStepped,
                          7,
                          0,
                          0,
                          {"c"},
                          {{"a", PortKind::kState, {"fast"}}, {"b", PortKind::kEvent, {"fast"}}}},
                         {"sink",
                          "t",
                          Role::kStepped,
                          10,
                          0,
                          0,
                          {},
                          {{"a", PortKind::kEvent, {"fast"}}, {"c", PortKind::kEvent, {"slow"}}}}})
      .value();
}

class SteadyRun {
 public:
  SteadyRun() {
    for (NodeIndex n = 0; n < roster_.nodes().size(); ++n) {
      owned_.push_back(std::make_unique<PulseNode>(roster_, n));
      nodes_.push_back(owned_.back().get());
    }
    run_ = std::make_unique<SteppedRun>(roster_, nodes_, SteppedRun::Settings{});
    EXPECT_TRUE(run_->Start().ok());
    EXPECT_TRUE(RunOn(0, kWarm));
  }
  // Step by step, as a simulation that is driven from outside does.
  bool RunOn(Step from = kWarm, Step steps = kCounted) {
    bool ok = true;
    for (Step step = 1; step <= steps; ++step) ok = run_->RunThrough(from + step).ok() && ok;
    return ok;
  }

 private:
  const Roster roster_ = MakeRoster();
  std::vector<std::unique_ptr<PulseNode>> owned_;
  std::vector<Node*> nodes_;
  std::unique_ptr<SteppedRun> run_;
};

std::string FirstPlace() {
  char** const names = ::backtrace_symbols(allocations.first_from.data(), allocations.depth);
  std::string text = "the first one is made from";
  for (int i = 0; i < allocations.depth; ++i) text += std::string("\n  ") + names[i];
  std::free(names);
  return text;
}

TEST(SteadyStep, AllocatesNothing) {
  SteadyRun run;
  (void)::backtrace(allocations.first_from.data(), 1);
  allocations = {};
  allocations.counts = true;
  const bool ok = run.RunOn();
  allocations.counts = false;
  EXPECT_TRUE(ok);
  EXPECT_EQ(allocations.number, 0u) << FirstPlace();
}

TEST(SteadyStep, HasItsAllocationsCounted) {
  allocations = {};
  allocations.counts = true;
  const auto made = std::make_unique<int>(1);
  const std::vector<double> list(3);
  allocations.counts = false;
  EXPECT_EQ(allocations.number, 2u) << *made << list.size();
}

#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)  // they make system calls of their own
// Writes the number of the system call to standard error.
void NameSystemCall(int, siginfo_t* info, void*) {
  char text[] = "system call ...\n";
  for (int i = 0, rest = info->si_syscall; i < 3; ++i, rest /= 10) text[14 - i] = static_cast<char>('0' + rest % 10);
  (void)!::write(STDERR_FILENO, text, sizeof(text) - 1);
  ::_exit(3);
}

// From now on this process may read the clock, write, and end. Any other system call ends it with status 3.
bool ForbidSystemCalls() {
  struct sigaction action {};
  action.sa_sigaction = NameSystemCall;
  action.sa_flags = SA_SIGINFO;
  if (::sigaction(SIGSYS, &action, nullptr) != 0) return false;
  constexpr auto kAllowed = [](unsigned number, unsigned char skipped) {
    return sock_filter BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, number, skipped, 0);
  };
  sock_filter filter[] = {
      BPF_STMT(BPF_LD | BPF_W | BPF_ABS, offsetof(seccomp_data, nr)),
      kAllowed(SYS_clock_gettime, 4),  // only where the kernel has no faster way
      kAllowed(SYS_exit_group, 3),
      kAllowed(SYS_write, 2),
      kAllowed(SYS_rt_sigreturn, 1),
      BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_TRAP),
      BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_ALLOW),
  };
  sock_fprog program{static_cast<unsigned short>(std::size(filter)), filter};
  return ::prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) == 0 && ::prctl(PR_SET_SECCOMP, SECCOMP_MODE_FILTER, &program) == 0;
}

// The exit status of a child that runs on and then does `last`.
int RunOnWithoutSystemCalls(void (*last)()) {
  SteadyRun run;
  const pid_t child = ::fork();
  if (child == 0) {
    if (!ForbidSystemCalls()) ::_exit(4);
    const bool ok = run.RunOn();
    last();
    ::_exit(ok ? 0 : 1);
  }
  int status = 0;
  EXPECT_EQ(::waitpid(child, &status, 0), child);
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

TEST(SteadyStep, MakesNoSystemCall) {
  EXPECT_EQ(RunOnWithoutSystemCalls([] {}), 0);
}

TEST(SteadyStep, IsEndedByASystemCall) {
  EXPECT_EQ(RunOnWithoutSystemCalls([] { (void)::getppid(); }), 3);
}
#endif

}  // namespace
}  // namespace rodeira::lockstep
