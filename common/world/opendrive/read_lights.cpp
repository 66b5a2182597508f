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

}  // namespace rodeira::opendrive
