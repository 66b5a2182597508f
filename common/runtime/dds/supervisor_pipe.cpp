// SPDX-License-Identifier: Apache-2.0
#include "common/runtime/dds/supervisor_pipe.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cstring>
#include <utility>

#include "common/runtime/dds/statements.hpp"
#include "common/runtime/lockstep/life.hpp"

namespace rodeira::dds {
namespace {

constexpr std::size_t kMaxLine_bytes = 1U << 20;  // a longer one is no command: it is dropped

// The text up to a space, which is taken away with it.
std::string_view TakeWord(std::string_view& text) {
  const std::string_view word = text.substr(0, text.find(' '));
  text.remove_prefix(std::min(word.size() + 1, text.size()));
  return word;
}

// A word that is a number, whole.
template <class Number>
bool TakeNumber(std::string_view& text, Number& number) {
  const std::string_view word = TakeWord(text);
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), number);
  return error == std::errc{} && !word.empty() && end == word.data() + word.size();
}

}  // namespace

void WriteLastWord(const lockstep::Report& report, std::string_view node) {
  if (!lockstep::IsFault(report.phase)) return;
  const std::string begin = node.empty() ? std::string(kLastWord) : fmt::format("{}{}': ", kLastWordOfNode, node);
  const std::string line =
      fmt::format("{}{} {} {}\n", begin, lockstep::PhaseName(report.phase), report.progress, OneLine(report.message));
  [[maybe_unused]] const ssize_t written = ::write(STDERR_FILENO, line.data(), line.size());
}

std::optional<LastWord> ParseLastWord(std::string_view text) {
  LastWord word;
  word.node = TakeWord(text);
  if (word.node.empty() || !TakeNumber(text, word.incarnation)) return std::nullopt;
  const std::string_view phase = TakeWord(text);
  for (const auto known : {lockstep::Phase::kFailed, lockstep::Phase::kRefused, lockstep::Phase::kLost}) {
    if (phase != lockstep::PhaseName(known)) continue;
    word.phase = known;
    if (!TakeNumber(text, word.step) || word.step < 0) return std::nullopt;
    word.text = text;
    return word;
  }
  return std::nullopt;
}

std::optional<LostNode> ParseLostNode(std::string_view text) {
  LostNode lost;
  lost.node = TakeWord(text);
  if (lost.node.empty() || !TakeNumber(text, lost.incarnation)) return std::nullopt;
  lost.text = text.empty() ? "was lost" : text;
  return lost;
}

SupervisorPipe::~SupervisorPipe() {
  if (!thread_.joinable()) return;
  ::close(stop_[1]);
  thread_.join();
  ::close(stop_[0]);
}

base::Status SupervisorPipe::Listen(int descriptor, std::function<void()> on_line) {
  if (::pipe2(stop_, O_CLOEXEC) != 0)
    return base::Failed("system.no_pipe", fmt::format("cannot create a pipe: {}", std::strerror(errno)));
  thread_ = std::thread([this, descriptor, on_line = std::move(on_line)] { Read(descriptor, on_line); });
  return {};
}

void SupervisorPipe::Read(int descriptor, const std::function<void()>& on_line) {
  std::string pending;
  for (;;) {
    pollfd waiting[2] = {{descriptor, POLLIN, 0}, {stop_[0], POLLIN, 0}};
    if (::poll(waiting, 2, -1) < 0 && errno != EINTR) return;
    if (waiting[1].revents != 0) return;
    if (waiting[0].revents == 0) continue;
    char buffer[4096];
    const ssize_t size = ::read(descriptor, buffer, sizeof(buffer));
    if (size < 0 && errno == EINTR) continue;
    if (size <= 0) break;
    pending.append(buffer, static_cast<std::size_t>(size));
    bool counts = false;
    for (auto end = pending.find('\n'); end != std::string::npos; end = pending.find('\n')) {
      counts = Take(std::string_view(pending).substr(0, end)) || counts;
      pending.erase(0, end + 1);
    }
    if (pending.size() > kMaxLine_bytes) pending.clear();
    if (counts) on_line();
  }
  {
    const std::lock_guard lock(mutex_);
    is_closed_ = true;
  }
  on_line();
}

bool SupervisorPipe::Take(std::string_view line) {
  const std::string_view what = TakeWord(line);
  const std::lock_guard lock(mutex_);
  if (what == "lost") {
    auto node = ParseLostNode(line);
    if (!node) return false;
    lost_.push_back(std::move(*node));
  } else if (what == "said") {
    auto word = ParseLastWord(line);
    if (!word) return false;
    last_words_.push_back(std::move(*word));
  } else if (what == "do") {
    commands_.emplace_back(line);
  } else if (what == "abort") {
    must_abort_ = true;
  } else {
    return false;
  }
  return true;
}

std::vector<LostNode> SupervisorPipe::TakeLost() {
  const std::lock_guard lock(mutex_);
  return std::exchange(lost_, {});
}

std::vector<LastWord> SupervisorPipe::TakeLastWords() {
  const std::lock_guard lock(mutex_);
  return std::exchange(last_words_, {});
}

std::vector<std::string> SupervisorPipe::TakeCommands() {
  const std::lock_guard lock(mutex_);
  return std::exchange(commands_, {});
}

bool SupervisorPipe::must_abort() const {
  const std::lock_guard lock(mutex_);
  return must_abort_;
}

bool SupervisorPipe::is_closed() const {
  const std::lock_guard lock(mutex_);
  return is_closed_;
}

bool SupervisorPipe::is_waiting() const {
  const std::lock_guard lock(mutex_);
  return !lost_.empty() || !last_words_.empty() || !commands_.empty() || must_abort_;
}

}  // namespace rodeira::dds
