// SPDX-License-Identifier: Apache-2.0
#include "launch/rodeira/run/host_hold.hpp"

#include <fmt/format.h>

#include <optional>
#include <utility>

#include "common/core/base/hash.hpp"

namespace rodeira::cli {

base::Result<AbstractSocket> HoldHost(std::uint32_t domain, const std::string& run, const std::string& host,
                                      const DomainPlace& place) {
  const std::string name =
      fmt::format("{}{}/run/{}/{}", place.sockets, domain, base::Hex(base::Hash(run)), base::Hex(base::Hash(host)));
  auto hold = AbstractSocket::Take(name);
  if (hold) return std::move(*hold);
  const auto owner = AbstractSocket::OwnerOf(name);
  const std::string process =
      owner ? fmt::format("process {} of user {}", owner->process, UserName(owner->user)) : "another process";
  const std::string what = host.empty() ? "this run is" : fmt::format("host '{}' of this run is", host);
  return base::WrongInput("run.already_running",
                          fmt::format("{} started already on this PC, by {}; end that one first, or name another run "
                                      "by --run",
                                      what, process),
                          fmt::format("run '{}' in domain {}", run, domain));
}

}  // namespace rodeira::cli
