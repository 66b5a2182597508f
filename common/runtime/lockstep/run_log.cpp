// SPDX-License-Identifier: Apache-2.0
#include "common/runtime/lockstep/run_log.hpp"

#include <algorithm>
#include <utility>

namespace rodeira::lockstep {

std::string_view RemarkName(RemarkKind kind) {
  switch (kind) {
    case RemarkKind::kStart:
      return "start";
    case RemarkKind::kEnd:
      return "end";
    case RemarkKind::kMark:
      return "mark";
    case RemarkKind::kPause:
      return "pause";
    case RemarkKind::kResume:
      return "resume";
    case RemarkKind::kStep:
      return "step";
    case RemarkKind::kPace:
      return "pace";
    case RemarkKind::kStop:
      return "stop";
    case RemarkKind::kFault:
      return "fault";
  }
  return "unknown";
}

std::uint32_t RunLog::Add(Remark remark) {
  remark.number = ++remarks_;
  next_.remarks.push_back(std::move(remark));
  return remarks_;
}

std::optional<LogBatch> RunLog::Take(std::int64_t now_ns) {
  if (closed_) return std::nullopt;
  const bool old_enough =
      !next_.walls.empty() && (now_ns - taken_ns_ >= kBatch_ns || next_.walls.size() >= kBatchEntries);
  if (!old_enough && next_.remarks.empty() && !next_.last) return std::nullopt;
  taken_ns_ = now_ns;
  closed_ = next_.last;
  LogBatch batch = std::exchange(next_, {});
  next_.number = batch.number + 1;
  return batch;
}

void KeptLog::Add(const LogBatch& batch) {
  batches_.push_back(batch);
  if (batches_.size() > kMost) batches_.pop_front();
}

std::vector<LogBatch> KeptLog::From(std::uint64_t number) const {
  constexpr std::size_t kAtATime = 64;
  const auto first = std::find_if(batches_.begin(), batches_.end(),
                                  [number](const LogBatch& batch) { return batch.number >= number; });
  const auto count = std::min<std::size_t>(kAtATime, static_cast<std::size_t>(batches_.end() - first));
  return {first, first + static_cast<std::ptrdiff_t>(count)};
}

void LogInbox::Deliver(LogBatch batch) {
  const std::lock_guard lock(mutex_);
  if (batch.number < next_) return;
  if (const std::uint64_t incarnation = batch.number / RunLog::kBatchesOfAnIncarnation;
      incarnation > next_ / RunLog::kBatchesOfAnIncarnation) {
    next_ = incarnation * RunLog::kBatchesOfAnIncarnation;
    early_.erase(early_.begin(), early_.lower_bound(next_));
  }
  early_.try_emplace(batch.number, std::move(batch));
  while (!early_.empty() && early_.begin()->first == next_) {
    over_ = over_ || early_.begin()->second.last;
    ready_.push_back(std::move(early_.begin()->second));
    early_.erase(early_.begin());
    ++next_;
  }
  woken_.notify_all();
}

void LogInbox::BeginAt(std::uint64_t number) {
  const std::lock_guard lock(mutex_);
  next_ = std::max(next_, number);
  early_.erase(early_.begin(), early_.lower_bound(next_));
}

std::vector<LogBatch> LogInbox::Take() {
  const std::lock_guard lock(mutex_);
  return std::exchange(ready_, {});
}

std::optional<std::uint64_t> LogInbox::Gap() const {
  const std::lock_guard lock(mutex_);
  if (early_.empty()) return std::nullopt;
  return next_;
}

std::uint64_t LogInbox::next() const {
  const std::lock_guard lock(mutex_);
  return next_;
}

bool LogInbox::AwaitEnd(std::chrono::milliseconds limit) {
  std::unique_lock lock(mutex_);
  return woken_.wait_for(lock, limit, [this] { return over_; });
}

}  // namespace rodeira::lockstep
