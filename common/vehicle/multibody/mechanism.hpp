// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "common/core/base/result.hpp"
#include "common/vehicle/multibody/output.hpp"
#include "common/vehicle/multibody/system.hpp"

namespace rodeira::multibody {

// A mechanism file, ready to run.
struct Mechanism {
  std::unique_ptr<System> system;
  std::vector<Output> outputs;
};

// Reads `rodeira: mechanism/1`, assembles it and finds its initial velocities and accelerations. Wrong input with
// file:line where the file is wrong or the mechanism cannot be.
base::Result<Mechanism> LoadMechanism(const std::filesystem::path& path, const SystemSettings& settings = {});
// The same of a text; `name` stands for its file in messages.
base::Result<Mechanism> ParseMechanism(std::string_view text, const std::filesystem::path& name,
                                       const SystemSettings& settings = {});

}  // namespace rodeira::multibody
