// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <vector>

#include "common/runtime/replay/recorded_run.hpp"

namespace rodeira::replay {

// Random access to the samples of some sources of a recording. Only chunks that hold requested samples are read from
// the file; the most recent ones are cached, so that stepping forward and backward reads no chunk twice.
class SampleReader {
 public:
  static constexpr std::size_t kKeptChunks = 8;
  static constexpr std::uint64_t kKeptBytes = 64u << 20;  // the one that was read last is kept whatever its size

  // The run must outlive it.
  SampleReader(const RecordedRun& run, std::vector<lockstep::SourceIndex> sources);

  const std::vector<lockstep::SourceIndex>& sources() const { return sources_; }
  // Of each source, in their order, its newest sample valid at or before `step`: in a whole recording the one that the
  // step law names. Nothing where there is none. Wrong input where the file is damaged there.
  base::Result<std::vector<std::optional<lockstep::Sample>>> At(lockstep::Step step);
  // The same of one source, whichever it is.
  base::Result<std::optional<lockstep::Sample>> Newest(lockstep::SourceIndex source, lockstep::Step step);
  // Chunks read so far, those read again included.
  std::uint64_t chunks_read() const { return chunks_read_; }

 private:
  struct Place {
    std::uint64_t time_ns = 0;
    std::size_t message = 0;  // of the chunk's
  };
  struct Loaded {
    std::size_t chunk = 0;  // of by_time_
    record::ChunkMessages content;
    std::map<record::ChannelId, std::vector<Place>> places;  // ascending times
  };

  base::Result<std::optional<lockstep::Sample>> Find(lockstep::SourceIndex source, lockstep::Step step);
  base::Result<const Loaded*> Load(std::size_t chunk);

  const RecordedRun& run_;
  std::vector<lockstep::SourceIndex> sources_;
  std::vector<const record::ChunkInfo*> by_time_;  // by their first times
  std::vector<std::uint64_t> latest_ns_;           // the last time of any chunk up to here in by_time_
  std::vector<Loaded> loaded_;                     // the one used last at the end
  std::uint64_t chunks_read_ = 0;
};

}  // namespace rodeira::replay
