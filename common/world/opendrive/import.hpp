// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "common/core/base/hash.hpp"
#include "common/core/base/result.hpp"
#include "common/world/network/network.hpp"
#include "common/world/opendrive/finding.hpp"

// OpenDRIVE 1.4 to 1.8 (https://www.asam.net/standards/detail/opendrive/) into a network.
namespace rodeira::opendrive {

// How far neighbours may stand apart. Smaller gaps than these are closed and listed, larger ones refused.
struct Tolerance {
  double gap_m = 0.05;
  double kink_rad = 1e-3;
  bool strict = false;

  static Tolerance Usual() { return {}; }
  // What ASAM's own checker allows: contact points within 1e-6 m, lanes within 1 cm.
  static Tolerance Strict() { return {1e-6, 1e-6, true}; }
};

struct Import {
  std::string version;                              // "1.7"
  std::shared_ptr<const network::Network> network;  // null where there are errors
  std::vector<Finding> errors, warnings;            // by line
  std::vector<NamedFile> surfaces;                  // measured surfaces, as they stand in the file
  base::Digest content_hash = 0;                    // of the file's bytes
};

// Wrong input where the file cannot be read or is no OpenDRIVE at all; what else is wrong with it are its findings.
base::Result<Import> Read(std::string text, const std::filesystem::path& path, const Tolerance& tolerance = {});
base::Result<Import> Load(const std::filesystem::path& path, const Tolerance& tolerance = {});
// A network without errors, or the first of them as "file:line: rule: road, lane, s: sentence".
base::Result<std::shared_ptr<const network::Network>> LoadNetwork(const std::filesystem::path& path,
                                                                  const Tolerance& tolerance = {});

base::Error ToError(const Finding& finding, const std::filesystem::path& path);
// What the file holds: a table for people, ending in a newline.
std::string Describe(const Import& import);

}  // namespace rodeira::opendrive
