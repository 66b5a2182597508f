// SPDX-License-Identifier: Apache-2.0
#include "launch/rodeira/commands/traffic_files.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <system_error>

#include "common/core/base/csv_cell.hpp"
#include "common/core/base/files.hpp"
#include "common/core/base/suggest.hpp"
#include "common/core/base/writable.hpp"
#include "common/traffic/results/floating_cars.hpp"
#include "common/traffic/results/lane_tables.hpp"
#include "common/traffic/results/names.hpp"
#include "common/world/lanes/floating_car.hpp"

namespace rodeira::cli {
namespace {

bool EndsOn(const std::string& file, const char* ending) { return std::filesystem::path(file).extension() == ending; }

// "ROAD:LANE", a track of the network.
base::Result<std::uint32_t> FindTrack(const lanes::Graph& graph, const std::string& lane_text) {
  const auto longest =
      std::max_element(graph.tracks().begin(), graph.tracks().end(),
                       [](const lanes::Track& a, const lanes::Track& b) { return a.length_m() < b.length_m(); });
  if (longest == graph.tracks().end()) return base::WrongInput("world.no_lane", "the map has no lane", "--diagram");
  if (lane_text.empty()) return static_cast<std::uint32_t>(longest - graph.tracks().begin());
  const auto colon = lane_text.rfind(':');
  int lane = 0;
  const char* end = lane_text.data() + lane_text.size();
  const bool good = colon != std::string::npos && std::from_chars(lane_text.data() + colon + 1, end, lane).ptr == end;
  const std::string road = good ? lane_text.substr(0, colon) : lane_text;
  std::vector<std::string> known;
  for (std::uint32_t track = 0; track < graph.tracks().size(); ++track) {
    const network::LaneKey& key = graph[track].lane;
    const std::string& id = graph.network().roads()[key.road].id();
    if (good && id == road && key.lane == lane) return track;
    known.push_back(fmt::format("{}:{}", id, key.lane));
  }
  return base::WrongInput("world.unknown_lane",
                          fmt::format("'{}' was found; a drivable lane as ROAD:LANE was expected{}", lane_text,
                                      base::DidYouMean(lane_text, known)),
                          "--lane");
}

base::Status WriteText(const std::string& file, const std::string& text) {
  if (auto status = base::WriteWhole(file, text); !status) return status;
  return {};
}

}  // namespace

std::string TrafficFiles::InFolder(const char* name) const {
  return (std::filesystem::path(options_.csv) / name).string();
}

base::Result<TrafficFiles> TrafficFiles::Open(const TrafficOptions& options, const network::Network& network) {
  TrafficFiles files(options);
  if (!(options.warm_s < options.duration_s))
    return base::WrongInput(
        "command.wrong_value",
        fmt::format("{} s are left out of {} s; less was expected", options.warm_s, options.duration_s), "--warm");
  if (options.every_s > 0.0 && options.csv.empty())
    return base::WrongInput(
        "command.missing_option",
        "a table every so many seconds was asked for, and no folder for it; --csv FOLDER was expected", "--every");
  if (options.every_s > 0.0 && options.every_s < options.step_s)
    return base::WrongInput(
        "command.wrong_value",
        fmt::format("{} s were given; at least the step of {} s was expected", options.every_s, options.step_s),
        "--every");
  if (RowsEvery_s(options) < options.step_s)
    return base::WrongInput(
        "command.wrong_value",
        fmt::format("{} s were given; at least the step of {} s was expected", RowsEvery_s(options), options.step_s),
        "--rows-every");
  if (!options.heat.empty() && !EndsOn(options.heat, ".svg") && !EndsOn(options.heat, ".tif"))
    return base::WrongInput("command.wrong_value",
                            fmt::format("'{}' was found; a file on .svg or .tif was expected", options.heat), "--heat");
  if (options.pixel_m != 1.0 && !EndsOn(options.heat, ".tif"))
    return base::WrongInput(
        "command.wrong_value",
        fmt::format("a pixel of {} m was given for '{}'; a file on .tif was expected", options.pixel_m, options.heat),
        "--pixel");
  if (!options.fcd.empty() && !EndsOn(options.fcd, ".xml"))
    return base::WrongInput("command.wrong_value",
                            fmt::format("'{}' was found; a file on .xml was expected", options.fcd), "--fcd");
  if (!options.tripinfo.empty() && !EndsOn(options.tripinfo, ".xml"))
    return base::WrongInput("command.wrong_value",
                            fmt::format("'{}' was found; a file on .xml was expected", options.tripinfo), "--tripinfo");
  if (!options.diagram.empty()) {
    const auto track = FindTrack(lanes::Graph(network), options.lane);
    if (!track) return track.error();
    files.diagram_.emplace(track.value());
  }
  if (EndsOn(options.heat, ".tif")) {
    if (auto status = traffic::CheckHeatRaster(lanes::Graph(network), options.pixel_m, options.heat); !status)
      return status.error();
  }
  for (const std::string& file : {options.heat, options.diagram}) {  // before it drives for hours
    if (file.empty()) continue;
    if (auto status = base::CheckWritable(file); !status) return status.error();
  }
  if (!options.csv.empty()) {
    std::error_code problem;
    if (std::filesystem::exists(options.csv, problem) && !std::filesystem::is_directory(options.csv, problem))
      return base::WrongInput("file.not_folder", "a file is there; a folder was expected", "--csv " + options.csv);
    std::filesystem::create_directories(options.csv, problem);
    files.trajectories_.open(files.InFolder("trajectories.csv"));
    if (problem || !files.trajectories_)
      return base::Failed("file.cannot_write", "the folder cannot be written to", options.csv);
    files.trajectories_ << "time_s,car,trip,x_m,y_m,z_m,heading_rad,speed_mps,acceleration_mps2,road,lane,"
                           "length_m,width_m,kind,lamps\n";
    files.signal_table_.emplace(lanes::Graph(network));
    files.signals_.open(files.InFolder("signals.csv"));
    if (!files.signals_)
      return base::Failed("file.cannot_write", "the file cannot be written", files.InFolder("signals.csv"));
    files.signals_ << traffic::SignalTable::Header();
  }
  if (!options.fcd.empty()) {
    files.fcd_.open(options.fcd);
    if (!files.fcd_) return base::Failed("file.cannot_write", "the file cannot be written", options.fcd);
    files.fcd_ << lanes::kFloatingCarsBegin;
  }
  if (!options.tripinfo.empty()) {
    files.tripinfo_.open(options.tripinfo);
    if (!files.tripinfo_) return base::Failed("file.cannot_write", "the file cannot be written", options.tripinfo);
    files.tripinfo_ << traffic::TripInfos::Begin();
  }
  return files;
}

// One row a car.
void TrafficFiles::WriteTrajectories(const traffic::StudyMoment& moment) {
  for (const traffic::AgentPose& pose : moment.model.poses()) {
    const Eigen::Vector3d forward = pose.q_WB * Eigen::Vector3d::UnitX();
    const traffic::AgentTraits& traits = moment.model.traits(pose.id);
    trajectories_ << fmt::format(
        "{:.2f},{},{},{:.3f},{:.3f},{:.3f},{:.5f},{:.3f},{:.3f},{},{},{:.2f},{:.2f},{},{}\n", moment.time_s, pose.id,
        pose.trip, pose.p_WB_W.x(), pose.p_WB_W.y(), pose.p_WB_W.z(), std::atan2(forward.y(), forward.x()),
        pose.speed_mps, pose.acceleration_mps2,
        base::CsvCell(moment.model.graph().network().roads()[static_cast<std::size_t>(pose.road)].id()), pose.lane,
        traits.length_m, traits.width_m, traffic::NameOf(traits.kind),
        traffic::NameOfLamps(moment.model.LightsOf(pose)));
  }
}

void TrafficFiles::Write(const traffic::StudyMoment& moment) {
  if (signal_table_) signals_ << signal_table_->At(moment.time_s, moment.model);
  if (tripinfo_.is_open() && moment.time_s > options_.warm_s - 1e-9)
    tripinfo_ << trip_infos_.At(moment.time_s, moment.model);
  if (moment.time_s < next_s_ - 1e-9) return;
  next_s_ += RowsEvery_s(options_);
  if (trajectories_.is_open()) WriteTrajectories(moment);
  if (fcd_.is_open()) fcd_ << traffic::FloatingCarsAt(moment.time_s, moment.model);
  if (diagram_) diagram_->Add(moment.time_s, moment.model);
}

base::Result<std::vector<std::string>> TrafficFiles::Close(const network::Network& network,
                                                           const traffic::StudyResult& result) {
  std::vector<std::string> written;
  const lanes::Graph graph(network);
  const std::string title =
      fmt::format("{}: {} vehicles, {:.0f} s", network.name(), result.on_road + result.waiting, options_.duration_s);
  const auto text = [&](const std::string& file, const std::string& content) {
    written.push_back(file);
    return WriteText(file, content);
  };
  if (trajectories_.is_open()) {
    trajectories_.close();
    if (!trajectories_)
      return base::Failed("file.cannot_write", "the table could not be written to its end",
                          InFolder("trajectories.csv"));
    written.push_back(InFolder("trajectories.csv"));
    signals_.close();
    if (!signals_)
      return base::Failed("file.cannot_write", "the table could not be written to its end", InFolder("signals.csv"));
    written.push_back(InFolder("signals.csv"));
    if (auto status = text(InFolder("lanes.csv"), traffic::LaneTable(graph, *result.lanes)); !status)
      return status.error();
    if (auto status = text(InFolder("queues.csv"), traffic::QueueTable(graph, *result.lanes)); !status)
      return status.error();
    if (auto status = text(InFolder("flows.csv"), traffic::FlowTable(graph, *result.lanes)); !status)
      return status.error();
    if (result.intervals) {
      if (auto status = text(InFolder("intervals.csv"), traffic::IntervalTable(graph, *result.intervals)); !status)
        return status.error();
    }
    if (auto status = text(InFolder("trips.csv"), traffic::TripTable(graph, *result.lanes)); !status)
      return status.error();
  }
  if (fcd_.is_open()) {
    fcd_ << lanes::kFloatingCarsEnd;
    fcd_.close();
    if (!fcd_) return base::Failed("file.cannot_write", "the file could not be written to its end", options_.fcd);
    written.push_back(options_.fcd);
  }
  if (tripinfo_.is_open()) {
    tripinfo_ << traffic::TripInfos::End();
    tripinfo_.close();
    if (!tripinfo_)
      return base::Failed("file.cannot_write", "the file could not be written to its end", options_.tripinfo);
    written.push_back(options_.tripinfo);
  }
  if (diagram_) {
    if (auto status = text(options_.diagram, diagram_->ToSvg(graph, title)); !status) return status.error();
  }
  if (EndsOn(options_.heat, ".svg")) {
    if (auto status = text(options_.heat, traffic::SpeedMap(graph, *result.lanes, title)); !status)
      return status.error();
  } else if (!options_.heat.empty()) {
    if (auto status = traffic::WriteHeatRaster(graph, *result.lanes, options_.pixel_m, options_.heat); !status)
      return status.error();
    written.push_back(options_.heat);
  }
  return written;
}

}  // namespace rodeira::cli
