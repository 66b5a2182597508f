// SPDX-License-Identifier: Apache-2.0
#include "launch/rodeira/run/domains.hpp"

#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <charconv>
#include <set>
#include <string_view>
#include <utility>

#include "common/core/base/hash.hpp"
#include "launch/rodeira/run/shared_memory.hpp"

namespace rodeira::cli {
namespace {

constexpr std::uint32_t kDomains = 200;  // 1 to 200; `rodeira doctor` and other programs begin at 0
// DDSI-RTPS 2.2, 9.6.1.1. Fast DDS numbers its ports in shared memory in the same way.
constexpr std::uint32_t kFirstPort = 7400, kPortsOfDomain = 250;

std::string SocketName(std::uint32_t domain, const DomainPlace& place) {
  return fmt::format("{}{}", place.sockets, domain);
}

// Of a file such as sem.fastrtps_port7410_mutex.
std::optional<std::uint32_t> DomainOfPort(const std::string& file) {
  constexpr std::string_view kWord = "fastrtps_port";
  const auto at = file.find(kWord);
  std::uint32_t port = 0;
  if (at == std::string::npos) return std::nullopt;
  const char* begin = file.data() + at + kWord.size();
  if (std::from_chars(begin, file.data() + file.size(), port).ec != std::errc{} || port < kFirstPort)
    return std::nullopt;
  return (port - kFirstPort) / kPortsOfDomain;
}

}  // namespace

std::uint32_t PreferredDomain(const std::string& run) {
  return static_cast<std::uint32_t>(1 + base::Hash(run) % kDomains);
}

base::Result<DomainHold> DomainHold::FindFree(const std::string& run, const DomainPlace& place) {
  std::set<std::uint32_t> with_ports;
  for (const std::string& file : SharedMemoryFiles(place.folder)) {
    if (const auto domain = DomainOfPort(file)) with_ports.insert(*domain);
  }
  const std::uint32_t preferred = PreferredDomain(run);
  for (std::uint32_t i = 0; i < kDomains; ++i) {
    const std::uint32_t domain = 1 + (preferred - 1 + i) % kDomains;
    if (with_ports.contains(domain)) continue;
    if (auto hold = Take(domain, place)) return std::move(*hold);
  }
  return base::WrongInput("dds.no_free_domain",
                          fmt::format("all DDS domains from 1 to {} are in use on this PC; end other runs, or name one "
                                      "by --domain",
                                      kDomains),
                          fmt::format("run '{}'", run));
}

std::optional<DomainHold> DomainHold::Take(std::uint32_t domain, const DomainPlace& place) {
  auto socket = AbstractSocket::Take(SocketName(domain, place));
  if (!socket) return std::nullopt;
  return DomainHold(domain, std::move(*socket));
}

std::optional<std::string> OtherUserOf(std::uint32_t domain, const DomainPlace& place) {
  if (const auto owner = AbstractSocket::OwnerOf(SocketName(domain, place)); owner && owner->user != ::geteuid())
    return fmt::format("a run of user {} has domain {}", UserName(owner->user), domain);
  for (const std::string& file : SharedMemoryFiles(place.folder)) {
    struct stat found {};
    if (DomainOfPort(file) != domain || ::stat((place.folder / file).c_str(), &found) != 0) continue;
    if (found.st_uid == ::geteuid()) continue;
    return fmt::format("{} of domain {} belongs to user {}", (place.folder / file).string(), domain,
                       UserName(found.st_uid));
  }
  return std::nullopt;
}

}  // namespace rodeira::cli
