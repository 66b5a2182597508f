#include "nodes/empty/empty_node.hpp"

#include <chrono>
#include <thread>

#include "common/base/random.hpp"
#include "idl/codec.hpp"
#include "idl/messages.hpp"
#include "idl/topics.hpp"

namespace rodeira::nodes {
namespace {

namespace topics = idl::topics;

class EmptyNode final : public lockstep::Node {
 public:
  EmptyNode(std::uint64_t seed, lockstep::NodeIndex index, std::int64_t fail_at, std::int64_t hang_at)
      : value_(base::RandomBits({seed, index})), fail_at_(fail_at), hang_at_(hang_at) {}

  base::Status Initialise(lockstep::Outbox& outbox) override {
    Publish(outbox);
    return {};
  }

  base::Status Step(const lockstep::StepInfo& step, const lockstep::Inbox& inbox, lockstep::Outbox& outbox) override {
    if (step.step == fail_at_) return base::Failed("told to fail here by its configuration (fail_at_step)");
    while (step.step == hang_at_) std::this_thread::sleep_for(std::chrono::seconds(1));
    for (const lockstep::Sample& sample : inbox.All(topics::kPulse)) {
      const auto pulse = idl::Decode<msg::Pulse>(*sample.payload);
      if (!pulse) return pulse.error();
      value_ = base::RandomBits({value_, sample.source(), static_cast<std::uint64_t>(sample.valid()), pulse.value().value()});
    }
    Publish(outbox);
    return {};
  }

  bool is_brief() const override { return true; }
  void Save(base::StateWriter& out) const override { out.Put("value", value_); }
  void Restore(base::StateReader& in) override { in.Get("value", value_); }

 private:
  void Publish(lockstep::Outbox& outbox) const {
    msg::Pulse pulse;
    pulse.value(value_);
    outbox.Put(topics::kPulse, idl::Encode(pulse));
  }
  std::uint64_t value_;
  std::int64_t fail_at_;
  std::int64_t hang_at_;
};

}  // namespace

base::Result<std::unique_ptr<lockstep::Node>> MakeEmptyNode(launch::NodeContext& context) {
  const config::Map config = context.config();
  const std::int64_t fail_at = config.Integer("fail_at_step", -1, INT64_MAX, -1);
  const std::int64_t hang_at = config.Integer("hang_at_step", -1, INT64_MAX, -1);
  return std::unique_ptr<lockstep::Node>(std::make_unique<EmptyNode>(context.seed(), context.index(), fail_at, hang_at));
}

}  // namespace rodeira::nodes
