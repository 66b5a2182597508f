// SPDX-License-Identifier: Apache-2.0
#include "common/runtime/launch/live_keys.hpp"

#include <algorithm>
#include <chrono>
#include <random>
#include <set>
#include <utility>

namespace rodeira::launch {

bool KeysNow::Holds(std::uint32_t key) const { return std::binary_search(held.begin(), held.end(), key); }

std::uint32_t KeysNow::PressesOf(std::uint32_t key) const {
  const auto found = presses.find(key);
  return found == presses.end() ? 0 : found->second;
}

void LiveKeysMemory::Hear(const LiveKeysSaid& said, double now_s) {
  const std::lock_guard lock(mutex_);
  std::erase_if(windows_, [now_s](const auto& entry) { return now_s - entry.second.heard_s > kForget_s; });
  const auto known = windows_.find(said.window);
  if (known == windows_.end()) {  // what was pressed before we came counts no more
    windows_[said.window] = {said.number, now_s, said.keys};
    return;
  }
  Window& window = known->second;
  if (said.number <= window.number) return;  // overtaken
  for (const LiveKey& key : said.keys) {
    const auto before =
        std::find_if(window.keys.begin(), window.keys.end(), [&](const LiveKey& old) { return old.key == key.key; });
    const std::uint32_t old = before == window.keys.end() ? 0 : before->presses;
    if (key.presses > old) presses_[key.key] += key.presses - old;
  }
  window = {said.number, now_s, said.keys};
}

KeysNow LiveKeysMemory::Take(double now_s) {
  const std::lock_guard lock(mutex_);
  KeysNow now;
  std::set<std::uint32_t> held;
  for (const auto& [number, window] : windows_) {
    if (now_s - window.heard_s > kSilence_s) continue;
    for (const LiveKey& key : window.keys) {
      if (key.held) held.insert(key.key);
    }
  }
  now.held.assign(held.begin(), held.end());
  now.presses = std::exchange(presses_, {});
  return now;
}

double WallSeconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

std::uint64_t DrawWindow() {
  std::random_device device;
  return static_cast<std::uint64_t>(device()) << 32 | device();
}

class LiveKeysBoard::Sender final : public LiveKeysSender {
 public:
  explicit Sender(LiveKeysBoard& board) : board_(board) {}
  void Say(std::vector<LiveKey> keys) override { board_.Say({window_, ++number_, std::move(keys)}); }

 private:
  LiveKeysBoard& board_;
  const std::uint64_t window_ = DrawWindow();
  std::uint64_t number_ = 0;
};

class LiveKeysBoard::Receiver final : public LiveKeysReceiver {
 public:
  explicit Receiver(std::shared_ptr<LiveKeysMemory> memory) : memory_(std::move(memory)) {}
  KeysNow Take() override { return memory_->Take(WallSeconds()); }

 private:
  std::shared_ptr<LiveKeysMemory> memory_;
};

std::unique_ptr<LiveKeysSender> LiveKeysBoard::MakeSender() { return std::make_unique<Sender>(*this); }

std::unique_ptr<LiveKeysReceiver> LiveKeysBoard::MakeReceiver() {
  const std::lock_guard lock(mutex_);
  memories_.push_back(std::make_shared<LiveKeysMemory>());
  return std::make_unique<Receiver>(memories_.back());
}

void LiveKeysBoard::Say(const LiveKeysSaid& said) {
  const std::lock_guard lock(mutex_);
  for (const auto& memory : memories_) memory->Hear(said, WallSeconds());
}

}  // namespace rodeira::launch
