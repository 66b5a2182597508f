// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <charconv>
#include <optional>
#include <string_view>

#include "common/world/opendrive/read.hpp"

namespace rodeira::opendrive {
namespace {

constexpr std::string_view kTimes = "rodeira:times";  // cycle, green from, green, amber, red with amber; seconds

std::optional<network::LightTimes> TimesOf(std::string_view text) {
  std::array<double, 5> numbers{};
  for (double& number : numbers) {
    text.remove_prefix(std::min(text.find_first_not_of(' '), text.size()));
    const auto [end, problem] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (problem != std::errc()) return std::nullopt;
    text.remove_prefix(static_cast<std::size_t>(end - text.data()));
  }
  if (text.find_first_not_of(' ') != std::string_view::npos) return std::nullopt;
  return network::LightTimes{numbers[0], numbers[1], numbers[2], numbers[3], numbers[4]};
}

}  // namespace

network::Controller ReadController(const Node& controller) {
  network::Controller read;
  read.id = controller.Text("id");
  read.name = controller.Text("name", "");
  for (const Node& control : controller.Children("control"))
    read.controls.push_back({control.Text("signalId"), control.Text("type", "")});
  for (const Node& data : controller.Children("userData")) {
    if (data.Text("code", "") != kTimes) continue;
    read.times = TimesOf(data.Text("value", ""));
    if (!read.times) {
      data.Wrong("rodeira.times",
                 "the times of controller '" + read.id + "' are '" + data.Text("value", "") +
                     "'; five numbers of seconds were expected: cycle, green from, green, amber, red with amber");
    } else if (const char* wrong = network::WrongTimes(*read.times)) {
      data.Wrong("rodeira.times", "the times of controller '" + read.id + "': " + wrong);
      read.times.reset();
    }
  }
  return read;
}

void TakeTurns(network::NetworkSpec& spec, Findings& findings) {
  for (const network::Junction& junction : spec.junctions) {
    std::vector<network::Controller*> turns;
    const bool is_alone = junction.controllers.size() == 1;
    for (const std::string& id : junction.controllers) {
      const auto found =
          std::find_if(spec.controllers.begin(), spec.controllers.end(), [&](const auto& c) { return c.id == id; });
      if (found == spec.controllers.end() || found->times || !ForVehicles(spec, *found)) continue;
      if (is_alone && CrossOnesOwn(spec, *found)) {
        findings.warnings.push_back(
            {"rodeira.times",
             fmt::format("controller {} of junction {} has lights for ways that come from different sides, and says no "
                         "times",
                         found->id, junction.id),
             0,
             "",
             {},
             {},
             {RepairKind::kLightsDark, "its lights stay dark"}});
        continue;
      }
      turns.push_back(&*found);
    }
    constexpr double kTurn_s = kGreen_s + kAmber_s + kAllRed_s;
    for (std::size_t i = 0; i < turns.size(); ++i) {
      turns[i]->times =
          network::LightTimes{kTurn_s * static_cast<double>(turns.size()), kTurn_s * static_cast<double>(i),
                              turns.size() > 1 ? kGreen_s : kTurn_s, kAmber_s, kRedAmber_s};
    }
  }
}

}  // namespace rodeira::opendrive
