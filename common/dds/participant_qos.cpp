#include "common/dds/participant_qos.hpp"

#include <fastdds/rtps/attributes/ServerAttributes.h>
#include <fastdds/rtps/transport/UDPv4TransportDescriptor.h>
#include <fastdds/rtps/transport/shared_mem/SharedMemTransportDescriptor.h>
#include <fastrtps/utils/IPLocator.h>
#include <fmt/format.h>

#include <memory>

#include "common/base/hash.hpp"

namespace rodeira::dds {
namespace {

namespace fdds = eprosima::fastdds::dds;
namespace rtps = eprosima::fastdds::rtps;
using eprosima::fastrtps::Duration_t;
using eprosima::fastrtps::rtps::GuidPrefix_t;
using eprosima::fastrtps::rtps::IPLocator;
using eprosima::fastrtps::rtps::Locator_t;

constexpr int kMilli = 1'000'000;  // nanoseconds

// Shared memory: the defaults (512 KiB, 512 messages) are full after a few hundred unread samples, and full means lost
// until a heartbeat; sized for two windows of all sources.
constexpr std::uint32_t kSegmentBytes = 8u << 20;
constexpr std::uint32_t kPortQueue = 4096;
constexpr std::uint32_t kSocketBufferBytes = 4u << 20;

Locator_t UdpLocator(const std::string& address, std::uint16_t port) {
  Locator_t locator;
  locator.kind = LOCATOR_KIND_UDPv4;
  IPLocator::setIPv4(locator, address);
  IPLocator::setPhysicalPort(locator, port);
  return locator;
}

// Clients must know it beforehand. Drawn from run and domain: who asks the server of another run is not answered.
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

void SetTransport(const DomainSettings& settings, fdds::DomainParticipantQos& qos) {
  qos.transport().use_builtin_transports = false;
  if (settings.transport == launch::Transport::kSharedMemory) {
    auto shared = std::make_shared<rtps::SharedMemTransportDescriptor>();
    shared->segment_size(kSegmentBytes);
    shared->port_queue_capacity(kPortQueue);
    qos.transport().user_transports.push_back(shared);
    return;
  }
  auto udp = std::make_shared<rtps::UDPv4TransportDescriptor>();
  udp->sendBufferSize = kSocketBufferBytes;
  udp->receiveBufferSize = kSocketBufferBytes;
  if (settings.discovery.kind == launch::DiscoveryKind::kPeers) udp->maxInitialPeersRange = settings.discovery.participants;
  if (!settings.discovery.interface.empty()) udp->interfaceWhiteList.push_back(settings.discovery.interface);
  qos.transport().user_transports.push_back(udp);
}

void SetDiscovery(const DomainSettings& settings, fdds::DomainParticipantQos& qos) {
  const launch::Discovery& wish = settings.discovery;
  auto& builtin = qos.wire_protocol().builtin;
  auto& discovery = builtin.discovery_config;
  // The lockstep has its own heartbeat; a lease that runs out under load would only tear matched endpoints apart.
  discovery.leaseDuration = Duration_t{20, 0};
  discovery.leaseDuration_announcementperiod = Duration_t{1, 0};
  discovery.initial_announcements.count = 20;
  discovery.initial_announcements.period = Duration_t{0, 50u * kMilli};
  if (wish.kind == launch::DiscoveryKind::kMulticast) return;
  if (wish.kind == launch::DiscoveryKind::kPeers) {
    builtin.metatrafficUnicastLocatorList.push_back(Locator_t());  // any address and port of ours, and no multicast
    for (const std::string& address : wish.addresses) builtin.initialPeersList.push_back(UdpLocator(address, 0));
    return;
  }
  discovery.discoveryServer_client_syncperiod = Duration_t{0, 100u * kMilli};
  const Locator_t server = UdpLocator(wish.address, wish.port);
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
  SetTransport(settings, qos);
  SetDiscovery(settings, qos);
  return qos;
}

}  // namespace rodeira::dds
