// SPDX-License-Identifier: Apache-2.0
#include "common/runtime/launch/live_requests.hpp"

#include <utility>

#include "common/runtime/launch/live_keys.hpp"

namespace rodeira::launch {

void LiveRequestsMemory::Hear(const LiveRequestsSaid& said) {
  const std::lock_guard lock(mutex_);
  std::uint32_t& heard = heard_[said.window];
  for (const LiveRequest& request : said.requests) {
    if (request.number <= heard) continue;
    heard = request.number;
    waiting_.push_back(request);
  }
}

std::vector<LiveRequest> LiveRequestsMemory::Take() {
  const std::lock_guard lock(mutex_);
  return std::exchange(waiting_, {});
}

class LiveRequestsBoard::Sender final : public LiveRequestsSender {
 public:
  explicit Sender(LiveRequestsBoard& board) : board_(board) {}
  void Say(std::vector<LiveRequest> requests) override { board_.Say({window_, std::move(requests)}); }

 private:
  LiveRequestsBoard& board_;
  const std::uint64_t window_ = DrawWindow();
};

class LiveRequestsBoard::Receiver final : public LiveRequestsReceiver {
 public:
  explicit Receiver(std::shared_ptr<LiveRequestsMemory> memory) : memory_(std::move(memory)) {}
  std::vector<LiveRequest> Take() override { return memory_->Take(); }

 private:
  std::shared_ptr<LiveRequestsMemory> memory_;
};

std::unique_ptr<LiveRequestsSender> LiveRequestsBoard::MakeSender() { return std::make_unique<Sender>(*this); }

std::unique_ptr<LiveRequestsReceiver> LiveRequestsBoard::MakeReceiver() {
  const std::lock_guard lock(mutex_);
  memories_.push_back(std::make_shared<LiveRequestsMemory>());
  return std::make_unique<Receiver>(memories_.back());
}

void LiveRequestsBoard::Say(const LiveRequestsSaid& said) {
  const std::lock_guard lock(mutex_);
  for (const auto& memory : memories_) memory->Hear(said);
}

}  // namespace rodeira::launch
