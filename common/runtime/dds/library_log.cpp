// SPDX-License-Identifier: Apache-2.0
#include "common/runtime/dds/library_log.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <fastdds/dds/log/Log.hpp>
#include <memory>
#include <mutex>
#include <string>

namespace rodeira::dds {
namespace {

namespace fdds = eprosima::fastdds::dds;

class LineWriter final : public fdds::LogConsumer {
 public:
  void Consume(const fdds::Log::Entry& entry) override {
    if (::isatty(STDERR_FILENO) != 0) return;
    std::string message = entry.message;
    std::ranges::replace(message, '\n', ' ');
    const std::string line = fmt::format("rodeira: Fast DDS: {}: {}\n",
                                         entry.context.category == nullptr ? "" : entry.context.category, message);
    [[maybe_unused]] const ssize_t written = ::write(STDERR_FILENO, line.data(), line.size());
  }
};

}  // namespace

void RedirectLibraryLog() {
  static std::once_flag once;
  std::call_once(once, [] {
    fdds::Log::ClearConsumers();
    fdds::Log::RegisterConsumer(std::make_unique<LineWriter>());
    fdds::Log::SetVerbosity(fdds::Log::Kind::Error);
  });
}

}  // namespace rodeira::dds
