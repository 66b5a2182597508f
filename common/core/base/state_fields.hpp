// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "common/core/base/result.hpp"
#include "common/core/base/state.hpp"

namespace rodeira::base {

// One value of a snapshot, without the type that wrote it: "engine.speed_radps", "gaps[3]". Parts are told apart by the
// names before theirs; a snapshot does not say where a part ends, so a path is the last part's name and the field's.
struct StateField {
  std::string path;
  std::string value;  // all its digits
  bool operator==(const StateField&) const = default;
};

// Wrong input where the bytes are no whole snapshot.
Result<std::vector<StateField>> StateFields(std::span<const std::byte> state);

// The field in which two states differ, with its values as texts.
struct StateDifference {
  std::string path;
  std::string first;  // "absent" where the field is not there
  std::string second;
};

// The first field in which two snapshots differ; nothing where they are equal to the bit.
Result<std::optional<StateDifference>> FirstStateDifference(std::span<const std::byte> first,
                                                            std::span<const std::byte> second);

}  // namespace rodeira::base
