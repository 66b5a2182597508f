// SPDX-License-Identifier: Apache-2.0
#include "launch/rodeira/run/part_log.hpp"

#include <spdlog/logger.h>
#include <spdlog/sinks/rotating_file_sink.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <string_view>
#include <utility>

#include "common/core/base/exhaustion_text.hpp"
#include "common/runtime/dds/supervisor_pipe.hpp"

namespace rodeira::cli {
namespace {

constexpr std::size_t kMaxFileBytes = 1u << 20;
constexpr std::size_t kOlderFiles = 3;
constexpr std::size_t kMaxLineBytes = 64u << 10;  // longer lines are cut in pieces
constexpr std::string_view kCrash = "rodeira: crash: ";

spdlog::level::level_enum LevelOf(const std::string& line) {
  if (line.find("crash:") != std::string::npos) return spdlog::level::critical;
  if (line.find("warning:") != std::string::npos) return spdlog::level::warn;
  if (line.find("info:") != std::string::npos) return spdlog::level::info;
  return line.starts_with("rodeira") ? spdlog::level::err : spdlog::level::info;
}

// Written by base::TraceCrashes, by a node that ends, and by Fast DDS: for the log and the report of the failure, too
// much for a terminal.
bool IsForLogAlone(const std::string& line) {
  return line.starts_with(kCrash) || line.starts_with(dds::kLastWord) || line.starts_with(dds::kLastWordOfNode) ||
         line.starts_with("rodeira: Fast DDS: ") || (line.ends_with(']') && line.find(")[0x") != std::string::npos);
}

// What base::TraceCrashes says of foreign code; empty if the line says nothing of it.
std::string CrashPlace(std::string_view line) {
  if (!line.starts_with(kCrash)) return {};
  const auto in = line.find(" in ");
  if (in == std::string_view::npos) return {};
  line.remove_prefix(in + 4);
  return std::string(line.substr(0, line.rfind("; backtrace:")));
}

// Of a process with several nodes; empty if the line says nothing of it.
std::string CrashNode(std::string_view line) {
  constexpr std::string_view kNode = "rodeira: crash: node '";
  if (!line.starts_with(kNode) || !line.ends_with('\'')) return {};
  line.remove_prefix(kNode.size());
  line.remove_suffix(1);
  return std::string(line);
}

// Null if the file cannot be opened.
std::shared_ptr<spdlog::logger> OpenFile(const std::filesystem::path& folder, const std::string& part) {
  std::error_code problem;
  std::filesystem::create_directories(folder, problem);
  try {
    auto sink = std::make_shared<spdlog::sinks::rotating_file_sink_st>((folder / (part + ".log")).string(),
                                                                       kMaxFileBytes, kOlderFiles);
    auto logger = std::make_shared<spdlog::logger>(part, std::move(sink));
    logger->set_pattern("%Y-%m-%dT%H:%M:%S.%e%z %-8l %v");
    logger->flush_on(spdlog::level::trace);
    logger->set_error_handler([](const std::string&) {});  // a full disk does not end a run
    return logger;
  } catch (const spdlog::spdlog_ex&) {
    return nullptr;
  }
}

}  // namespace

PartLog::PartLog(const std::string& part, std::filesystem::path folder, std::shared_ptr<bool> exhaustion_told)
    : part_(part), folder_(std::move(folder)), exhaustion_told_(std::move(exhaustion_told)) {}

void PartLog::Read(int descriptor) {
  std::array<char, 4096> buffer;
  for (ssize_t size = 0; (size = ::read(descriptor, buffer.data(), buffer.size())) > 0;) {
    rest_.append(buffer.data(), static_cast<std::size_t>(size));
    std::size_t begin = 0;
    for (std::size_t end = 0; (end = rest_.find('\n', begin)) != std::string::npos; begin = end + 1)
      Take(rest_.substr(begin, end - begin));
    rest_.erase(0, begin);
    if (rest_.size() > kMaxLineBytes) Finish();
  }
  std::fflush(stderr);
}

std::string PartLog::LastWordOf(const std::string& node) const {
  const auto found =
      std::ranges::find_if(last_words_, [&](const LastWord& word) { return word.node.empty() || word.node == node; });
  return found == last_words_.end() ? "" : found->text;
}

bool PartLog::TakeLastWord(std::string_view line) {
  if (line.starts_with(dds::kLastWord)) {
    last_words_ = {{"", std::string(line.substr(dds::kLastWord.size()))}};
    return true;
  }
  const auto end = line.find("': ");
  if (!line.starts_with(dds::kLastWordOfNode) || end == std::string_view::npos) return false;
  line.remove_prefix(dds::kLastWordOfNode.size());
  const auto size = end - dds::kLastWordOfNode.size();
  last_words_.push_back({std::string(line.substr(0, size)), std::string(line.substr(size + 3))});
  return true;
}

void PartLog::Finish() {
  if (!rest_.empty()) Take(std::exchange(rest_, {}));
}

bool PartLog::IsPassedOn(const std::string& line) {
  if (IsForLogAlone(line)) return false;
  const bool is_exhaustion =
      line.find(base::kNoMemoryText) != std::string::npos || line.find(base::kNoThreadText) != std::string::npos;
  return !is_exhaustion || !exhaustion_told_ || !std::exchange(*exhaustion_told_, true);
}

void PartLog::Take(std::string line) {
  const bool is_last_word = TakeLastWord(line);
  if (!is_opened_ && !is_last_word) {  // the run says the same: no file begins with it
    file_ = OpenFile(folder_, part_);
    is_opened_ = true;
  }
  if (file_) file_->log(LevelOf(line), line);
  if (IsPassedOn(line)) std::fprintf(stderr, "%s\n", line.c_str());
  if (auto node = CrashNode(line); !node.empty()) {
    crash_node_ = std::move(node);
  } else if (auto place = CrashPlace(line); !place.empty()) {
    crash_place_ = std::move(place);
  }
  last_lines_.push_back(std::move(line));
  if (last_lines_.size() > kLastLines) last_lines_.pop_front();
}

}  // namespace rodeira::cli
