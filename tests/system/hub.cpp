// SPDX-License-Identifier: Apache-2.0
#include "tests/system/hub.hpp"

#include <arpa/inet.h>
#include <fcntl.h>
#include <linux/if_packet.h>
#include <net/ethernet.h>
#include <net/if.h>
#include <poll.h>
#include <sched.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <queue>
#include <random>

namespace rodeira::system_test {
namespace {

using WallClock = std::chrono::steady_clock;

// struct virtio_net_hdr of the kernel; its own header is no C++.
struct FrameHeader {
  std::uint8_t flags, gso_type;
  std::uint16_t header_length, gso_size, checksum_start, checksum_offset;
};
static_assert(sizeof(FrameHeader) == 10);

struct Frame {
  WallClock::time_point due;
  std::uint64_t number = 0;
  int to = -1;  // socket
  std::vector<char> bytes;
  bool operator<(const Frame& other) const { return due != other.due ? due > other.due : number > other.number; }
};

// A raw socket on an interface of the thread's namespace. Frames carry a header in front that tells of checksums which
// the kernel has not computed yet, so they pass on as they are.
int OpenInterface(const std::string& interface) {
  const int socket = ::socket(AF_PACKET, SOCK_RAW | SOCK_CLOEXEC | SOCK_NONBLOCK, htons(ETH_P_ALL));
  if (socket < 0) return -1;
  const int yes = 1, buffer = 8 << 20;
  sockaddr_ll where{};
  where.sll_family = AF_PACKET;
  where.sll_protocol = htons(ETH_P_ALL);
  where.sll_ifindex = static_cast<int>(::if_nametoindex(interface.c_str()));
  ::setsockopt(socket, SOL_SOCKET, SO_RCVBUFFORCE, &buffer, sizeof(buffer));
  ::setsockopt(socket, SOL_SOCKET, SO_SNDBUFFORCE, &buffer, sizeof(buffer));
  if (::setsockopt(socket, SOL_PACKET, PACKET_VNET_HDR, &yes, sizeof(yes)) != 0 ||
      ::setsockopt(socket, SOL_PACKET, PACKET_IGNORE_OUTGOING, &yes, sizeof(yes)) != 0 ||
      ::bind(socket, reinterpret_cast<const sockaddr*>(&where), sizeof(where)) != 0) {
    ::close(socket);
    return -1;
  }
  return socket;
}

bool IsMulticast(const char* destination) {
  static constexpr unsigned char kBroadcast[6] = {0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF};
  return (destination[0] & 1) != 0 && std::memcmp(destination, kBroadcast, 6) != 0;
}

}  // namespace

Hub::Hub(const std::string& netns, const std::vector<std::string>& interfaces, const Weather& weather) {
  std::thread([&] { Open(netns, interfaces); }).join();  // a thread's namespace is its own; the sockets stay in it
  if (problem_.empty()) thread_ = std::thread([this, weather] { Repeat(weather); });
}

Hub::~Hub() {
  stop_ = true;
  if (thread_.joinable()) thread_.join();
  for (const int socket : sockets_) ::close(socket);
}

void Hub::Open(const std::string& netns, const std::vector<std::string>& interfaces) {
  const int space = ::open(("/run/netns/" + netns).c_str(), O_RDONLY | O_CLOEXEC);
  if (space < 0 || ::setns(space, CLONE_NEWNET) != 0)
    problem_ = std::string("no thread can enter a network namespace: ") + std::strerror(errno);
  if (space >= 0) ::close(space);
  if (!problem_.empty()) return;
  for (const std::string& interface : interfaces) {
    sockets_.push_back(OpenInterface(interface));
    if (sockets_.back() < 0) problem_ = std::string("no raw socket can be made: ") + std::strerror(errno);
  }
}

void Hub::Repeat(const Weather& weather) {
  std::mt19937_64 rng(20260131);
  std::uniform_real_distribution<double> share(0.0, 1.0);
  std::priority_queue<Frame> waiting;
  std::uint64_t number = 0;
  char buffer[sizeof(FrameHeader) + 70000];
  while (!stop_) {
    std::vector<pollfd> polled;
    for (const int socket : sockets_) polled.push_back({socket, POLLIN, 0});
    std::chrono::nanoseconds limit = std::chrono::milliseconds(20);
    if (!waiting.empty())
      limit = std::clamp<std::chrono::nanoseconds>(waiting.top().due - WallClock::now(), std::chrono::nanoseconds(0),
                                                   limit);
    const timespec patience{0, limit.count()};
    ::ppoll(polled.data(), polled.size(), &patience, nullptr);
    for (const int from : sockets_) {
      for (ssize_t size = ::recv(from, buffer, sizeof(buffer), 0); size > 0;
           size = ::recv(from, buffer, sizeof(buffer), 0)) {
        if (size < static_cast<ssize_t>(sizeof(FrameHeader) + ETH_HLEN)) continue;
        if (!weather.multicast && IsMulticast(buffer + sizeof(FrameHeader))) {
          ++multicast_refused_;
          continue;
        }
        for (const int to : sockets_) {
          if (to == from) continue;
          if (share(rng) < weather.loss) {
            ++lost_;
            continue;
          }
          const std::chrono::nanoseconds late(
              static_cast<std::int64_t>(share(rng) * 1e3 * static_cast<double>(weather.jitter.count())));
          waiting.push({WallClock::now() + late, ++number, to, std::vector<char>(buffer, buffer + size)});
        }
      }
    }
    for (; !waiting.empty() && waiting.top().due <= WallClock::now(); waiting.pop()) {
      const Frame& frame = waiting.top();
      if (::send(frame.to, frame.bytes.data(), frame.bytes.size(), 0) > 0) ++passed_;
    }
  }
}

}  // namespace rodeira::system_test
