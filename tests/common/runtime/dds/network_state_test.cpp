// SPDX-License-Identifier: Apache-2.0
#include "common/runtime/dds/network_state.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace rodeira::dds {
namespace {

using launch::Transport;
using ::testing::HasSubstr;

NetworkNeed Need(Transport kind, bool has_observers = false) { return {{kind, has_observers, 8192}, "", false}; }

const NetworkState kNothing;
const NetworkState kLoopBackAlone{{"127.0.0.1"}, {}, true};
const NetworkState kCable{{"127.0.0.1", "10.77.0.1"}, {}, true};
const NetworkState kIpv6{{}, {"eth0"}, true};

TEST(NetworkProblem, SharedMemoryNeedsNoNetwork) {
  EXPECT_FALSE(NetworkProblem(Need(Transport::kSharedMemory), kNothing));
}

TEST(NetworkProblem, RestartsNeedTheLoopBackInterface) {
  NetworkNeed need = Need(Transport::kSharedMemory);
  need.meets_later = true;
  EXPECT_FALSE(NetworkProblem(need, kLoopBackAlone));
  EXPECT_THAT(NetworkProblem(need, kNothing).value_or(""),
              HasSubstr("the loop-back interface has no address 127.0.0.1"));
  EXPECT_TRUE(NetworkProblem(need, {{"10.77.0.1"}, {}, false})) << "a cable is not enough";
}

TEST(NetworkProblem, UdpNeedsAnIpv4Address) {
  for (const NetworkNeed& need : {Need(Transport::kUdp), Need(Transport::kSharedMemory, true)}) {
    EXPECT_FALSE(NetworkProblem(need, kLoopBackAlone));
    EXPECT_FALSE(NetworkProblem(need, kCable));
    EXPECT_THAT(NetworkProblem(need, kNothing).value_or(""), HasSubstr("no running interface of this PC has an IPv4"));
    EXPECT_THAT(NetworkProblem(need, kIpv6).value_or(""), HasSubstr("(with IPv6 alone: eth0)"));
  }
}

TEST(NetworkProblem, TheNamedInterfaceRuns) {
  NetworkNeed need = Need(Transport::kUdp);
  need.interface = "10.77.0.1";
  EXPECT_FALSE(NetworkProblem(need, kCable));
  EXPECT_THAT(NetworkProblem(need, kLoopBackAlone).value_or(""),
              HasSubstr("no running interface of this PC has the address 10.77.0.1"));
}

TEST(NetworkProblem, UdpOnOnePcNeedsTheLoopBackInterfaceToo) {
  NetworkNeed need = Need(Transport::kUdp);
  for (const char* interface : {"", "10.77.0.1"}) {
    need.interface = interface;
    EXPECT_THAT(NetworkProblem(need, {{"10.77.0.1"}, {}, false}).value_or(""),
                HasSubstr("the loop-back interface is down"));
  }
}

}  // namespace
}  // namespace rodeira::dds
