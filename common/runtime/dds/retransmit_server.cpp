// SPDX-License-Identifier: Apache-2.0
#include "common/runtime/dds/retransmit_server.hpp"

#include <utility>
#include <vector>

namespace rodeira::dds {

RetransmitServer::RetransmitServer(const lockstep::Roster& roster, lockstep::NodeIndex node, bool keeps_all,
                                   std::size_t most_bytes, Say say)
    : most_bytes_(most_bytes), say_(std::move(say)), kept_(roster, node) {
  if (keeps_all) archive_.emplace(roster);
  thread_ = std::thread([this] { Work(); });
}

RetransmitServer::~RetransmitServer() {
  {
    const std::lock_guard lock(mutex_);
    stop_ = true;
  }
  woken_.notify_all();
  thread_.join();
}

void RetransmitServer::Keep(const lockstep::Sample& own) {
  const std::lock_guard lock(mutex_);
  kept_.Add(own);
}

base::Status RetransmitServer::Remember(const lockstep::Sample& sample) {
  const std::lock_guard lock(mutex_);
  return archive_ ? archive_->Add(sample) : base::Status();
}

std::optional<lockstep::Sample> RetransmitServer::Kept(lockstep::SourceIndex source, lockstep::Step step) {
  const std::lock_guard lock(mutex_);
  auto found = Found({source, step});
  return found.empty() ? std::nullopt : std::optional(std::move(found.front()));
}

void RetransmitServer::Granted(const lockstep::Grant& grant) {
  const std::lock_guard lock(mutex_);
  kept_.Granted(grant);
  if (archive_) archive_->Forget(grant.resume);
}

void RetransmitServer::Take(const lockstep::Nack& nack) {
  {
    const std::lock_guard lock(mutex_);
    if (!archive_ && !kept_.Has(nack.gap.source)) return;
    pending_nacks_.Add(nack);
  }
  woken_.notify_all();
}

std::vector<lockstep::Sample> RetransmitServer::Found(const lockstep::Gap& gap) const {
  return kept_.Has(gap.source) || !archive_ ? kept_.From(gap) : archive_->From(gap);
}

void RetransmitServer::Send(lockstep::NodeIndex requester, std::span<const lockstep::Sample> samples) const {
  for (std::size_t begin = 0, end = 0; begin < samples.size(); begin = end) {
    std::size_t bytes = 0;
    while (end < samples.size() && (end == begin || bytes + samples[end].payload->size() <= most_bytes_))
      bytes += samples[end++].payload->size();
    say_(requester, samples.subspan(begin, end - begin));
  }
}

void RetransmitServer::Work() {
  std::unique_lock lock(mutex_);
  while (!stop_) {
    const auto nack = pending_nacks_.Next();
    if (!nack) {
      woken_.wait(lock, [this] { return stop_ || !pending_nacks_.empty(); });
      continue;
    }
    const std::vector<lockstep::Sample> found = Found(nack->gap);
    lock.unlock();
    Send(nack->requester, found);
    lock.lock();
  }
}

}  // namespace rodeira::dds
