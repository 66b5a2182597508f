// SPDX-License-Identifier: Apache-2.0
#include "common/analysis/measures/drive_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstring>
#include <numbers>

#include "common/analysis/measures/drive_builder.hpp"
#include "common/analysis/measures/message_fields.hpp"
#include "common/core/base/suggest.hpp"
#include "common/data/decode/idl_reader.hpp"
#include "common/data/decode/walk.hpp"
#include "common/data/record/text_number.hpp"

namespace rodeira::measures {
namespace {

constexpr std::string_view kVehicleTopic = "rodeira/vehicle_state", kTrafficTopic = "rodeira/traffic_state",
                           kEventTopic = "rodeira/scenario_events", kRemarkTopic = "rodeira/remarks",
                           kSignalTopic = "rodeira/signals_state";

// The fields of a vehicle's state, in this order.
enum VehicleField {
  kX,
  kY,
  kZ,
  kQw,
  kQx,
  kQy,
  kQz,
  kVx,
  kVy,
  kVz,
  kYawRate,
  kWheel,
  kFuel,
  kThrottle,
  kBrake,
  kLength,
  kFront,
  kWidth,
  kLights,
  kVehicleFields
};
const std::vector<std::string> kVehicleNames{"position_w_m.x",
                                             "position_w_m.y",
                                             "position_w_m.z",
                                             "attitude_wb.w",
                                             "attitude_wb.x",
                                             "attitude_wb.y",
                                             "attitude_wb.z",
                                             "velocity_w_mps.x",
                                             "velocity_w_mps.y",
                                             "velocity_w_mps.z",
                                             "angular_velocity_b_radps.z",
                                             "steering_wheel_rad",
                                             "fuel_used_kg",
                                             "throttle",
                                             "brake",
                                             "length_m",
                                             "front_m",
                                             "width_m",
                                             "lights"};
// Of an agent.
enum AgentField {
  kAgentId,
  kAgentX,
  kAgentY,
  kAgentZ,
  kAgentSpeed,
  kAgentHeading,
  kAgentLength,
  kAgentWidth,
  kAgentKind,
  kAgentLights
};
const std::vector<std::string> kAgentNames{"id",          "position_x_m", "position_y_m", "position_z_m", "speed_mps",
                                           "heading_rad", "length_m",     "width_m",      "kind",         "lights"};
constexpr double kPedestrian = 4.0;

double IndicatorOf(double lights) {
  const auto bits = static_cast<unsigned>(lights);
  return ((bits & 2u) != 0 ? 1.0 : 0.0) + ((bits & 4u) != 0 ? 2.0 : 0.0);
}

std::string EntryOf(const record::TextMap& map, const char* key) {
  const auto found = map.find(key);
  return found == map.end() ? std::string() : found->second;
}

base::Status TakeEvent(const decode::Type& type, const record::Message& message, DriveEvent::Kind kind,
                       std::vector<DriveEvent>& events) {
  const auto entries = decode::Flatten(type, message.data);
  if (!entries) return entries.error();
  std::string remark;
  DriveEvent event{kind, static_cast<double>(message.log_time_ns) * 1e-9, {}, {}};
  for (const decode::Entry& entry : entries.value()) {
    const auto* text = std::get_if<std::string>(&entry.value);
    const auto* whole = std::get_if<std::int64_t>(&entry.value);
    if (whole != nullptr && (entry.path == "time_ns" || entry.path == "header.time_ns"))
      event.time_s = static_cast<double>(*whole) * 1e-9;
    if (text == nullptr) continue;
    if (entry.path == "kind") remark = *text;
    if (entry.path == "text") event.name = *text;
    if (entry.path.ends_with("].name")) event.name = *text;
    if (entry.path.ends_with("].argument")) {
      event.argument = *text;
      events.push_back(event);
    }
  }
  if (kind == DriveEvent::Kind::kMark && remark == "mark") events.push_back(event);
  return {};
}

// The channels of a recording that a drive is made of.
class DriveChannels {
 public:
  base::Status Open(const record::McapReader& reader, const DriveQuery& query);
  // Handles one message; wrong input where it is not what its schema says.
  base::Status Take(const record::Message& message, DriveBuilder& builder, std::vector<DriveEvent>& events);

  double rate_hz() const { return 1e9 / (static_cast<double>(grid_steps_) * static_cast<double>(base_step_ns_)); }
  bool has_traffic() const { return !traffic_.empty(); }
  const std::string& subject() const { return subject_; }

 private:
  struct Numbers {
    decode::TypePtr type;
    MessageFields fields;
    std::int64_t vehicle = 0;  // number of the vehicle, from 1
  };
  base::Status ChooseSubject(const DriveQuery& query, const std::vector<std::string>& vehicles);
  // The grid sample of a message; nothing where it lies between two.
  std::optional<std::size_t> SampleOf(const record::Message& message) const;
  void TakeVehicle(std::size_t k, const Numbers& numbers, DriveBuilder& builder);
  base::Status TakeTraffic(std::size_t k, const Numbers& numbers, const record::Message& message,
                           DriveBuilder& builder);

  std::int64_t base_step_ns_ = 0, grid_steps_ = 0;
  std::string subject_;
  std::optional<std::int64_t> agent_;  // the subject is this one
  std::int64_t vehicle_ = 0;           // or this vehicle, by number
  std::map<record::ChannelId, Numbers> vehicles_, traffic_, signals_;
  std::map<record::ChannelId, decode::TypePtr> events_, remarks_;
  std::vector<double> values_ = std::vector<double>(kVehicleFields);
  double last_agent_heading_ = kMissing;
  std::size_t last_agent_sample_ = 0;
};

base::Status DriveChannels::ChooseSubject(const DriveQuery& query, const std::vector<std::string>& vehicles) {
  constexpr std::string_view kAgent = "agent:";
  if (query.subject.starts_with(kAgent)) {
    const std::string_view digits = std::string_view(query.subject).substr(kAgent.size());
    std::int64_t id = 0;
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), id);
    if (error != std::errc() || end != digits.data() + digits.size() || id < 0)
      return base::WrongInput("measure.wrong_subject",
                              fmt::format("'{}' is no agent; 'agent:7' was expected", query.subject));
    if (traffic_.empty())
      return base::WrongInput("measure.wrong_subject", "the recording has no traffic, so it has no agent");
    agent_ = id;
    subject_ = fmt::format("agent:{}", id);
    return {};
  }
  if (vehicles.empty())
    return base::WrongInput("measure.unknown_vehicle",
                            "the recording has no driven vehicle; an agent of its traffic is named 'agent:7'");
  const auto found = query.subject.empty() ? vehicles.begin() : std::ranges::find(vehicles, query.subject);
  if (found == vehicles.end()) {
    return base::WrongInput("measure.unknown_vehicle", fmt::format("the recording has no vehicle '{}'{}", query.subject,
                                                                   base::DidYouMean(query.subject, vehicles)));
  }
  vehicle_ = found - vehicles.begin() + 1;
  subject_ = *found;
  return {};
}

base::Status DriveChannels::Open(const record::McapReader& reader, const DriveQuery& query) {
  const auto about = reader.FindMetadata("rodeira");
  if (!about) return about.error();
  const auto base_step = about.value() ? record::WholeNumber(about.value()->entries, "base_step_ns") : std::nullopt;
  if (!base_step || *base_step <= 0)
    return base::WrongInput("recording.not_of_rodeira",
                            "this is no recording of Rodeira: its metadata 'rodeira' has no base_step_ns");
  base_step_ns_ = *base_step;
  std::vector<std::string> vehicles;
  std::map<std::int64_t, std::int64_t> periods;  // of the vehicles, by number
  std::int64_t traffic_period = 1;
  for (const auto& [id, channel] : reader.channels()) {
    const std::string topic(query.aliases == nullptr ? channel.topic : query.aliases->Topic(channel.topic));
    const bool wanted = topic == kVehicleTopic || topic == kTrafficTopic || topic == kEventTopic ||
                        topic == kRemarkTopic || topic == kSignalTopic;
    const auto schema = reader.schemas().find(channel.schema);
    if (!wanted || schema == reader.schemas().end()) continue;
    auto type = decode::ReadType(schema->second.text, schema->second.name);
    if (!type) return type.error();
    if (query.aliases != nullptr) type = query.aliases->Renamed(type.value());
    const std::int64_t period =
        std::max<std::int64_t>(1, record::WholeNumber(channel.metadata, "period_steps").value_or(1));
    const auto named = [&topic](const base::Error& error) { return error.WithContext("topic " + topic); };
    if (topic == kVehicleTopic) {
      auto fields = MessageFields::Make(*type.value(), kVehicleNames);
      if (!fields) return named(fields.error());
      vehicles.push_back(EntryOf(channel.metadata, "source"));
      const auto number = static_cast<std::int64_t>(vehicles.size());
      vehicles_.emplace(id, Numbers{type.value(), std::move(fields).value(), number});
      periods[number] = period;
    } else if (topic == kTrafficTopic) {
      auto fields = MessageFields::Make(*type.value(), {}, "agents", kAgentNames);
      if (!fields) return named(fields.error());
      traffic_.emplace(id, Numbers{type.value(), std::move(fields).value()});
      traffic_period = period;
    } else if (topic == kSignalTopic) {
      auto fields = MessageFields::Make(*type.value(), {}, "groups", {"controller", "colour"});
      if (!fields) return named(fields.error());
      signals_.emplace(id, Numbers{type.value(), std::move(fields).value()});
    } else {
      (topic == kEventTopic ? events_ : remarks_).emplace(id, type.value());
    }
  }
  if (auto status = ChooseSubject(query, vehicles); !status) return status;
  const std::int64_t own = agent_ ? traffic_period : periods[vehicle_];
  constexpr std::int64_t kGrid_ns = 10'000'000;
  grid_steps_ = std::max<std::int64_t>(1, (kGrid_ns + own * base_step_ns_ - 1) / (own * base_step_ns_)) * own;
  return {};
}

std::optional<std::size_t> DriveChannels::SampleOf(const record::Message& message) const {
  constexpr std::size_t kStepAt = 4;  // the first member of the header, behind the encapsulation
  std::int64_t step = 0;
  if (message.data.size() < kStepAt + sizeof(step)) return std::nullopt;
  std::memcpy(&step, message.data.data() + kStepAt, sizeof(step));
  constexpr std::int64_t kMaxSamples = std::int64_t{1} << 26;  // a week at 100 Hz: what is later is damage
  if (step < 0 || step % grid_steps_ != 0 || step / grid_steps_ > kMaxSamples) return std::nullopt;
  return static_cast<std::size_t>(step / grid_steps_);
}

void DriveChannels::TakeVehicle(std::size_t k, const Numbers& numbers, DriveBuilder& builder) {
  const std::vector<double>& v = values_;
  const AlongBody along = AlongBodyOf(v[kQw], v[kQx], v[kQy], v[kQz], v[kVx], v[kVy], v[kVz]);
  if (numbers.vehicle != vehicle_ || agent_) {
    builder.AddOthers(
        k,
        {{-numbers.vehicle, v[kX], v[kY], v[kZ], along.speed_mps, v[kLength], v[kFront], along.heading_rad, v[kWidth]}},
        false);
    return;
  }
  builder.SetFootprint(v[kLength], v[kFront], v[kWidth]);
  builder.AddSubject(k, {v[kX], v[kY], v[kZ], along.heading_rad, along.speed_mps, v[kYawRate], v[kThrottle], v[kBrake],
                         v[kWheel] * 180.0 / std::numbers::pi, IndicatorOf(v[kLights]), v[kFuel]});
}

base::Status DriveChannels::TakeTraffic(std::size_t k, const Numbers& numbers, const record::Message& message,
                                        DriveBuilder& builder) {
  std::vector<OtherVehicle> others;
  const bool whole = numbers.fields.Read(message.data, {}, [&](std::span<const double> a) {
    if (agent_ && a[kAgentId] == static_cast<double>(*agent_)) {
      builder.SetFootprint(a[kAgentLength], 0.5 * a[kAgentLength], a[kAgentWidth]);
      SubjectSample sample{a[kAgentX], a[kAgentY], a[kAgentZ], a[kAgentHeading], a[kAgentSpeed]};
      if (last_agent_sample_ + 1 == k) {
        const double turned = std::remainder(a[kAgentHeading] - last_agent_heading_, 2.0 * std::numbers::pi);
        sample.yaw_radps = turned * rate_hz();
      }
      last_agent_sample_ = k;
      last_agent_heading_ = a[kAgentHeading];
      sample.indicator = IndicatorOf(a[kAgentLights]);
      builder.AddSubject(k, sample);
      return;
    }
    if (a[kAgentKind] == kPedestrian) return;
    others.push_back({static_cast<std::int64_t>(a[kAgentId]), a[kAgentX], a[kAgentY], a[kAgentZ], a[kAgentSpeed],
                      a[kAgentLength], 0.5 * a[kAgentLength], a[kAgentHeading], a[kAgentWidth]});
  });
  if (!whole)
    return base::WrongInput("message.damaged",
                            "a message of traffic_state ends early; `rodeira info` says what is damaged");
  builder.AddOthers(k, others, true);
  return {};
}

base::Status DriveChannels::Take(const record::Message& message, DriveBuilder& builder,
                                 std::vector<DriveEvent>& events) {
  if (const auto vehicle = vehicles_.find(message.channel); vehicle != vehicles_.end()) {
    const auto k = SampleOf(message);
    if (!k) return {};
    if (!vehicle->second.fields.Read(message.data, values_))
      return base::WrongInput("message.damaged",
                              "a message of vehicle_state ends early; `rodeira info` says what is damaged");
    TakeVehicle(*k, vehicle->second, builder);
  } else if (const auto traffic = traffic_.find(message.channel); traffic != traffic_.end()) {
    const auto k = SampleOf(message);
    if (k) return TakeTraffic(*k, traffic->second, message, builder);
  } else if (const auto signals = signals_.find(message.channel); signals != signals_.end()) {
    const auto k = SampleOf(message);
    if (!k) return {};
    const bool whole = signals->second.fields.Read(message.data, {}, [&](std::span<const double> group) {
      builder.AddLight(*k, static_cast<std::uint32_t>(group[0]), group[1]);
    });
    if (!whole)
      return base::WrongInput("message.damaged",
                              "a message of signals_state ends early; `rodeira info` says what is damaged");
  } else if (const auto event = events_.find(message.channel); event != events_.end()) {
    constexpr std::size_t kCountAt = 36;  // behind encapsulation and header; most samples have no event
    std::uint32_t count = 0;
    if (message.data.size() < kCountAt + sizeof(count)) return {};
    std::memcpy(&count, message.data.data() + kCountAt, sizeof(count));
    if (count != 0) return TakeEvent(*event->second, message, DriveEvent::Kind::kScenario, events);
  } else if (const auto remark = remarks_.find(message.channel); remark != remarks_.end()) {
    return TakeEvent(*remark->second, message, DriveEvent::Kind::kMark, events);
  }
  return {};
}

}  // namespace

base::Result<DriveReading> ReadDrive(const record::McapReader& reader, const network::Network* network,
                                     const DriveQuery& query) {
  DriveChannels channels;
  if (auto status = channels.Open(reader, query); !status) return status.error();
  DriveBuilder builder(network, channels.rate_hz());
  if (channels.has_traffic()) builder.ExpectTraffic();
  DriveReading reading;
  record::Query all;
  all.order = record::Query::Order::kFile;
  auto cursor = reader.Messages(all);
  const double last = std::max(1.0, static_cast<double>(reader.statistics().last_log_time_ns));
  for (std::uint64_t count = 0;; ++count) {
    const auto message = cursor.Next();
    if (!message) return message.error();
    if (!message.value()) break;
    if (query.on_message) query.on_message(reader.channels().at(message.value()->channel), *message.value());
    if (auto status = channels.Take(*message.value(), builder, reading.events); !status) return status.error();
    constexpr std::uint64_t kMessages = 1 << 14;
    const double share = std::min(1.0, static_cast<double>(message.value()->log_time_ns) / last);
    if (count % kMessages == 0 && query.progress && !query.progress(share))
      return base::Failed("run.interrupted", "cancelled");
  }
  if (!builder.has_subject())
    return base::WrongInput("recording.sample_missing",
                            fmt::format("the recording has no sample of {}", channels.subject()));
  reading.drive = builder.Finish();
  reading.drive.subject = channels.subject();
  std::ranges::stable_sort(reading.events, {}, &DriveEvent::time_s);
  return reading;
}

base::Result<std::vector<DriveEvent>> ReadEvents(const record::McapReader& reader, const decode::Aliases& aliases) {
  std::map<record::ChannelId, std::pair<decode::TypePtr, DriveEvent::Kind>> channels;
  record::Query query;
  query.channels.emplace();
  for (const auto& [id, channel] : reader.channels()) {
    const std::string topic(aliases.Topic(channel.topic));
    const auto schema = reader.schemas().find(channel.schema);
    if ((topic != kEventTopic && topic != kRemarkTopic) || schema == reader.schemas().end()) continue;
    const auto type = decode::ReadType(schema->second.text, schema->second.name);
    if (!type) return type.error().In("topic " + topic);
    const auto kind = topic == kEventTopic ? DriveEvent::Kind::kScenario : DriveEvent::Kind::kMark;
    channels.emplace(id, std::pair(aliases.Renamed(type.value()), kind));
    query.channels->insert(id);
  }
  std::vector<DriveEvent> events;
  if (channels.empty()) return events;
  auto cursor = reader.Messages(query);
  while (true) {
    const auto message = cursor.Next();
    if (!message) return message.error();
    if (!message.value()) break;
    const auto& [type, kind] = channels.at(message.value()->channel);
    if (auto status = TakeEvent(*type, *message.value(), kind, events); !status) return status.error();
  }
  std::ranges::stable_sort(events, {}, &DriveEvent::time_s);
  return events;
}

}  // namespace rodeira::measures
