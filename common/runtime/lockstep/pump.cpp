// SPDX-License-Identifier: Apache-2.0
#include "common/runtime/lockstep/pump.hpp"

#include <algorithm>
#include <atomic>
#include <condition_variable>
#include <functional>
#include <memory>
#include <mutex>

namespace rodeira::lockstep {
namespace {

class Pump {
 public:
  explicit Pump(Runner& runner) : runner_(runner) {}

  // From any thread: works as long as there is work. A thread that finds another at it leaves it a note and goes.
  void Poke() {
    ++notes_;
    while (!over_ && !busy_.exchange(true)) {
      const std::uint64_t seen = notes_;
      Work();
      busy_ = false;
      if (notes_ == seen) return;
    }
  }
  void RequestRetransmission() {
    ask_ = true;
    Poke();
  }

  std::uint64_t worked() const { return worked_; }
  bool WaitForEnd(std::chrono::milliseconds limit) {
    std::unique_lock lock(mutex_);
    return ended_.wait_for(lock, limit, [&] { return over_.load(); });
  }
  Runner::Outcome outcome() const { return outcome_; }

 private:
  void Work() {
    while (!over_) {
      const Runner::Outcome outcome = runner_.Advance(std::chrono::milliseconds(0));
      if (outcome == Runner::Outcome::kBlocked) break;
      ++worked_;
      if (outcome == Runner::Outcome::kWorking) continue;
      const std::lock_guard lock(mutex_);
      outcome_ = outcome;
      over_ = true;
      ended_.notify_all();
    }
    if (ask_.exchange(false) && !over_) runner_.RequestRetransmission();
  }

  Runner& runner_;  // not touched once it is over
  std::atomic<std::uint64_t> notes_ = 0;
  std::atomic<std::uint64_t> worked_ = 0;
  std::atomic<bool> busy_ = false;
  std::atomic<bool> ask_ = false;
  std::atomic<bool> over_ = false;
  std::mutex mutex_;
  std::condition_variable ended_;
  Runner::Outcome outcome_ = Runner::Outcome::kBlocked;
};

}  // namespace

Runner::Outcome RunInline(Runner& runner, Mailbox& mailbox, const Runner::Settings& settings) {
  // Shared: a message may still be on its way through the callback when the run is over.
  const auto pump = std::make_shared<Pump>(runner);
  mailbox.OnReady(std::make_shared<const std::function<void()>>([pump] { pump->Poke(); }));
  pump->Poke();
  auto patience = settings.patience;
  std::uint64_t worked = pump->worked();
  while (!pump->WaitForEnd(patience)) {
    const bool stuck = pump->worked() == worked;
    worked = pump->worked();
    patience = stuck ? std::min(2 * patience, settings.most_patience) : settings.patience;
    if (stuck) pump->RequestRetransmission();
  }
  mailbox.OnReady(nullptr);
  return pump->outcome();
}

}  // namespace rodeira::lockstep
