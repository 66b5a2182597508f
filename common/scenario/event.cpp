#include "common/scenario/event.hpp"

#include <algorithm>
#include <array>
#include <charconv>

namespace rodeira::scenario {
namespace {

constexpr std::uint32_t kMostAgents = 100'000;

constexpr std::array kKinds = std::to_array<EventKind>({
    {kMark, "text", false, "", 0.0, 0.0},
    {kTrafficBrake, "agent", true, "deceleration_mps2", 0.1, 10.0},
    {kTrafficSpeed, "agent", true, "speed_mps", 0.5, 100.0},
    {kTrafficRelease, "agent", true, "", 0.0, 0.0},
});

}  // namespace

std::span<const EventKind> EventKinds() { return kKinds; }

const EventKind* FindEventKind(std::string_view name) {
  const auto found = std::find_if(kKinds.begin(), kKinds.end(), [name](const EventKind& kind) { return kind.name == name; });
  return found == kKinds.end() ? nullptr : &*found;
}

base::Result<AgentChoice> ParseAgent(std::string_view text) {
  if (text == "all") return AgentChoice{AgentChoice::Kind::kAll, 0};
  if (text == "ahead") return AgentChoice{AgentChoice::Kind::kAhead, 0};
  std::uint32_t id = 0;
  const auto [end, problem] = std::from_chars(text.data(), text.data() + text.size(), id);
  if (problem != std::errc{} || end != text.data() + text.size() || id >= kMostAgents) {
    return base::WrongInput("'" + std::string(text.substr(0, 40)) + "' is no agent; its number, all or ahead was expected");
  }
  return AgentChoice{AgentChoice::Kind::kOne, id};
}

}  // namespace rodeira::scenario
