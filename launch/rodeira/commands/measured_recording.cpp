// SPDX-License-Identifier: Apache-2.0
#include "launch/rodeira/commands/measured_recording.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>

#include "common/world/road/road_chains.hpp"
#include "idl/aliases.hpp"
#include "launch/rodeira/interrupt.hpp"
#include "launch/rodeira/replay/content_digest.hpp"

namespace rodeira::cli {
namespace {

std::string MetaOf(const record::TextMap& meta, const char* key) {
  const auto found = meta.find(key);
  return found == meta.end() ? std::string() : found->second;
}

// By their names in files, as in a scenario file: a road of the network alone, or the whole road that it is a part of.
std::vector<measures::NamedRoad> NamedRoads(const network::Network& network) {
  std::vector<measures::NamedRoad> roads;
  for (const road::RoadChain& chain : road::ChainsOf(network)) {
    if (network.FindRoad(road::IdOf(network, chain))) continue;
    measures::NamedRoad& named = roads.emplace_back();
    named.name = road::IdOf(network, chain);
    for (const road::RoadChain::Part& part : chain.parts)
      named.parts.push_back({static_cast<double>(part.road), part.from_s_m});
  }
  for (std::size_t i = 0; i < network.roads().size(); ++i)
    roads.push_back({network.roads()[i].id(), {{static_cast<double>(i), 0.0}}});
  return roads;
}

}  // namespace

ReadingProgress::ReadingProgress(bool quiet, std::size_t files)
    : quiet_(quiet || ::isatty(STDERR_FILENO) == 0), files_(files) {}

ReadingProgress::~ReadingProgress() {
  if (shown_) fmt::print(stderr, "\r\033[K");
}

bool ReadingProgress::Show(std::size_t file, double share) {
  if (!quiet_ && std::chrono::steady_clock::now() - start_ > std::chrono::seconds(2)) {
    const double done = (static_cast<double>(file) + share) / static_cast<double>(files_);
    fmt::print(stderr, "\r\033[K{:.0f} % read", 100.0 * done);
    shown_ = true;
  }
  return !Interrupted();
}

base::Result<std::shared_ptr<const road::World>> EmbeddedWorld(const replay::RecordedRun& run) {
  if (run.launch().world().empty()) return std::shared_ptr<const road::World>();
  auto world = road::World::Load(run.launch().world());
  if (!world) return run.Named(world.error());
  const std::string hash = base::Hex(world.value()->content_hash());
  if (!run.world_hash().empty() && run.world_hash() != hash) {
    return base::WrongInput("replay.other_world",
                            fmt::format("the recording says world_hash {}, the embedded world has {}; lanes cannot "
                                        "be found with another world",
                                        run.world_hash(), hash),
                            run.path().string());
  }
  return std::shared_ptr<const road::World>(std::move(world).value());
}

base::Result<MeasuredRecording> ReadMeasured(const std::string& file, const std::string& subject,
                                             const std::function<bool(double)>& progress) {
  const auto run = replay::RecordedRun::Open(file);
  if (!run) return run.error();
  const auto embedded = EmbeddedWorld(run.value());
  if (!embedded) return embedded.error();
  const std::shared_ptr<const road::World>& world = embedded.value();
  ContentDigest content;
  measures::DriveQuery query;
  query.subject = subject;
  query.aliases = &idl::Aliases();
  query.on_message = [&content](const record::Channel& channel, const record::Message& message) {
    content.Add(channel, message);
  };
  query.progress = progress;
  auto reading = measures::ReadDrive(run.value().reader(), world == nullptr ? nullptr : world->network(), query);
  if (!reading) return reading.error().In(file);
  MeasuredRecording measured{world, std::move(reading).value(), {}, {}};
  if (world != nullptr && world->network() != nullptr) measured.reading.roads = NamedRoads(*world->network());
  measures::RecordingFacts& facts = measured.facts;
  facts.file = file;
  facts.subject = measured.reading.drive.subject;
  facts.version = run.value().version();
  facts.commit = run.value().commit();
  facts.world_hash = run.value().world_hash();
  facts.content = base::Hex(content.digest());
  facts.notes = measured.reading.drive.notes;
  const auto meta = run.value().reader().FindMetadata("rodeira.meta");
  if (!meta) return meta.error();
  if (meta.value()) measured.meta = meta.value()->entries;
  return measured;
}

std::vector<measures::MeasuresRow> RowsOf(const measures::MeasuresSpec& spec, const MeasuredRecording& recording) {
  std::vector<measures::MeasuresRow> rows = measures::ComputeRows(spec, recording.reading);
  for (measures::MeasuresRow& row : rows) {
    row.file = recording.facts.file;
    row.participant = MetaOf(recording.meta, "participant");
    row.condition = MetaOf(recording.meta, "condition");
    row.run = MetaOf(recording.meta, "run");
  }
  return rows;
}

base::Result<measures::MeasuresSpec> MeasuresSpecOf(const std::string& file, const std::vector<std::string>& intervals,
                                                    const std::string& baseline, const std::string& subject) {
  auto spec = file.empty() ? base::Result(measures::DefaultSpec()) : measures::ReadSpec(file);
  if (!spec) return spec;
  measures::MeasuresSpec& s = spec.value();
  if (!intervals.empty()) s.intervals.clear();
  std::vector<std::string> names;
  for (const std::string& text : intervals) {
    auto interval = measures::ParseInterval(text);
    if (!interval) return interval.error().In("--intervals");
    names.push_back(interval.value().name);
    if (std::ranges::count(names, names.back()) > 1)
      return base::WrongInput("measure.duplicate_interval", fmt::format("two intervals are named '{}'", names.back()),
                              "--intervals");
    s.intervals.push_back(std::move(interval).value());
  }
  if (!baseline.empty()) s.baseline = baseline;
  if (auto status = measures::CheckBaseline(s); !status)
    return status.error().WithContext(baseline.empty() ? "--intervals" : "--baseline");
  if (!subject.empty()) s.subject = subject;
  return spec;
}

base::Status CheckIntervalNames(const measures::MeasuresSpec& spec, const std::vector<measures::MeasuresRow>& rows) {
  for (const measures::IntervalSpec& interval : spec.intervals) {
    const auto is_its = [&](const measures::MeasuresRow& row) { return row.interval.name == interval.name; };
    const auto known = [&](const measures::MeasuresRow& row) { return is_its(row) && !row.interval.unknown; };
    if (std::ranges::any_of(rows, known)) continue;
    const auto row = std::ranges::find_if(rows, is_its);
    if (row != rows.end())
      return base::WrongInput("measure.wrong_interval", row->interval.reason,
                              fmt::format("interval '{}'", interval.name));
  }
  return {};
}

}  // namespace rodeira::cli
