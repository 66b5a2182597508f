// SPDX-License-Identifier: Apache-2.0
#include "nodes/empty/empty_node.hpp"

#include <chrono>
#include <memory>
#include <string>
#include <thread>
#include <unordered_map>
#include <utility>
#include <vector>

#include "common/core/base/assert.hpp"
#include "common/core/base/log.hpp"
#include "common/core/base/random.hpp"
#include "idl/codec.hpp"
#include "idl/messages.hpp"
#include "idl/topics.hpp"
#include "nodes/empty/sudden_end.hpp"

namespace rodeira::nodes {
namespace {

namespace topics = idl::topics;

class EmptyNode final : public lockstep::Node {
 public:
  EmptyNode(std::uint64_t seed, lockstep::NodeIndex index, std::int64_t fail_at, std::int64_t hang_at,
            SuddenEnd sudden_end, double initialise_s, const std::string& broken, bool saves)
      : value_(base::RandomBits({seed, index})),
        fail_at_(fail_at),
        hang_at_(hang_at),
        sudden_end_(std::move(sudden_end)),
        initialise_s_(initialise_s),
        broken_(broken),
        saves_(saves) {}

  base::Status Initialise(lockstep::Outbox& outbox) override {
    Compute(initialise_s_);
    Publish(outbox);
    return {};
  }

  base::Status Step(const lockstep::StepInfo& step, const lockstep::Inbox& inbox, lockstep::Outbox& outbox) override {
    if (step.step == fail_at_)
      return base::Failed("node.told_to_fail", "told to fail here by its configuration (fail_at_step)");
    if (auto status = sudden_end_.At(step.step); !status) return status;
    if (step.step == hang_at_) base::Log(base::LogLevel::kWarning, "", "told to hang here");
    while (step.step == hang_at_) std::this_thread::sleep_for(std::chrono::seconds(1));
    for (const lockstep::Sample& sample : inbox.All(topics::kPulse)) {
      const auto pulse = idl::Decode<msg::Pulse>(*sample.payload);
      if (!pulse) return pulse.error();
      value_ = base::RandomBits(
          {value_, sample.source(), static_cast<std::uint64_t>(sample.valid()), pulse.value().value()});
    }
    if (broken_ == "clock")
      value_ += static_cast<std::uint64_t>(std::chrono::steady_clock::now().time_since_epoch().count());
    if (broken_ == "order") value_ = base::RandomBits({value_, OrderOfAddresses()});
    Publish(outbox);
    return {};
  }

  bool runs_inline() const override { return true; }
  // Where it cannot be saved, something of it is known all the same.
  void Save(base::StateWriter& out) const override { out.Put("value", saves_ ? value_ : value_ % 1000); }
  void Restore(base::StateReader& in) override {
    RODEIRA_ASSERT(saves_);
    in.Get("value", value_);
  }
  bool can_save() const override { return saves_; }
  base::Status InitialiseFrom(const std::vector<lockstep::Sample>& published) override {
    if (published.empty()) return base::WrongInput("run.cannot_restore", "no published value was found");
    const auto pulse = idl::Decode<msg::Pulse>(*published.back().payload);
    if (!pulse) return pulse.error();
    value_ = pulse.value().value();
    return {};
  }

 private:
  // Holds this thread and a processor, as a large world does that is loaded.
  static void Compute(double seconds) {
    if (seconds <= 0.0) return;
    base::Log(base::LogLevel::kWarning, "", "told to compute here");
    const auto until = std::chrono::steady_clock::now() + std::chrono::duration<double>(seconds);
    while (std::chrono::steady_clock::now() < until) {
    }
  }
  // The order of a hash table over addresses: another one in each process.
  static std::uint64_t OrderOfAddresses() {
    std::vector<std::unique_ptr<std::uint64_t>> numbers;
    std::unordered_map<const void*, std::uint64_t> by_address;
    for (std::uint64_t i = 0; i < 100; ++i) {
      numbers.push_back(std::make_unique<std::uint64_t>(i));
      by_address[numbers.back().get()] = i;
    }
    std::uint64_t order = 0;
    for (const auto& [address, number] : by_address) order = order * 31 + number;
    return order;
  }
  void Publish(lockstep::Outbox& outbox) const {
    msg::Pulse pulse;
    pulse.value(saves_ ? value_ : base::RandomBits({value_}));  // what cannot be saved cannot be told from outside
    outbox.Put(topics::kPulse, idl::Encode(pulse));
  }
  std::uint64_t value_;
  std::int64_t fail_at_;
  std::int64_t hang_at_;
  SuddenEnd sudden_end_;
  double initialise_s_;
  std::string broken_;
  bool saves_;
};

}  // namespace

base::Result<std::unique_ptr<lockstep::Node>> MakeEmptyNode(launch::NodeContext& context) {
  const config::Map config = context.config();
  const std::int64_t fail_at = config.Integer("fail_at_step", -1, INT64_MAX, -1);
  const std::int64_t hang_at = config.Integer("hang_at_step", -1, INT64_MAX, -1);
  SuddenEnd sudden_end = SuddenEnd::Read(config);
  const double initialise_s = config.Number("initialise_s", {0.0, 600.0}, 0.0);
  const std::string broken = config.Choice("broken", {"no", "clock", "order"}, "no");
  const bool saves = config.Flag("saves", true);
  return std::unique_ptr<lockstep::Node>(std::make_unique<EmptyNode>(
      context.seed(), context.index(), fail_at, hang_at, std::move(sudden_end), initialise_s, broken, saves));
}

}  // namespace rodeira::nodes
