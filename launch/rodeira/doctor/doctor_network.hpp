// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "common/core/base/result.hpp"
#include "common/runtime/launch/launch.hpp"
#include "launch/rodeira/doctor/finding.hpp"

// The checks of `rodeira doctor` that look at how processes reach one another.
namespace rodeira::cli {

// The folder exists and a file can be made in it. Too little room for the segments of a run, which then uses smaller
// ones or UDP, is a warning; so are files of Fast DDS that dead processes of this user left there.
Finding CheckSharedMemory(const std::filesystem::path& folder = "/dev/shm", std::uint64_t wanted_bytes = 64'000'000);

// The UDP ports of a domain's first ten participants (RTPS: 7400 + 250 * domain + offset) can be bound. Only a warning:
// Fast DDS takes others, and another program of the same domain is allowed.
Finding CheckPorts(std::uint32_t domain);

// How the check of an exchange is done.
struct LoopBackSettings {
  launch::Transport transport = launch::Transport::kSharedMemory;
  std::uint32_t domain = 0;
  std::uint32_t segment_kib = launch::TransportSettings::kSegmentKib;
  std::string program;  // `rodeira`, which answers in a process of its own
  int round_trips = 500;
  std::chrono::milliseconds patience{3000};  // for each answer
  std::function<bool()> cancelled = [] { return false; };
};
// Times from a question to its answer.
struct LoopBack {
  double median_us = 0.0;
  double worst_percent_us = 0.0;  // 99 of 100 round trips were faster
};
// Two processes exchange a batch of four ground questions and answers. Failed where no answer comes.
base::Result<LoopBack> MeasureLoopBack(const LoopBackSettings& settings);
// What the second process does: answers until its standard input is closed. The exit status comes back.
int AnswerLoopBack(const std::string& run, std::uint32_t domain, launch::Transport transport,
                   std::uint32_t segment_kib);
// Over shared memory with segments for which there is room; a warning where there is none.
Finding CheckLoopBack(const LoopBackSettings& settings);

// The loop-back interface is up, which runs with `recovery: restart` and UDP on one PC need.
Finding CheckLoopBackInterface(const std::vector<std::string>& addresses);

}  // namespace rodeira::cli
