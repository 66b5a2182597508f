// SPDX-License-Identifier: Apache-2.0
#include "launch/rodeira/replay/recorded_view.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <functional>
#include <optional>
#include <set>

#include "common/core/base/suggest.hpp"
#include "common/driving/scenario/event.hpp"
#include "idl/codec.hpp"
#include "idl/messages.hpp"
#include "idl/topics.hpp"

namespace rodeira::cli {
namespace {

namespace topics = idl::topics;
using lockstep::Step;

constexpr std::size_t kLongestNote = 60;  // bytes of a mark's text on the bar
constexpr double kViewPeriod_s = 0.02;    // of a run that had no view

std::optional<lockstep::NodeIndex> ViewOf(const lockstep::Roster& roster) {
  for (lockstep::NodeIndex n = 0; n < roster.nodes().size(); ++n) {
    if (roster.node(n).kind == "view") return n;
  }
  return std::nullopt;
}

void AddSource(const lockstep::Roster& roster, lockstep::SourceIndex source, Seen& seen) {
  const std::string& topic = roster.source(source).topic;
  if (topic == topics::kVehicleState) seen.cars.push_back(source);
  if (topic == topics::kVehicleState || topic == topics::kTrafficState || topic == topics::kTrafficDetails ||
      topic == topics::kSignalsState || topic == topics::kWeatherState)
    seen.sources.push_back(source);
}

// "1280x720"
base::Status TakeSize(const std::string& text, nodes::ViewSettings& settings) {
  const char* end = text.data() + text.size();
  const auto [cross, first] = std::from_chars(text.data(), end, settings.width_px);
  const bool crossed = first == std::errc{} && cross != end && *cross == 'x';
  const auto [rest, second] = crossed ? std::from_chars(cross + 1, end, settings.height_px)
                                      : std::from_chars_result{cross, std::errc::invalid_argument};
  const bool good = second == std::errc{} && rest == end && settings.width_px >= 64 && settings.width_px <= 7680 &&
                    settings.height_px >= 64 && settings.height_px <= 4320;
  if (good) return {};
  return base::WrongInput(
      "command.wrong_value",
      fmt::format("'{}' was found; WIDTHxHEIGHT in pixels was expected, from 64x64 to 7680x4320", text), "--size");
}

base::Status ApplyOptions(const lockstep::Roster& roster, const WatchOptions& options, Seen& seen) {
  if (options.camera) {
    const auto camera = scene::CameraOf(*options.camera);
    if (!camera) {
      const auto names = scene::CameraNames();
      return base::WrongInput("command.wrong_value",
                              fmt::format("'{}' was found; {} was expected{}", *options.camera, fmt::join(names, ", "),
                                          base::DidYouMean(*options.camera, {names.begin(), names.end()})),
                              "--camera");
    }
    seen.settings.camera = *camera;
  }
  if (options.quality) {
    const auto names = nodes::QualityNames();
    seen.settings.quality = nodes::QualityOf(*options.quality);
    if (!seen.settings.quality) {
      return base::WrongInput("command.wrong_value",
                              fmt::format("'{}' was found; {} was expected{}", *options.quality, fmt::join(names, ", "),
                                          base::DidYouMean(*options.quality, {names.begin(), names.end()})),
                              "--quality");
    }
  }
  if (options.follow) {
    const auto followed = nodes::FindFollowed(roster, seen.cars, *options.follow);
    if (!followed) return followed.error().WithContext("--follow");
    seen.settings.followed = followed.value();
  }
  return options.size ? TakeSize(*options.size, seen.settings) : base::Status();
}

std::string Shortened(std::string text) {
  text = base::Printable(text);
  if (text.size() <= kLongestNote) return text;
  std::size_t cut = kLongestNote;
  while (cut > 0 && (static_cast<unsigned char>(text[cut]) & 0xC0U) == 0x80U) --cut;  // not within a character
  return text.substr(0, cut) + "...";
}

// Calls `take` for each message of a topic, in the order of the file, until `stop`.
template <class Message>
base::Status ForEachOf(const replay::RecordedRun& run, std::string_view topic, const std::function<bool()>& stop,
                       const std::function<void(const Message&, std::int64_t time_ns)>& take) {
  const auto channels = run.ChannelsOf(topic);
  if (channels.empty()) return {};
  if (auto status = run.CheckTypes({topic}); !status) return status;
  record::Query query;
  query.channels.emplace(channels.begin(), channels.end());
  auto cursor = run.reader().Messages(query);
  while (!stop || !stop()) {
    const auto message = cursor.Next();
    if (!message) return message.error();
    if (!message.value()) return {};
    const auto said = idl::Decode<Message>(message.value()->data);
    if (!said) return said.error().In(run.path().string());
    take(said.value(), static_cast<std::int64_t>(message.value()->log_time_ns));
  }
  return {};
}

// Numbers among the words with six digits: for eyes.
std::string Rounded(const std::string& words) {
  std::string out;
  for (std::size_t at = 0; at < words.size();) {
    const std::size_t end = std::min(words.find(' ', at), words.size());
    const std::string word = words.substr(at, end - at);
    double number = 0.0;
    const auto [rest, problem] = std::from_chars(word.data(), word.data() + word.size(), number);
    out += (out.empty() ? "" : " ") +
           (problem == std::errc{} && rest == word.data() + word.size() ? fmt::format("{:g}", number) : word);
    at = end + 1;
  }
  return out;
}

// "weather rain 8", "traffic.brake ahead 4", "traffic.change_lane 3 left"; of a person's text only that.
std::string EventText(const msg::ScenarioEvent& event) {
  if (event.name() == scenario::kMark) return Shortened(event.argument());
  const std::string argument = event.argument().empty() ? "" : " " + Rounded(event.argument());
  const scenario::EventKind* kind = scenario::FindEventKind(event.name());
  std::string value = event.value() != 0.0 ? fmt::format(" {:g}", event.value()) : "";
  if (kind != nullptr && kind->value == scenario::ValueKind::kSide) value = event.value() > 0.0 ? " left" : " right";
  return Shortened(event.name() + argument + value);
}

}  // namespace

base::Result<Seen> LookAt(const replay::RecordedRun& run, const WatchOptions& options) {
  const auto& roster = run.roster();
  Seen seen;
  if (const auto view = ViewOf(roster)) {
    auto settings = nodes::ReadWindowSettings(run.launch(), *view);
    if (!settings) return run.Named(settings.error());
    seen.settings = std::move(settings).value();
    seen.period = roster.node(*view).period;
    for (const lockstep::Port& port : roster.node(*view).inputs) {
      for (const lockstep::SourceIndex source : port.sources) AddSource(roster, source, seen);
    }
  } else {
    seen.period = std::max<Step>(1, std::llround(kViewPeriod_s * 1e9 / static_cast<double>(roster.base_step_ns())));
    for (lockstep::SourceIndex source = 0; source < roster.sources().size(); ++source) AddSource(roster, source, seen);
    for (const lockstep::SourceIndex car : seen.cars) {
      if (auto autopilot = nodes::AutopilotOf(run.launch(), roster.source(car).node))
        seen.settings.autopilots[car] = std::move(*autopilot);
    }
  }
  if (seen.sources.empty())
    return base::WrongInput("replay.nothing_to_see",
                            "the recording has neither a car nor traffic: there is nothing to see",
                            run.path().string());
  std::set<std::string_view> topics;
  for (const lockstep::SourceIndex source : seen.sources) topics.insert(roster.source(source).topic);
  if (auto status = run.CheckTypes(topics); !status) return status.error();
  if (auto status = ApplyOptions(roster, options, seen); !status) return status.error();
  return seen;
}

base::Result<std::vector<nodes::ReplayMark>> MarksOf(const replay::RecordedRun& run,
                                                     const std::function<bool()>& stop) {
  std::vector<nodes::ReplayMark> marks;
  auto status = ForEachOf<msg::Remark>(run, topics::kRemarks, stop, [&](const msg::Remark& remark, std::int64_t) {
    if (remark.kind() != "mark" && remark.kind() != "fault") return;
    marks.push_back({std::max<std::int64_t>(remark.time_ns(), 0),
                     Shortened(remark.text().empty() ? remark.kind() : remark.text())});
  });
  if (!status) return status.error();
  status = ForEachOf<msg::ScenarioEvents>(run, topics::kScenarioEvents, stop,
                                          [&](const msg::ScenarioEvents& events, std::int64_t time_ns) {
                                            for (const msg::ScenarioEvent& event : events.events())
                                              marks.push_back({time_ns, EventText(event), nodes::MarkKind::kEvent});
                                          });
  if (!status) return status.error();
  std::ranges::stable_sort(marks, {}, &nodes::ReplayMark::time_ns);
  return marks;
}

}  // namespace rodeira::cli
