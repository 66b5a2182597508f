// SPDX-License-Identifier: Apache-2.0
#include "common/runtime/dds/participant_qos.hpp"

#include <fastdds/rtps/attributes/ServerAttributes.h>
#include <fastdds/rtps/transport/UDPv4TransportDescriptor.h>
#include <fastdds/rtps/transport/shared_mem/SharedMemTransportDescriptor.h>
#include <fastrtps/utils/IPLocator.h>
#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <random>

#include "common/core/base/hash.hpp"

namespace rodeira::dds {
namespace {

namespace fdds = eprosima::fastdds::dds;
namespace rtps = eprosima::fastdds::rtps;
using eprosima::fastrtps::Duration_t;
using eprosima::fastrtps::rtps::GuidPrefix_t;
using eprosima::fastrtps::rtps::IPLocator;
using eprosima::fastrtps::rtps::Locator_t;

// Shared memory: the defaults (segments of 512 KiB, 512 messages) are full after a few hundred unread samples, and full
// means lost until a heartbeat. launch::TransportSettings::kSegmentKib and this hold two windows of all sources.
constexpr std::uint32_t kPortQueue = 4096;
constexpr std::uint32_t kSocketBufferBytes = 4u << 20;

Locator_t UdpLocator(const std::string& address, std::uint16_t port) {
  Locator_t locator;
  locator.kind = LOCATOR_KIND_UDPv4;
  IPLocator::setIPv4(locator, address);
  IPLocator::setPhysicalPort(locator, port);
  return locator;
}

// Clients must know it beforehand. Made from run and domain: the server of another run does not answer.
GuidPrefix_t ServerPrefix(const DomainSettings& settings) {
  const base::Digest digest = base::Hash(fmt::format("{} {}", settings.domain, settings.run));
  GuidPrefix_t prefix;
  prefix.value[0] = 0x01;  // the library's vendor id
  prefix.value[1] = 0x0F;
  for (int i = 0; i < 8; ++i) prefix.value[2 + i] = static_cast<unsigned char>(digest >> (8 * i));
  prefix.value[10] = 'R';
  prefix.value[11] = 'o';
  return prefix;
}

std::shared_ptr<rtps::UDPv4TransportDescriptor> UdpTransport(const DomainSettings& settings) {
  auto udp = std::make_shared<rtps::UDPv4TransportDescriptor>();
  udp->sendBufferSize = kSocketBufferBytes;
  udp->receiveBufferSize = kSocketBufferBytes;
  if (settings.discovery.kind == launch::DiscoveryKind::kPeers)
    udp->maxInitialPeersRange = settings.discovery.participants;
  if (!settings.discovery.interface.empty()) udp->interfaceWhiteList.push_back(settings.discovery.interface);
  return udp;
}

// The port of shared memory on which all participants listen for each other is out of order for seconds after one of
// them was killed: every newcomer finds it broken and makes its own. Processes that may be started again meet over UDP
// instead; samples go through ports that belong to one process each.
void MeetOverUdp(const DomainSettings& settings, fdds::DomainParticipantQos& qos) {
  auto& builtin = qos.wire_protocol().builtin;
  builtin.metatrafficUnicastLocatorList.push_back(settings.has_observers ? Locator_t() : UdpLocator("127.0.0.1", 0));
  builtin.metatrafficMulticastLocatorList.push_back(
      UdpLocator("239.255.0.1", static_cast<std::uint16_t>(7400 + 250 * settings.domain)));
}

void SetTransport(const DomainSettings& settings, fdds::DomainParticipantQos& qos) {
  qos.transport().use_builtin_transports = false;
  auto& transports = qos.transport().user_transports;
  if (settings.transport == launch::Transport::kUdp) {
    transports.push_back(UdpTransport(settings));
    return;
  }
  auto shared = std::make_shared<rtps::SharedMemTransportDescriptor>();
  shared->segment_size(settings.segment_kib << 10);
  shared->port_queue_capacity(kPortQueue);
  transports.push_back(shared);
  if (settings.has_observers) {
    transports.push_back(UdpTransport(settings));
  } else if (settings.meets_later) {
    auto loopback = std::make_shared<rtps::UDPv4TransportDescriptor>();
    loopback->interfaceWhiteList.emplace_back("127.0.0.1");
    transports.push_back(loopback);
  }
  if (settings.meets_later) MeetOverUdp(settings, qos);
}

// Fast DDS 2.9.1 makes a port of shared memory anew where its owner has died, while its writers go on writing
// to the old one and are never heard again (its pull request 4728). So a process that takes the place of a dead one
// takes a number with ports that no process, dead or alive, has had.
int UnusedParticipant(std::uint32_t domain) {
  constexpr int kFirst = 30, kNumbers = 80;  // the library counts from 0; number 119 is a domain's last
  const auto is_used = [&](int number, int which) {
    const auto port =
        7400 + 250 * domain + 10 + 2 * static_cast<std::uint32_t>(number) + static_cast<std::uint32_t>(which);
    std::error_code problem;
    return std::filesystem::exists(fmt::format("/dev/shm/fastrtps_port{}", port), problem);
  };
  std::random_device rng;  // two processes that start at once try different numbers
  const int begin = static_cast<int>(rng() % kNumbers);
  for (int i = 0; i < kNumbers; ++i) {
    const int number = kFirst + (begin + i) % kNumbers;
    if (!is_used(number, 0) && !is_used(number, 1)) return number;
  }
  return -1;  // as the library likes
}

void SetDiscovery(const DomainSettings& settings, fdds::DomainParticipantQos& qos) {
  const launch::Discovery& wanted = settings.discovery;
  auto& builtin = qos.wire_protocol().builtin;
  auto& discovery = builtin.discovery_config;
  // The lockstep has its own heartbeat; a lease that runs out under load would only tear matched endpoints apart.
  discovery.leaseDuration = Duration_t{20, 0};
  discovery.leaseDuration_announcementperiod = Duration_t{1, 0};
  discovery.initial_announcements.count = 20;
  discovery.initial_announcements.period = Duration_t{0, 50u * kNanosecondsPerMillisecond};
  if (wanted.kind == launch::DiscoveryKind::kMulticast) return;
  if (wanted.kind == launch::DiscoveryKind::kPeers) {
    builtin.metatrafficUnicastLocatorList.push_back(Locator_t());  // any address and port of ours, and no multicast
    for (const std::string& address : wanted.addresses) builtin.initialPeersList.push_back(UdpLocator(address, 0));
    return;
  }
  discovery.discoveryServer_client_syncperiod = Duration_t{0, 100u * kNanosecondsPerMillisecond};
  const Locator_t server = UdpLocator(wanted.address, wanted.port);
  if (settings.serves_discovery) {
    discovery.discoveryProtocol = eprosima::fastrtps::rtps::DiscoveryProtocol_t::SERVER;
    qos.wire_protocol().prefix = ServerPrefix(settings);
    builtin.metatrafficUnicastLocatorList.push_back(server);
    return;
  }
  builtin.metatrafficUnicastLocatorList.push_back(Locator_t());
  discovery.discoveryProtocol = eprosima::fastrtps::rtps::DiscoveryProtocol_t::CLIENT;
  rtps::RemoteServerAttributes remote;
  remote.guidPrefix = ServerPrefix(settings);
  remote.metatrafficUnicastLocatorList.push_back(server);
  discovery.m_DiscoveryServers.push_back(remote);
}

}  // namespace

fdds::DomainParticipantQos ParticipantQos(const DomainSettings& settings) {
  fdds::DomainParticipantQos qos;
  qos.name(settings.name.c_str());
  if (settings.is_restarted && settings.transport == launch::Transport::kSharedMemory) {
    qos.wire_protocol().participant_id = UnusedParticipant(settings.domain);
  }
  SetTransport(settings, qos);
  SetDiscovery(settings, qos);
  return qos;
}

}  // namespace rodeira::dds
