// SPDX-License-Identifier: Apache-2.0
#include "common/core/base/wait.hpp"

#include <fmt/format.h>

#include "common/core/base/crash_trace.hpp"

namespace rodeira::base {
namespace {

std::mutex g_waits_mutex;
WaitNote* g_newest_wait = nullptr;

}  // namespace

WaitNote::WaitNote(const char* cause) : cause_(cause), node_(CurrentNode()) {
  const std::lock_guard lock(g_waits_mutex);
  older_ = g_newest_wait;
  if (older_ != nullptr) older_->newer_ = this;
  g_newest_wait = this;
}

WaitNote::~WaitNote() {
  const std::lock_guard lock(g_waits_mutex);
  (newer_ == nullptr ? g_newest_wait : newer_->older_) = older_;
  if (older_ != nullptr) older_->newer_ = newer_;
}

std::string LongestWait(std::chrono::milliseconds at_least, std::string_view node) {
  const std::lock_guard lock(g_waits_mutex);
  const WaitNote* longest = nullptr;
  for (const WaitNote* note = g_newest_wait; note != nullptr; note = note->older_) {
    if (std::string_view(note->node_ == nullptr ? "" : note->node_) != node) continue;
    if (longest == nullptr || note->since_ < longest->since_) longest = note;
  }
  if (longest == nullptr) return {};
  const std::chrono::duration<double> lasted = std::chrono::steady_clock::now() - longest->since_;
  if (lasted < at_least) return {};
  return fmt::format("waits for {} since {:.1f} s", longest->cause_, lasted.count());
}

}  // namespace rodeira::base
