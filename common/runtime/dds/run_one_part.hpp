// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <string_view>

#include "common/runtime/dds/hosted_part.hpp"

namespace rodeira::dds {

using OpenPart = std::function<base::Result<std::unique_ptr<HostedPart>>(
    const PartHost& host, lockstep::NodeIndex index, std::uint32_t incarnation)>;

// The whole of a process of one node: its options, its participant, its node to the end. 0, 1 or 2.
int RunOnePart(const std::string& program, std::string_view kind, int argc, char** argv, const OpenPart& open);

}  // namespace rodeira::dds
