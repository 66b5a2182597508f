// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>

#include "common/core/base/result.hpp"
#include "common/runtime/dds/shared_memory_room.hpp"
#include "launch/rodeira/run/abstract_socket.hpp"

namespace rodeira::cli {

// Where domains are held: the files of shared memory, and the first part of the sockets' names.
struct DomainPlace {
  std::filesystem::path folder = dds::kSharedMemoryFolder;
  std::string sockets = "rodeira/domain/";
};

// The domain that a run of this name takes if it is free: 1 to 200.
std::uint32_t PreferredDomain(const std::string& run);

// A DDS domain that one run on this PC holds, against other users, too. A run in a container that shares the folder of
// shared memory, but not the network, is seen by its ports there.
class DomainHold {
 public:
  // The first domain from the preferred one on that no run holds and that has no ports in shared memory, of any user or
  // process. Failed if there is none.
  static base::Result<DomainHold> FindFree(const std::string& run, const DomainPlace& place = {});
  // This one; nothing if another run holds it.
  static std::optional<DomainHold> Take(std::uint32_t domain, const DomainPlace& place = {});

  std::uint32_t domain() const { return domain_; }

 private:
  DomainHold(std::uint32_t domain, AbstractSocket socket) : domain_(domain), socket_(std::move(socket)) {}
  std::uint32_t domain_;
  AbstractSocket socket_;
};

// What another user has of a domain: a sentence that names the file or the run, and the user. Nothing if there is none.
std::optional<std::string> OtherUserOf(std::uint32_t domain, const DomainPlace& place = {});

}  // namespace rodeira::cli
