// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <condition_variable>
#include <functional>
#include <memory>
#include <mutex>

#include "common/core/ground/ground.hpp"
#include "common/runtime/dds/participant.hpp"
#include "common/runtime/lockstep/runner.hpp"

namespace rodeira::dds {

// SUELO over request and reply. Waits for the answer on the caller's thread, asks again where none comes (the server
// may have been restarted), and gives "outside" once `over` says that the run is.
class RemoteGround final : public ground::Ground {
 public:
  // `requester` and `incarnation` tell its answers from others'. Fails as Participant::MakeWriter and MakeReader do.
  static base::Result<std::unique_ptr<RemoteGround>> Open(Participant& participant, lockstep::NodeIndex requester,
                                                          std::uint32_t incarnation, std::function<bool()> over);
  void Query(std::span<const ground::GroundQuery> queries, std::span<ground::GroundPoint> points) override;
  // Its heartbeat says "waits for a server" meanwhile; may be null.
  void Follow(lockstep::Runner* runner) { runner_ = runner; }

 private:
  RemoteGround(lockstep::NodeIndex requester, std::uint32_t incarnation, std::function<bool()> over);
  void OnReply(base::Bytes&& payload);

  lockstep::NodeIndex requester_;
  std::uint32_t incarnation_;
  std::function<bool()> over_;
  lockstep::Runner* runner_ = nullptr;
  std::unique_ptr<Writer> requests_;
  std::unique_ptr<Reader> replies_;

  std::mutex mutex_;
  std::condition_variable woken_;
  std::uint64_t number_ = 0;  // of the newest request
  bool answered_ = true;
  std::span<ground::GroundPoint> points_;  // where its answer goes
};

}  // namespace rodeira::dds
