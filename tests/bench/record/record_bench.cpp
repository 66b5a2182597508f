// SPDX-License-Identifier: Apache-2.0
// How fast a recording is written and read: 100 000 messages of 400 bytes, a hundred simulated seconds at 1 kHz.
#include <benchmark/benchmark.h>
#include <unistd.h>

#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "common/core/base/files.hpp"
#include "common/core/base/random.hpp"
#include "common/data/record/mcap_reader.hpp"
#include "common/data/record/mcap_writer.hpp"

namespace rodeira::record {
namespace {

constexpr std::uint32_t kMessages = 100'000;
constexpr std::size_t kMessageBytes = 400;
constexpr std::uint64_t kStepNs = 1'000'000;

std::filesystem::path BenchFile() {
  return std::filesystem::temp_directory_path() / ("rodeira-bench-" + std::to_string(::getpid()) + ".mcap");
}

// Fifty doubles: some at rest, some moving smoothly, as a vehicle's state does.
void Fill(base::Bytes& data, std::uint32_t n) {
  double values[kMessageBytes / sizeof(double)];
  for (std::size_t i = 0; i < std::size(values); ++i) {
    values[i] = i % 3 == 0 ? static_cast<double>(i) : 1e-3 * n + base::RandomUniform({i, n}, -1e-3, 1e-3);
  }
  std::memcpy(data.data(), values, sizeof values);
}

std::uint64_t WriteAll(Compression compression, bool fill) {
  WriterSettings settings;
  settings.compression = compression;
  settings.overwrite = true;
  auto writer = McapWriter::Open(BenchFile(), settings).value();
  const ChannelId channel = writer.AddChannel("vehicle/state", 0, "cdr").value();
  base::Bytes data(kMessageBytes);
  Fill(data, 0);
  for (std::uint32_t n = 0; n < kMessages; ++n) {
    if (fill) Fill(data, n);
    if (!writer.Write(channel, n, n * kStepNs, n * kStepNs, data)) std::abort();
  }
  if (!writer.Close()) std::abort();
  return writer.written_bytes();
}

void Write(benchmark::State& state) {
  const auto compression = state.range(0) == 0 ? Compression::kNone : Compression::kZstd;
  std::uint64_t bytes = 0;
  for (auto _ : state) bytes = WriteAll(compression, true);
  state.SetItemsProcessed(state.iterations() * kMessages);
  state.SetBytesProcessed(state.iterations() * static_cast<std::int64_t>(kMessages * kMessageBytes));
  state.counters["file_bytes"] = static_cast<double>(bytes);
  std::filesystem::remove(BenchFile());
}
BENCHMARK(Write)->ArgName("zstd")->Arg(0)->Arg(1)->Unit(benchmark::kMillisecond);

// What the messages cost that are not written.
void FillOnly(benchmark::State& state) {
  base::Bytes data(kMessageBytes);
  for (auto _ : state) {
    for (std::uint32_t n = 0; n < kMessages; ++n) Fill(data, n);
    benchmark::DoNotOptimize(data.data());
  }
  state.SetItemsProcessed(state.iterations() * kMessages);
}
BENCHMARK(FillOnly)->Unit(benchmark::kMillisecond);

void Read(benchmark::State& state) {
  WriteAll(state.range(0) == 0 ? Compression::kNone : Compression::kZstd, true);
  for (auto _ : state) {
    auto reader = McapReader::Open(BenchFile()).value();
    auto cursor = reader.Messages();
    std::uint64_t count = 0;
    while (cursor.Next().value().has_value()) ++count;
    if (count != kMessages) std::abort();
  }
  state.SetItemsProcessed(state.iterations() * kMessages);
  std::filesystem::remove(BenchFile());
}
BENCHMARK(Read)->ArgName("zstd")->Arg(0)->Arg(1)->Unit(benchmark::kMillisecond);

// A real recording written again: RODEIRA_RECORDING=FILE record_bench --benchmark_filter=Again
struct Recorded {
  struct Item {
    ChannelId channel = 0;
    std::uint64_t log_time_ns = 0;
    base::Bytes data;
  };
  std::vector<Channel> channels;
  std::vector<Item> messages;
  double simulated_s = 0.0;
};

const Recorded& TheRecording() {
  static const Recorded kRecorded = [] {
    Recorded recorded;
    const char* file = std::getenv("RODEIRA_RECORDING");
    if (file == nullptr) return recorded;
    const auto reader = McapReader::Open(file);
    if (!reader) return recorded;
    for (const auto& [id, channel] : reader.value().channels()) recorded.channels.push_back(channel);
    Query query;
    query.order = Query::Order::kFile;
    auto cursor = reader.value().Messages(query);
    while (true) {
      const auto message = cursor.Next();
      if (!message || !message.value()) break;
      const Message& m = *message.value();
      recorded.messages.push_back({m.channel, m.log_time_ns, base::Bytes(m.data.begin(), m.data.end())});
    }
    recorded.simulated_s = static_cast<double>(reader.value().statistics().last_log_time_ns) * 1e-9;
    return recorded;
  }();
  return kRecorded;
}

void Again(benchmark::State& state) {
  const Recorded& recorded = TheRecording();
  if (recorded.messages.empty()) return state.SkipWithError("RODEIRA_RECORDING names no recording");
  WriterSettings settings;
  settings.zstd_level = static_cast<int>(state.range(0));
  settings.chunk_bytes = static_cast<std::uint64_t>(state.range(1)) << 20;
  std::uint64_t bytes = 0;
  for (auto _ : state) {
    base::Bytes file;
    auto writer = McapWriter::Open(std::make_unique<MemorySink>(&file), settings).value();
    std::map<ChannelId, ChannelId> ids;
    for (const Channel& channel : recorded.channels)
      ids[channel.id] = writer.AddChannel(channel.topic, 0, "cdr", channel.metadata).value();
    for (const auto& m : recorded.messages) {
      if (!writer.Write(ids.at(m.channel), 0, m.log_time_ns, m.log_time_ns, m.data)) std::abort();
    }
    if (!writer.Close()) std::abort();
    bytes = file.size();
  }
  state.counters["MB_per_simulated_s"] = static_cast<double>(bytes) * 1e-6 / recorded.simulated_s;
  state.counters["GB_per_hour"] = static_cast<double>(bytes) * 3.6e-6 / recorded.simulated_s;
  state.counters["simulated_s"] = recorded.simulated_s;
}
BENCHMARK(Again)
    ->ArgNames({"level", "chunk_MiB"})
    ->ArgsProduct({{1, 3, 9, 13, 16}, {1, 4}})
    ->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace rodeira::record
