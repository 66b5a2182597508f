// SPDX-License-Identifier: Apache-2.0
// Domains that runs hold, and room in shared memory, in a place of the test's own.
#include "launch/rodeira/run/domains.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <functional>

#include "common/runtime/dds/shared_memory_room.hpp"
#include "launch/rodeira/run/host_hold.hpp"
#include "launch/rodeira/run/run_network.hpp"
#include "tests/launch/rodeira/temporary_folder.hpp"

namespace rodeira::cli {
namespace {

using ::testing::HasSubstr;

// A name with a preferred domain that fits.
std::string NameOf(const std::string& begin, const std::function<bool(std::uint32_t)>& fits) {
  for (int i = 0;; ++i) {
    const std::string name = begin + std::to_string(i);
    if (fits(PreferredDomain(name))) return name;
  }
}

// Of this test alone.
class Domains : public ::testing::Test {
 protected:
  static constexpr std::uint32_t kWanted = 77;
  const TemporaryFolder folder_;
  const DomainPlace place_{folder_.path(), "rodeira/test/" + std::to_string(::getpid()) + "/"};
};

TEST_F(Domains, TwoNamesThatPreferTheSameGetNeighbours) {
  const auto is_wanted = [](std::uint32_t domain) { return domain == kWanted; };
  const std::string one = NameOf("one ", is_wanted), second = NameOf("other ", is_wanted);
  auto first_hold = DomainHold::FindFree(one, place_);
  ASSERT_TRUE(first_hold.ok()) << first_hold.error().Text();
  EXPECT_EQ(first_hold.value().domain(), kWanted);
  {
    const auto second_hold = DomainHold::FindFree(second, place_);
    ASSERT_TRUE(second_hold.ok()) << second_hold.error().Text();
    EXPECT_EQ(second_hold.value().domain(), kWanted + 1);
  }
  { const DomainHold ended = std::move(first_hold).value(); }
  const auto again = DomainHold::FindFree(second, place_);
  ASSERT_TRUE(again.ok());
  EXPECT_EQ(again.value().domain(), kWanted) << "the first run has ended";
}

TEST_F(Domains, PortsInSharedMemoryKeepOthersAway) {
  const auto port = [](std::uint32_t domain, std::uint32_t offset) {
    return std::to_string(7400 + 250 * domain + offset);
  };
  const std::string name = NameOf("run ", [](std::uint32_t domain) { return domain == kWanted; });
  folder_.Write("fastrtps_port" + port(kWanted, 0), "x");
  folder_.Write("sem.fastrtps_port" + port(kWanted + 1, 249) + "_mutex", "x");
  folder_.Write("fastrtps_0123456789abcdef", "a segment has no domain");
  const auto hold = DomainHold::FindFree(name, place_);
  ASSERT_TRUE(hold.ok());
  EXPECT_EQ(hold.value().domain(), kWanted + 2);
}

TEST_F(Domains, BehindTheLastOneComesTheFirst) {
  for (std::uint32_t domain = 2; domain <= 200; ++domain)
    folder_.Write("fastrtps_port" + std::to_string(7400 + 250 * domain), "x");
  const std::string name = NameOf("run ", [](std::uint32_t domain) { return domain == 200; });
  {
    const auto hold = DomainHold::FindFree(name, place_);
    ASSERT_TRUE(hold.ok()) << hold.error().Text();
    EXPECT_EQ(hold.value().domain(), 1u);
  }
  folder_.Write("fastrtps_port" + std::to_string(7400 + 250), "x");
  const auto none = DomainHold::FindFree(name, place_);
  ASSERT_FALSE(none.ok());
  EXPECT_EQ(none.error().exit_status(), 2);
  EXPECT_THAT(none.error().Text(), HasSubstr("all DDS domains from 1 to 200 are in use on this PC"));
}

TEST_F(Domains, TheKernelReleasesThatOfAKilledProcess) {
  std::array<int, 2> ends{};
  ASSERT_EQ(::pipe(ends.data()), 0);
  const pid_t holder = ::fork();
  if (holder == 0) {
    const auto hold = DomainHold::Take(kWanted, place_);
    const char taken = hold ? 'y' : 'n';
    [[maybe_unused]] const ssize_t written = ::write(ends[1], &taken, 1);
    for (;;) ::pause();
  }
  char taken = '?';
  ASSERT_EQ(::read(ends[0], &taken, 1), 1);
  EXPECT_EQ(taken, 'y');
  EXPECT_FALSE(DomainHold::Take(kWanted, place_));
  ::kill(holder, SIGKILL);
  ::waitpid(holder, nullptr, 0);
  EXPECT_TRUE(DomainHold::Take(kWanted, place_));
  for (const int end : ends) ::close(end);
}

TEST_F(Domains, AnotherUserIsNamed) {
  const auto file = folder_.Write("fastrtps_port" + std::to_string(7400 + 250 * 210 + 13), "x");
  EXPECT_FALSE(OtherUserOf(210, place_)) << "one's own file";
  if (::geteuid() != 0) GTEST_SKIP() << "only root may give a file to another user";
  ASSERT_EQ(::chown(file.c_str(), 61234, 61234), 0);
  EXPECT_EQ(OtherUserOf(210, place_), file.string() + " of domain 210 belongs to user number 61234");
  EXPECT_FALSE(OtherUserOf(209, place_));
  EXPECT_FALSE(OtherUserOf(211, place_));
}

TEST_F(Domains, AHostOfARunIsHeldOnce) {
  const auto first = HoldHost(kWanted, "rig", "left", place_);
  ASSERT_TRUE(first.ok()) << first.error().Text();
  const auto again = HoldHost(kWanted, "rig", "left", place_);
  ASSERT_FALSE(again.ok());
  EXPECT_EQ(again.error().exit_status(), 2);
  EXPECT_THAT(again.error().Text(),
              ::testing::AllOf(HasSubstr("run 'rig' in domain 77: host 'left' of this run is started already on this "
                                         "PC, by process " +
                                         std::to_string(::getpid())),
                               HasSubstr("of user " + UserName(::geteuid()))));
  EXPECT_TRUE(HoldHost(kWanted, "rig", "right", place_).ok()) << "another host on the same PC";
  EXPECT_TRUE(HoldHost(kWanted, "other", "left", place_).ok()) << "another run in the same domain";
  EXPECT_TRUE(HoldHost(kWanted + 1, "rig", "left", place_).ok()) << "the same name in another domain";
  EXPECT_TRUE(DomainHold::Take(kWanted, place_)) << "a domain is another thing than a host";
}

// The largest one: a step of 256 KiB more has no room.
TEST(SharedMemoryRoom, ASegmentFitsForEachProcess) {
  EXPECT_EQ(SegmentThatFits(1'000'000'000, 7), 8192u);
  for (const std::uint64_t free_bytes : {16'000'000u, 32'000'000u, 48'000'000u}) {
    const std::uint32_t segment_kib = SegmentThatFits(free_bytes, 7);
    ASSERT_GE(segment_kib, 1024u) << free_bytes;
    EXPECT_LE(7 * dds::SharedMemoryNeed(segment_kib), free_bytes);
    EXPECT_GT(7 * dds::SharedMemoryNeed(segment_kib + 256), free_bytes);
  }
  EXPECT_EQ(SegmentThatFits(8'000'000, 7), 0u);
  EXPECT_EQ(SegmentThatFits(0, 1), 0u);
}

// Processes that want less keep what they want; only the larger segments shrink.
TEST(SharedMemoryRoom, OnlySegmentsAboveTheLargestThatFitsShrink) {
  const std::vector<std::uint32_t> segments_kib{1024, 1024, 2048, 8192};
  const auto need = [](std::uint32_t most_kib) {
    return 2 * dds::SharedMemoryNeed(1024) + dds::SharedMemoryNeed(std::min(2048u, most_kib)) +
           dds::SharedMemoryNeed(most_kib);
  };
  EXPECT_EQ(SegmentThatFits(need(8192), segments_kib), 8192u);
  EXPECT_EQ(SegmentThatFits(need(8192) - 1, segments_kib), 7936u);
  EXPECT_EQ(SegmentThatFits(need(1280), segments_kib), 1280u);
  EXPECT_EQ(SegmentThatFits(need(1024), segments_kib), 1024u);
  EXPECT_EQ(SegmentThatFits(need(1024) - 1, segments_kib), 0u);
}

TEST(SharedMemoryRoom, MoreThanTheFolderHasIsRefusedAndNothingIsLeft) {
  const TemporaryFolder folder;
  EXPECT_TRUE(dds::TryRoom(1'000'000, folder.path()).ok());
  const auto status = dds::TryRoom(std::uint64_t{1} << 60, folder.path());
  ASSERT_FALSE(status.ok());
  EXPECT_THAT(status.error().Text(), HasSubstr("shared memory is full: "));
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
  EXPECT_FALSE(dds::CheckSpace(1, folder.path() / "missing").ok());
}

}  // namespace
}  // namespace rodeira::cli
