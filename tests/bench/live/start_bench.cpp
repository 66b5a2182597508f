// SPDX-License-Identifier: Apache-2.0
// From `rodeira run launch/keyboard.yaml` to a car that can be driven: the throttle is held from the beginning;
// when is the first picture on the display, when does the car move? start_bench [STARTS] [KEY=VALUE …]
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "common/data/record/mcap_reader.hpp"
#include "common/runtime/dds/participant.hpp"
#include "common/runtime/dds/remote_keys.hpp"
#include "idl/codec.hpp"
#include "idl/messages.hpp"
#include "idl/topics.hpp"
#include "tests/bench/live/watched_display.hpp"
#include "tests/system/command.hpp"

namespace {

using namespace rodeira;
using Wall = std::chrono::system_clock;

constexpr std::uint32_t kDomain = 219, kUp = 82;
constexpr std::size_t kColours = 200;  // a window without a picture has a few

[[noreturn]] void Fail(const std::string& why) {
  fmt::print(stderr, "{}\n", why);
  std::exit(1);
}

double Since(Wall::time_point begin) { return std::chrono::duration<double>(Wall::now() - begin).count(); }

// The first step at which the car is seen to move, and the wall's time at which it was granted, seconds after `begin`.
double MovedAfter(const std::filesystem::path& file, Wall::time_point begin) {
  const auto reader = record::McapReader::Open(file);
  if (!reader) Fail(reader.error().Text());
  std::optional<std::int64_t> moved;
  record::Query cars;
  cars.channels = std::set<record::ChannelId>{reader.value().ChannelsOf(idl::topics::kVehicleState).at(0)};
  auto states = reader.value().Messages(cars);
  for (auto message = states.Next(); !moved && message.ok() && message.value(); message = states.Next()) {
    const auto state = idl::Decode<msg::VehicleState>(message.value()->data).value();
    if (state.odometer_m() > 0.01) moved = state.header().step();
  }
  if (!moved) Fail("the car has not moved");
  record::Query walls;
  walls.channels = std::set<record::ChannelId>{reader.value().ChannelsOf(idl::topics::kWallTime).at(0)};
  auto grants = reader.value().Messages(walls);
  for (auto message = grants.Next(); message.ok() && message.value(); message = grants.Next()) {
    const auto grant = idl::Decode<msg::WallTime>(message.value()->data).value();
    if (grant.through_step() < *moved) continue;
    return static_cast<double>(grant.utc_ns() -
                               std::chrono::duration_cast<std::chrono::nanoseconds>(begin.time_since_epoch()).count()) *
           1e-9;
  }
  Fail("no time of that step is in the recording");
}

}  // namespace

int main(int argc, char** argv) {
  const int starts = argc > 1 ? std::atoi(argv[1]) : 20;
  const bench::WatchedDisplay display(98, 1280, 720);
  const auto file = std::filesystem::temp_directory_path() / fmt::format("rodeira-start-bench-{}.mcap", ::getpid());
  std::vector<double> seen_s, moved_s;
  for (int start = 0; start < starts; ++start) {
    const std::string name = fmt::format("start-bench-{}", start);
    std::filesystem::remove(file);
    std::vector<std::string> command{"DISPLAY=" + display.name(),
                                     system_test::Bin("rodeira"),
                                     "run",
                                     system_test::LaunchFile("keyboard.yaml"),
                                     "--run",
                                     name,
                                     "--domain",
                                     std::to_string(kDomain),
                                     "--record",
                                     file.string(),
                                     "--for",
                                     "4"};
    for (int word = 2; word < argc; ++word) command.insert(command.end(), {"--set", argv[word]});
    const auto begin = Wall::now();
    system_test::Started run(command);
    auto participant = dds::Participant::Open({kDomain, name, "a window", launch::Transport::kSharedMemory, {}});
    if (!participant) Fail(participant.error().Text());
    auto keys = dds::OpenKeysSender(*participant.value());
    if (!keys) Fail(keys.error().Text());
    std::optional<double> seen;
    while (!seen || Since(begin) < *seen + 5.0) {
      keys.value()->Say({{kUp, true, 1}});
      if (!seen && display.Colours() > kColours) seen = Since(begin);
      if (Since(begin) > 60.0) Fail("no picture for a minute");
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
    }
    const auto ended = run.Wait();
    if (ended.status != 0) Fail(ended.out);
    seen_s.push_back(*seen);
    moved_s.push_back(MovedAfter(file, begin));
    fmt::print("start {}: picture after {:.2f} s, the car moves after {:.2f} s\n", start + 1, seen_s.back(),
               moved_s.back());
    std::fflush(stdout);
  }
  std::filesystem::remove(file);
  fmt::print("{} starts: picture at worst after {:.2f} s, the car moves at worst after {:.2f} s\n", starts,
             *std::max_element(seen_s.begin(), seen_s.end()), *std::max_element(moved_s.begin(), moved_s.end()));
}
