// SPDX-License-Identifier: Apache-2.0
#include "common/runtime/dds/grant_listener.hpp"

#include <algorithm>
#include <utility>

#include "idl/topics.hpp"

namespace rodeira::dds {
namespace {

constexpr std::uint32_t kSegmentKib = 512;  // it sends nothing but its discovery

}  // namespace

GrantListener::GrantListener(const DomainSettings& settings, OnPayload on_grant)
    : thread_([this, settings, on_grant = std::move(on_grant)]() mutable {
        Open(std::move(settings), std::move(on_grant));
      }) {}

GrantListener::~GrantListener() {
  thread_.join();
  grants_.reset();
}

void GrantListener::Open(DomainSettings settings, OnPayload on_grant) {
  settings.name += " (its clock)";
  settings.segment_kib = std::min(settings.segment_kib, kSegmentKib);
  auto participant = Participant::Open(settings);
  if (!participant) return;
  participant_ = std::move(participant).value();
  auto grants = participant_->MakeReader(idl::topics::kGrant, Delivery::kBestEffortRepeated, std::move(on_grant));
  if (grants) grants_ = std::move(grants).value();
}

}  // namespace rodeira::dds
