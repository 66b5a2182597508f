// SPDX-License-Identifier: Apache-2.0
#include "common/runtime/dds/reader_listeners.hpp"

#include <fastdds/rtps/reader/RTPSReader.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <memory>
#include <thread>
#include <utility>

#include "common/runtime/dds/participant.hpp"
#include "idl/topics.hpp"

namespace {

using namespace std::chrono_literals;

// 0: nothing is held up; 1: the next thread that looks for a user's listener is; 2: one is; 3: it has gone on.
std::atomic<int> g_state = 0;
const std::thread::id g_main = std::this_thread::get_id();
constexpr std::uint8_t kUserReader = 0x04;  // RTPS 2.3, 9.3.1.2

}  // namespace

namespace eprosima::fastrtps::rtps {

// In place of the library's: the thread that matches a reader with a writer looks whether it has a listener, and is
// held up here until another thread has taken that listener away.
__attribute__((no_sanitize("thread"))) ReaderListener* RTPSReader::getListener() const {
  ReaderListener* const found = mp_listener;
  int armed = 1;
  if (m_guid.entityId.value[3] != kUserReader || std::this_thread::get_id() == g_main ||
      !g_state.compare_exchange_strong(armed, 2))
    return found;
  const auto until = std::chrono::steady_clock::now() + 10s;
  while (const_cast<ReaderListener* const volatile&>(mp_listener) == found && std::chrono::steady_clock::now() < until)
    std::this_thread::yield();
  g_state = 3;
  return found;
}

}  // namespace eprosima::fastrtps::rtps

namespace rodeira::dds {
namespace {

TEST(ReaderListeners, AreThoseOfTheWholeProgram) { EXPECT_TRUE(DeletedReadersHaveListeners()); }

TEST(ReaderListeners, AReaderCanBeDeletedWhileItIsMatched) {
  DomainSettings settings;
  settings.domain = 218;
  settings.run = "listeners" + std::to_string(::getpid());
  settings.name = "reads";
  settings.delivers_within = false;
  const auto reads = Participant::Open(settings);
  ASSERT_TRUE(reads.ok()) << reads.error().Text();
  settings.name = "writes";
  const auto writes = Participant::Open(settings);
  ASSERT_TRUE(writes.ok()) << writes.error().Text();
  auto reader = reads.value()->MakeReader(idl::topics::kNack, Delivery::kBestEffortRepeated, [](base::Bytes&&) {});
  ASSERT_TRUE(reader.ok()) << reader.error().Text();
  g_state = 1;
  const auto writer = writes.value()->MakeWriter(idl::topics::kNack, Delivery::kBestEffortRepeated);
  ASSERT_TRUE(writer.ok()) << writer.error().Text();
  const auto until = std::chrono::steady_clock::now() + 20s;
  while (g_state != 2 && std::chrono::steady_clock::now() < until) std::this_thread::yield();
  ASSERT_EQ(g_state, 2) << "they have not met";
  reader.value().reset();  // waits for the thread that matches it
  EXPECT_EQ(g_state, 3);
}

}  // namespace
}  // namespace rodeira::dds
