// SPDX-License-Identifier: Apache-2.0
#include "common/runtime/launch/run_log_border.hpp"

#include <utility>

namespace rodeira::launch {

class RunLogBoard::Receiver final : public RunLogReceiver {
 public:
  explicit Receiver(std::shared_ptr<lockstep::LogInbox> inbox) : inbox_(std::move(inbox)) {}
  std::vector<lockstep::LogBatch> Take() override { return inbox_->Take(); }
  void BeginAt(std::uint64_t number) override { inbox_->BeginAt(number); }
  bool AwaitEnd(std::chrono::milliseconds limit) override { return inbox_->AwaitEnd(limit); }

 private:
  std::shared_ptr<lockstep::LogInbox> inbox_;
};

std::unique_ptr<RunLogReceiver> RunLogBoard::MakeReceiver() {
  const std::lock_guard lock(mutex_);
  inboxes_.push_back(std::make_shared<lockstep::LogInbox>());
  return std::make_unique<Receiver>(inboxes_.back());
}

void RunLogBoard::Say(const lockstep::LogBatch& batch) {
  const std::lock_guard lock(mutex_);
  for (const auto& inbox : inboxes_) inbox->Deliver(batch);
}

}  // namespace rodeira::launch
