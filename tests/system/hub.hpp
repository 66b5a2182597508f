// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <string>
#include <thread>
#include <vector>

namespace rodeira::system_test {

// What the network between the PCs does to a frame. The default does nothing.
struct Weather {
  double loss = 0.0;                    // share of frames that never arrive
  std::chrono::microseconds jitter{0};  // each comes late by 0 to this much, so later ones overtake it
  bool multicast = true;                // false: no multicast frame arrives (broadcast does: ARP)
};

// A hub that repeats every frame of one interface on all others, in the weather given; in a thread of its own. The
// kernel's netem would do the same where it is there.
class Hub {
 public:
  // The interfaces must be in the named network namespace.
  Hub(const std::string& netns, const std::vector<std::string>& interfaces, const Weather& weather);
  ~Hub();
  Hub(const Hub&) = delete;
  Hub& operator=(const Hub&) = delete;

  std::string problem() const { return problem_; }  // empty where it works
  std::uint64_t passed() const { return passed_; }
  std::uint64_t lost() const { return lost_; }
  std::uint64_t multicast_refused() const { return multicast_refused_; }

 private:
  void Open(const std::string& netns, const std::vector<std::string>& interfaces);
  void Repeat(const Weather& weather);

  std::string problem_;
  std::vector<int> sockets_;
  std::atomic<bool> stop_ = false;
  std::atomic<std::uint64_t> passed_ = 0;
  std::atomic<std::uint64_t> lost_ = 0;
  std::atomic<std::uint64_t> multicast_refused_ = 0;
  std::thread thread_;
};

}  // namespace rodeira::system_test
