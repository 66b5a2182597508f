// SPDX-License-Identifier: Apache-2.0
#include "launch/rodeira/run/silent_nodes.hpp"

#include <thread>
#include <utility>

#include "launch/rodeira/wall_clock.hpp"

namespace rodeira::cli {

using namespace std::chrono_literals;

SilentNodes::SilentNodes(FateOf fate_of, std::chrono::milliseconds patience)
    : fate_of_(std::move(fate_of)), patience_(patience) {}

bool SilentNodes::Take(std::string_view line) {
  constexpr std::string_view kStart = "silent ";
  if (!line.starts_with(kStart)) return false;
  line.remove_prefix(kStart.size());
  const auto end = line.find(' ');
  if (end == std::string_view::npos) return false;
  const std::string node(line.substr(0, end));
  const auto until = WallClock::now() + patience_;
  auto fate = fate_of_(node);
  while (!fate && WallClock::now() < until) {
    std::this_thread::sleep_for(5ms);
    fate = fate_of_(node);
  }
  if (fate) known_.push_back({std::string(line.substr(end + 1)), *fate});
  return true;
}

std::string SilentNodes::Reworded(std::string line) const {
  for (const Known& known : known_) {
    if (const auto place = line.find(known.sentence); place != std::string::npos)
      line.replace(place, known.sentence.size(), known.fate);
  }
  return line;
}

}  // namespace rodeira::cli
