// SPDX-License-Identifier: Apache-2.0
// The cost of the lockstep itself, as ratios in one run: four processes, all to all, a sample a step each.
//   raw UDP sockets on loopback (the floor), then Rodeira over shared memory and over UDP.
// lockstep_bench [STEPS] [ROUNDS]
#include <arpa/inet.h>
#include <fmt/format.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>
#include <vector>

#include "tests/tree.hpp"

namespace {

using WallClock = std::chrono::steady_clock;
constexpr int kNodes = 4;
constexpr std::size_t kPayload = 44;  // a serialised rodeira::msg::Pulse

struct Socket {
  int descriptor = -1;
  sockaddr_in address{};
};

Socket Bound() {
  Socket made;
  made.descriptor = ::socket(AF_INET, SOCK_DGRAM, 0);
  made.address.sin_family = AF_INET;
  made.address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  socklen_t size = sizeof(made.address);
  if (::bind(made.descriptor, reinterpret_cast<sockaddr*>(&made.address), size) != 0) std::abort();
  ::getsockname(made.descriptor, reinterpret_cast<sockaddr*>(&made.address), &size);
  return made;
}

// One node: sends its sample of the step to the three others, then waits for theirs. A faster node may be a step ahead.
void RawNode(const std::array<Socket, kNodes>& sockets, int self, std::int64_t steps) {
  std::array<std::int64_t, kNodes> newest{};
  newest.fill(-1);
  std::array<char, kPayload> buffer{};
  for (std::int64_t step = 0; step < steps; ++step) {
    std::memcpy(buffer.data(), &step, sizeof(step));
    std::memcpy(buffer.data() + 8, &self, sizeof(self));
    for (int other = 0; other < kNodes; ++other) {
      if (other == self) continue;
      const auto& to = sockets[static_cast<std::size_t>(other)].address;
      if (::sendto(sockets[static_cast<std::size_t>(self)].descriptor, buffer.data(), kPayload, 0,
                   reinterpret_cast<const sockaddr*>(&to), sizeof(to)) < 0)
        std::abort();
    }
    const auto missing = [&] {
      for (int other = 0; other < kNodes; ++other) {
        if (other != self && newest[static_cast<std::size_t>(other)] < step) return true;
      }
      return false;
    };
    while (missing()) {
      std::array<char, kPayload> in{};
      if (::recv(sockets[static_cast<std::size_t>(self)].descriptor, in.data(), kPayload, 0) !=
          static_cast<ssize_t>(kPayload))
        std::abort();
      std::int64_t of = 0;
      int from = 0;
      std::memcpy(&of, in.data(), sizeof(of));
      std::memcpy(&from, in.data() + 8, sizeof(from));
      newest[static_cast<std::size_t>(from)] = std::max(newest[static_cast<std::size_t>(from)], of);
    }
  }
}

double RawRate(std::int64_t steps) {
  std::array<Socket, kNodes> sockets;
  for (Socket& socket : sockets) socket = Bound();
  const auto begin = WallClock::now();
  std::vector<pid_t> children;
  for (int n = 0; n < kNodes; ++n) {
    const pid_t child = ::fork();
    if (child == 0) {
      RawNode(sockets, n, steps);
      ::_exit(0);
    }
    children.push_back(child);
  }
  for (const pid_t child : children) ::waitpid(child, nullptr, 0);
  const double seconds = std::chrono::duration<double>(WallClock::now() - begin).count();
  for (Socket& socket : sockets) ::close(socket.descriptor);
  return static_cast<double>(steps) / seconds;
}

// Steps a wall second between the first grant and the end, and the nodes' wall times from step to step (the mean of the
// medians, the worst 99th percentile), from the closing table.
struct Rate {
  double steps_1ps = 0.0;
  double median_us = 0.0;
  double p99_us = 0.0;
};

Rate RodeiraRate(std::int64_t steps, const std::string& transport) {
  const std::string command =
      fmt::format("{}/bin/rodeira run {}/launch/empty.yaml --no-record --for {} --set transport={}",
                  rodeira::BinaryDir(), rodeira::SourceDir(), static_cast<double>(steps) * 1e-3, transport);
  FILE* pipe = ::popen(command.c_str(), "r");
  std::array<char, 512> line{};
  Rate rate;
  double simulated_s = 0.0;
  double wall_s = 0.0;
  while (std::fgets(line.data(), static_cast<int>(line.size()), pipe) != nullptr) {
    std::sscanf(line.data(), "simulated %lf s in %lf s", &simulated_s, &wall_s);
    double done = 0.0, mean = 0.0, worst = 0.0, apart = 0.0, p99 = 0.0;
    char name[64] = {};
    if (std::sscanf(line.data(), "%63s %lf %lf %lf %lf %lf", name, &done, &mean, &worst, &apart, &p99) == 6) {
      rate.median_us += apart / kNodes;
      rate.p99_us = std::max(rate.p99_us, p99);
    }
    const std::string text(line.data());
    const auto factor = text.find('(');
    if (text.starts_with("simulated") && factor != std::string::npos)
      wall_s = simulated_s / std::strtod(text.c_str() + factor + 1, nullptr);
  }
  if (::pclose(pipe) == 0 && wall_s > 0.0) rate.steps_1ps = simulated_s * 1e3 / wall_s;
  return rate;
}

double Median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

}  // namespace

int main(int argc, char** argv) {
  const std::int64_t steps = argc > 1 ? std::atoll(argv[1]) : 20000;
  const int rounds = argc > 2 ? std::atoi(argv[2]) : 3;
  std::vector<double> raw;
  std::vector<double> shared;
  std::vector<double> udp;
  for (int round = 0; round < rounds; ++round) {
    raw.push_back(RawRate(steps));
    const Rate by_memory = RodeiraRate(steps, "shared_memory");
    const Rate by_udp = RodeiraRate(steps, "udp");
    shared.push_back(by_memory.steps_1ps);
    udp.push_back(by_udp.steps_1ps);
    fmt::print("round {}: raw UDP {:.0f}, shared memory {:.0f} ({:.3f}), UDP {:.0f} ({:.3f}) steps/s\n", round + 1,
               raw.back(), shared.back(), shared.back() / raw.back(), udp.back(), udp.back() / raw.back());
    fmt::print(
        "         step to step: shared memory {:.0f} µs, 99th percentile {:.0f} ({:.1f} x); UDP {:.0f} µs, {:.0f} "
        "({:.1f} x)\n",
        by_memory.median_us, by_memory.p99_us, by_memory.p99_us / by_memory.median_us, by_udp.median_us, by_udp.p99_us,
        by_udp.p99_us / by_udp.median_us);
  }
  fmt::print("median: raw UDP {:.0f} steps/s; shared memory {:.3f}, UDP {:.3f} of it\n", Median(raw),
             Median(shared) / Median(raw), Median(udp) / Median(raw));
}
