// SPDX-License-Identifier: Apache-2.0
#include "common/analysis/floating_cars/write_floating_cars.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "common/analysis/measures/lane_finder.hpp"
#include "common/analysis/measures/message_fields.hpp"
#include "common/data/csv/csv_file.hpp"
#include "common/data/csv/workplace.hpp"
#include "common/data/decode/idl_reader.hpp"
#include "common/data/record/text_number.hpp"
#include "common/world/lanes/floating_car.hpp"

namespace rodeira::floating_cars {
namespace {

constexpr double kRate_hz = 10.0;
constexpr std::string_view kVehicleTopic = "rodeira/vehicle_state", kTrafficTopic = "rodeira/traffic_state";

enum VehicleField { kX, kY, kZ, kQw, kQx, kQy, kQz, kVx, kVy, kVz, kFront, kVehicleFields };
const std::vector<std::string> kVehicleNames{
    "position_w_m.x", "position_w_m.y",   "position_w_m.z",   "attitude_wb.w",    "attitude_wb.x", "attitude_wb.y",
    "attitude_wb.z",  "velocity_w_mps.x", "velocity_w_mps.y", "velocity_w_mps.z", "front_m"};
enum AgentField { kId, kTrip, kAgentX, kAgentY, kAgentZ, kSpeed, kHeading, kPitch, kLength, kKind };
const std::vector<std::string> kAgentNames{"id",        "trip",        "position_x_m", "position_y_m", "position_z_m",
                                           "speed_mps", "heading_rad", "pitch_rad",    "length_m",     "kind"};
constexpr std::array<std::string_view, 5> kKinds{"car", "van", "lorry", "bus", ""};

// One topic of one source.
struct Channel {
  decode::TypePtr type;
  measures::MessageFields fields;
  std::string source;
  bool traffic = false;
  std::optional<std::int64_t> timestep;  // of the newest sample that was written
};

// What one timestep has.
class Timestep {
 public:
  explicit Timestep(const network::Network* network) {
    if (network == nullptr) return;
    graph_.emplace(*network);
    finder_.emplace(*graph_);
  }

  void AddVehicle(const std::string& name, std::span<const double> v) {
    const double qw = v[kQw], qx = v[kQx], qy = v[kQy], qz = v[kQz];
    const double ax = 1.0 - 2.0 * (qy * qy + qz * qz), ay = 2.0 * (qx * qy + qw * qz), az = 2.0 * (qx * qz - qw * qy);
    Add({.id = name,
         .kind = kKinds[0],
         .front_x_m = v[kX] + v[kFront] * ax,
         .front_y_m = v[kY] + v[kFront] * ay,
         .heading_rad = std::atan2(ay, ax),
         .pitch_up_rad = std::asin(std::clamp(az, -1.0, 1.0)),
         .speed_mps = v[kVx] * ax + v[kVy] * ay + v[kVz] * az},
        {v[kX], v[kY], v[kZ]}, v[kFront]);
  }

  void AddAgent(std::span<const double> a) {
    const auto kind = static_cast<std::size_t>(a[kKind]);
    const bool person = kind + 1 >= kKinds.size();
    const double front_m = person ? 0.0 : 0.5 * a[kLength];
    const double level_m = front_m * std::cos(a[kPitch]);
    Add({.id = fmt::format("{:.0f}.{:.0f}", a[kId], a[kTrip]),
         .kind = kKinds[std::min(kind, kKinds.size() - 1)],
         .front_x_m = a[kAgentX] + level_m * std::cos(a[kHeading]),
         .front_y_m = a[kAgentY] + level_m * std::sin(a[kHeading]),
         .heading_rad = a[kHeading],
         .pitch_up_rad = -a[kPitch],
         .speed_mps = a[kSpeed]},
        {a[kAgentX], a[kAgentY], a[kAgentZ]}, front_m);
  }

  // The timestep as text; it is empty then.
  void MoveTo(double time_s, std::string& text, FloatingCarsReport& report) {
    lanes::AppendTimestepBegin(time_s, text);
    for (const lanes::FloatingCar& car : cars_) {
      lanes::AppendFloatingCar(car, text);
      ++(car.kind.empty() ? report.persons : report.vehicles);
    }
    text += lanes::kTimestepEnd;
    ++report.timesteps;
    cars_.clear();
  }

 private:
  void Add(lanes::FloatingCar car, const Eigen::Vector3d& p_WB_W, double front_m) {
    if (finder_ && !car.kind.empty()) {
      network::Hint& hint = hints_[car.id];
      if (const auto place = finder_->Find(p_WB_W.x(), p_WB_W.y(), p_WB_W.z(), car.heading_rad, hint);
          place && place->track >= 0) {
        car.lane = lanes::SumoLaneOf(*graph_, static_cast<std::uint32_t>(place->track));
        car.lane_front_m = place->along_m + front_m;
      }
    }
    cars_.push_back(std::move(car));
  }

  std::optional<lanes::Graph> graph_;
  std::optional<measures::LaneFinder> finder_;
  std::map<std::string, network::Hint> hints_;
  std::vector<lanes::FloatingCar> cars_;
};

class Writer {
 public:
  Writer(const record::McapReader& reader, const FloatingCarsQuery& query)
      : reader_(reader), query_(query), timestep_(query.network) {}

  base::Result<FloatingCarsReport> Write(const std::filesystem::path& target) {
    if (auto status = Open(); !status) return status.error();
    auto times = csv::TimesOf(query_.selection, reader_);
    if (!times) return times.error();
    csv::Workplace workplace(target);
    if (auto status = workplace.Begin(); !status) return status.error();
    constexpr const char* kName = "floating_cars.xml";
    auto file = csv::CsvFile::Create(workplace.path() / kName);
    if (!file) return file.error();
    file.value().buffer() += lanes::kFloatingCarsBegin;
    if (auto status = Copy(std::move(times).value(), file.value()); !status) return status.error();
    file.value().buffer() += lanes::kFloatingCarsEnd;
    if (auto status = file.value().Close(); !status) return status.error();
    report_.bytes = file.value().written_bytes();
    if (auto status = workplace.Finish(kName); !status) return status.error();
    return report_;
  }

 private:
  base::Status Open() {
    const auto about = reader_.FindMetadata("rodeira");
    if (!about) return about.error();
    const auto base_step = about.value() ? record::WholeNumber(about.value()->entries, "base_step_ns") : std::nullopt;
    if (!base_step || *base_step <= 0)
      return base::WrongInput("recording.not_of_rodeira",
                              "this is no recording of Rodeira: its metadata 'rodeira' has no base_step_ns");
    const double rate_hz = query_.selection.rate_hz > 0.0 ? query_.selection.rate_hz : kRate_hz;
    period_ns_ = std::llround(1e9 / rate_hz);
    for (const auto& [id, channel] : reader_.channels()) {
      const std::string topic(query_.aliases == nullptr ? channel.topic : query_.aliases->Topic(channel.topic));
      const auto schema = reader_.schemas().find(channel.schema);
      if ((topic != kVehicleTopic && topic != kTrafficTopic) || schema == reader_.schemas().end()) continue;
      auto type = decode::ReadType(schema->second.text, schema->second.name);
      if (!type) return type.error();
      if (query_.aliases != nullptr) type = query_.aliases->Renamed(type.value());
      const bool traffic = topic == kTrafficTopic;
      auto fields = traffic ? measures::MessageFields::Make(*type.value(), {}, "agents", kAgentNames)
                            : measures::MessageFields::Make(*type.value(), kVehicleNames);
      if (!fields) return fields.error().WithContext("topic " + topic);
      const auto source = channel.metadata.find("source");
      channels_.emplace(
          id, Channel{type.value(), std::move(fields).value(),
                      source == channel.metadata.end() ? std::string() : source->second, traffic, std::nullopt});
      const std::int64_t steps = record::WholeNumber(channel.metadata, "period_steps").value_or(1);
      period_ns_ = std::max(period_ns_, steps * *base_step);
    }
    if (channels_.empty())
      return base::WrongInput("table.no_vehicle",
                              "the recording has neither a driven vehicle nor traffic: there are no floating cars");
    report_.period_s = 1e-9 * static_cast<double>(period_ns_);
    return {};
  }

  base::Status Copy(record::Query query, csv::CsvFile& file) {
    query.channels.emplace();
    for (const auto& [id, channel] : channels_) query.channels->insert(id);
    auto cursor = reader_.Messages(query);
    const double last = std::max(1.0, static_cast<double>(reader_.statistics().last_log_time_ns));
    for (std::uint64_t count = 0;; ++count) {
      const auto message = cursor.Next();
      if (!message) return message.error();
      if (!message.value()) break;
      constexpr std::uint64_t kMessages = 1 << 12;
      const double share = std::min(1.0, static_cast<double>(message.value()->log_time_ns) / last);
      if (count % kMessages == 0 && query_.progress && !query_.progress(share))
        return base::Failed("run.interrupted", "cancelled");
      if (auto status = Take(*message.value(), file); !status) return status;
    }
    Flush(file);
    return {};
  }

  base::Status Take(const record::Message& message, csv::CsvFile& file) {
    Channel& channel = channels_.at(message.channel);
    const auto now = static_cast<std::int64_t>(message.log_time_ns) / period_ns_;
    if (channel.timestep && now <= *channel.timestep) return {};
    if (!csv::Holds(query_.selection, 1e-9 * static_cast<double>(message.log_time_ns))) return {};
    channel.timestep = now;
    if (now != now_) {
      Flush(file);
      now_ = now;
      if (auto status = file.Drain(); !status) return status;
    }
    std::array<double, kVehicleFields> values{};
    const bool whole =
        channel.fields.Read(message.data, values, [this](std::span<const double> agent) { timestep_.AddAgent(agent); });
    if (!whole) return base::WrongInput("message.damaged", "a message ends early; `rodeira info` says what is damaged");
    if (!channel.traffic) timestep_.AddVehicle(channel.source, values);
    written_ = true;
    return {};
  }

  void Flush(csv::CsvFile& file) {
    if (written_) timestep_.MoveTo(1e-9 * static_cast<double>(now_ * period_ns_), file.buffer(), report_);
    written_ = false;
  }

  const record::McapReader& reader_;
  const FloatingCarsQuery& query_;
  std::map<record::ChannelId, Channel> channels_;
  std::int64_t period_ns_ = 0, now_ = -1;
  bool written_ = false;  // the timestep has a sample, perhaps of no vehicle
  Timestep timestep_;
  FloatingCarsReport report_;
};

}  // namespace

base::Result<FloatingCarsReport> WriteFloatingCars(const record::McapReader& reader, const std::filesystem::path& file,
                                                   const FloatingCarsQuery& query) {
  return Writer(reader, query).Write(file);
}

}  // namespace rodeira::floating_cars
