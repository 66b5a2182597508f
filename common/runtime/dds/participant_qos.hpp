// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fastdds/dds/domain/qos/DomainParticipantQos.hpp>

#include "common/runtime/dds/participant.hpp"

namespace rodeira::dds {

inline constexpr int kNanosecondsPerMillisecond = 1'000'000;

// Transport and discovery of a participant, all of it in code: no profile of the machine's has a say.
eprosima::fastdds::dds::DomainParticipantQos ParticipantQos(const DomainSettings& settings);

}  // namespace rodeira::dds
