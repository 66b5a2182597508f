#include "launch/info_command.hpp"

#include <fmt/format.h>

#include <cstdio>

#include "common/record/mcap_reader.hpp"

namespace rodeira::front {

int Info(const std::string& file) {
  const auto reader = record::McapReader::Open(file);
  if (!reader) {
    fmt::print(stderr, "rodeira: {}\n", reader.error().Text());
    return reader.error().exit_status();
  }
  const auto& in = reader.value();
  const auto& statistics = in.statistics();
  fmt::print("{}  {:.1f} kB, {}\n", file, static_cast<double>(in.condition().file_bytes) / 1000.0, in.condition().whole ? "whole" : "not whole");
  for (const std::string& finding : in.condition().findings) fmt::print("  {}\n", finding);
  fmt::print("time    {:.3f} s to {:.3f} s, {} samples in {} chunks\n", static_cast<double>(statistics.first_log_time_ns) * 1e-9,
             static_cast<double>(statistics.last_log_time_ns) * 1e-9, statistics.messages, statistics.chunks);
  for (const char* name : {"rodeira", "rodeira.meta", "rodeira.end"}) {
    const auto metadata = in.FindMetadata(name);
    if (!metadata || !metadata.value()) continue;
    for (const auto& [key, value] : metadata.value()->entries) fmt::print("{:<14}  {}\n", key, value);
  }
  fmt::print("{:<26}  {:<12}  {:<30}  {:>9}\n", "topic", "source", "type", "samples");
  for (const auto& [id, channel] : in.channels()) {
    const auto source = channel.metadata.find("source");
    const auto count = statistics.messages_by_channel.find(id);
    const auto schema = in.schemas().find(channel.schema);
    fmt::print("{:<26}  {:<12}  {:<30}  {:>9}\n", channel.topic, source == channel.metadata.end() ? "" : source->second,
               schema == in.schemas().end() ? "" : schema->second.name, count == statistics.messages_by_channel.end() ? 0 : count->second);
  }
  return 0;
}

}  // namespace rodeira::front
