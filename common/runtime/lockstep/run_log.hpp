// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <deque>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "common/runtime/lockstep/step.hpp"

// What happens around a run on the wall's clock: when which step was granted, what the operator did, what failed. No
// part of the lockstep: nothing of it is in a digest, and two runs with different logs are identical.
namespace rodeira::lockstep {

// One grant: all steps behind `after`, through `through`. At a pace step k was due (through - k) base steps, divided by
// the pace, before through was: before monotonic_ns - late_ns. Steps that no entry covers were granted by a clock that
// died before it could say when.
struct WallTime {
  Step after = -1;  // the newest granted step before
  Step through = 0;
  std::int64_t utc_ns = 0;        // since 1970
  std::int64_t monotonic_ns = 0;  // since the first grant
  std::int64_t late_ns = 0;       // of `through`; 0 at pace 0
  double pace = 0.0;              // as Pacer
  bool paused = false;            // a single step of a paused run

  bool operator==(const WallTime&) const = default;
};

enum class RemarkKind { kStart, kEnd, kMark, kPause, kResume, kStep, kPace, kStop, kFault };
std::string_view RemarkName(RemarkKind kind);  // "start", "end", "mark" …

// An entry of the log beside the wall times: start, pause, mark, change of pace. UTC and monotonic time are the
// clock's.
struct Remark {
  Step step = -1;  // the newest granted one
  std::int64_t utc_ns = 0;
  std::int64_t monotonic_ns = 0;
  double pace = 0.0;  // from then on
  RemarkKind kind = RemarkKind::kMark;
  std::string text;
  std::uint32_t number = 0;  // counts from 1

  bool operator==(const Remark&) const = default;
};

// Entries of the log that are sent together, in order. Batches have ascending numbers without gaps.
struct LogBatch {
  std::uint64_t number = 0;  // counts from 0
  std::vector<WallTime> walls;
  std::vector<Remark> remarks;
  bool last = false;  // nothing follows

  bool operator==(const LogBatch&) const = default;
};

// The clock's side: gathers entries into batches.
class RunLog {
 public:
  // Another incarnation of a clock counts in numbers of its own, so that its batches are not taken for earlier ones.
  static constexpr std::uint64_t kBatchesOfAnIncarnation = std::uint64_t{1} << 24;
  static constexpr std::uint32_t kRemarksOfAnIncarnation = 100'000;
  explicit RunLog(std::uint32_t incarnation = 0) : remarks_(incarnation * kRemarksOfAnIncarnation) {
    next_.number = incarnation * kBatchesOfAnIncarnation;
  }

  static constexpr std::int64_t kBatch_ns = 50'000'000;  // wall times wait for company, remarks do not
  static constexpr std::size_t kBatchEntries = 256;

  // It is taken with others, within kBatch_ns.
  void Add(const WallTime& wall) { next_.walls.push_back(wall); }
  // Numbers it; the number comes back.
  std::uint32_t Add(Remark remark);
  // Nothing follows; the next Take() says so.
  void Close() { next_.last = true; }
  bool closed() const { return next_.last || closed_; }
  // What is due at wall time `now_ns`; nothing where nothing is, and after the last.
  std::optional<LogBatch> Take(std::int64_t now_ns);

 private:
  LogBatch next_;
  std::int64_t taken_ns_ = 0;
  std::uint32_t remarks_ = 0;
  bool closed_ = false;
};

// Published batches, kept for retransmission: the newest kMost. For one thread.
class KeptLog {
 public:
  static constexpr std::size_t kMost = 2000;
  // In ascending order of their numbers.
  void Add(const LogBatch& batch);
  // The batches from `number` on, at most 64 per call; a reader that lacks more sends another nack.
  std::vector<LogBatch> From(std::uint64_t number) const;

 private:
  std::deque<LogBatch> batches_;
};

// The recorder's side: restores the order of batches after loss, duplication and reordering. Entries that an earlier
// incarnation of the clock had not published are lost. Thread-safe.
class LogInbox {
 public:
  // Ignores a batch that was received before.
  void Deliver(LogBatch batch);
  // Batches before `number` are in a file already.
  void BeginAt(std::uint64_t number);
  // The batches received without a gap, in order. Never blocks.
  std::vector<LogBatch> Take();
  // The number of the oldest missing batch, if a later one has been received.
  std::optional<std::uint64_t> Gap() const;
  // The number of the first batch not yet received.
  std::uint64_t next() const;
  // Waits until all batches up to the last have been received; false after `limit`.
  bool AwaitEnd(std::chrono::milliseconds limit);

 private:
  mutable std::mutex mutex_;
  std::condition_variable woken_;
  std::map<std::uint64_t, LogBatch> early_;
  std::vector<LogBatch> ready_;
  std::uint64_t next_ = 0;
  bool over_ = false;
};

}  // namespace rodeira::lockstep
