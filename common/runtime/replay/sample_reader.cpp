// SPDX-License-Identifier: Apache-2.0
#include "common/runtime/replay/sample_reader.hpp"

#include <algorithm>
#include <utility>

namespace rodeira::replay {

using lockstep::Sample;

SampleReader::SampleReader(const RecordedRun& run, std::vector<lockstep::SourceIndex> sources)
    : run_(run), sources_(std::move(sources)) {
  for (const record::ChunkInfo& chunk : run.reader().chunks()) by_time_.push_back(&chunk);
  std::ranges::stable_sort(by_time_, {}, &record::ChunkInfo::first_log_time_ns);
  std::uint64_t latest_ns = 0;
  for (const record::ChunkInfo* chunk : by_time_) {
    latest_ns = std::max(latest_ns, chunk->last_log_time_ns);
    latest_ns_.push_back(latest_ns);
  }
}

base::Result<std::vector<std::optional<Sample>>> SampleReader::At(lockstep::Step step) {
  std::vector<std::optional<Sample>> samples;
  for (const lockstep::SourceIndex source : sources_) {
    auto sample = Newest(source, step);
    if (!sample) return sample.error();
    samples.push_back(std::move(sample).value());
  }
  return samples;
}

base::Result<std::optional<Sample>> SampleReader::Newest(lockstep::SourceIndex source, lockstep::Step step) {
  auto sample = Find(source, std::min(step, run_.last_step()));
  if (sample || !sample.error().context.empty()) return sample;
  base::Error error = sample.error();
  error.context = run_.path().string();
  return error;
}

base::Result<std::optional<Sample>> SampleReader::Find(lockstep::SourceIndex source, lockstep::Step step) {
  std::optional<Sample> best;
  const auto channel = run_.ChannelOf(source);
  if (!channel || step < 0) return best;
  // By the step law the newest one is valid then: the search ends with it.
  const auto base_step_ns = static_cast<std::uint64_t>(run_.roster().base_step_ns());
  const auto wanted_ns =
      static_cast<std::uint64_t>(lockstep::FloorTo(step, run_.roster().source(source).period)) * base_step_ns;
  const auto behind = std::ranges::upper_bound(by_time_, wanted_ns, {}, &record::ChunkInfo::first_log_time_ns);
  std::uint64_t best_ns = 0;
  for (auto chunk = static_cast<std::size_t>(behind - by_time_.begin()); chunk-- > 0;) {
    if (best && (best_ns == wanted_ns || latest_ns_[chunk] <= best_ns)) break;
    const record::ChunkInfo& info = *by_time_[chunk];
    if ((best && info.last_log_time_ns <= best_ns) || (info.channels && !info.channels->contains(*channel))) continue;
    const auto loaded = Load(chunk);
    if (!loaded) return loaded.error();
    const auto places = loaded.value()->places.find(*channel);
    if (places == loaded.value()->places.end()) continue;
    const auto later = std::ranges::upper_bound(places->second, wanted_ns, {}, &Place::time_ns);
    if (later == places->second.begin()) continue;
    const Place& place = *std::prev(later);
    if (best && place.time_ns <= best_ns) continue;
    const auto data = loaded.value()->content.messages[place.message].data;
    const auto header = HeaderOf(data, source);
    if (!header) return header.error();
    best = Sample{header.value(), std::make_shared<const base::Bytes>(data.begin(), data.end())};
    best_ns = place.time_ns;
  }
  return best;
}

base::Result<const SampleReader::Loaded*> SampleReader::Load(std::size_t chunk) {
  const auto known = std::ranges::find(loaded_, chunk, &Loaded::chunk);
  if (known != loaded_.end()) {
    std::rotate(known, known + 1, loaded_.end());
    return &loaded_.back();
  }
  auto content = run_.reader().ReadChunk(*by_time_[chunk]);
  if (!content) return content.error();
  ++chunks_read_;
  Loaded loaded;
  loaded.chunk = chunk;
  loaded.content = std::move(content).value();
  for (std::size_t i = 0; i < loaded.content.messages.size(); ++i) {
    loaded.places[loaded.content.messages[i].channel].push_back({loaded.content.messages[i].log_time_ns, i});
  }
  for (auto& [channel, places] : loaded.places) std::ranges::stable_sort(places, {}, &Place::time_ns);
  std::uint64_t bytes = loaded.content.records.size();
  std::size_t kept = 0;  // of those that are there, from the end
  while (kept < loaded_.size() && kept + 1 < kKeptChunks) {
    bytes += loaded_[loaded_.size() - 1 - kept].content.records.size();
    if (bytes > kKeptBytes) break;
    ++kept;
  }
  loaded_.erase(loaded_.begin(), loaded_.end() - static_cast<std::ptrdiff_t>(kept));
  loaded_.push_back(std::move(loaded));
  return &loaded_.back();
}

}  // namespace rodeira::replay
