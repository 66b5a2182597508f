// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "common/core/base/hash.hpp"
#include "common/core/base/result.hpp"
#include "common/world/network/network.hpp"
#include "common/world/opendrive/finding.hpp"
#include "common/world/opendrive/surface_files.hpp"

// OpenDRIVE 1.4 to 1.8 (https://www.asam.net/standards/detail/opendrive/) into a network.
namespace rodeira::opendrive {

// How far neighbours may stand apart. Smaller gaps than these are closed and listed, larger ones are errors.
struct Tolerance {
  double gap_m = 0.05;
  double kink_rad = 1e-3;
  bool strict = false;
  bool repair = true;  // errors are repaired, and become warnings; a file is refused where nothing of it can be driven

  // Gaps up to 5 cm and kinks up to 1 mrad are closed; larger errors are repaired. Unrepaired: they stay errors.
  static Tolerance Usual() { return {}; }
  static Tolerance Unrepaired() { return {0.05, 1e-3, false, false}; }
  // What ASAM's own checker allows: contact points within 1e-6 m, lanes within 1 cm. Nothing is repaired.
  static Tolerance Strict() { return {1e-6, 1e-6, true, false}; }
};

// How much of the lanes for driving, in metres, can be reached from where traffic enters the network (or from a way in
// a circle) and leads to where it leaves it (or into a circle).
struct Reach {
  double lanes_m = 0.0, reached_m = 0.0;

  double share() const { return lanes_m > 0.0 ? reached_m / lanes_m : 0.0; }
};
// Of all drivable lanes, by length in s.
Reach ReachOf(const network::Network& network);

// What reading a file gave: a network, or errors, and what the user is told.
struct Import {
  std::string version;                              // "1.7"
  std::shared_ptr<const network::Network> network;  // null where there are errors
  std::vector<Finding> errors, warnings;            // by line
  std::shared_ptr<SurfaceFiles> surface_files;      // that the file names; null: they were not looked for
  base::Digest content_hash = 0;                    // of the file's text, with what it includes
  std::string repaired_text;                        // of the file; empty where nothing had to be changed
  std::optional<Reach> before;                      // of the file as it is drawn; nothing where it cannot be built
};

// Wrong input where the file cannot be read or is no OpenDRIVE at all; what else is wrong with it are its findings.
base::Result<Import> Read(std::string text, const std::filesystem::path& path, const Tolerance& tolerance = {});
// The file may be packed (gzip, ZIP with one .xodr), in UTF-16 or another encoding, and include others: ReadFileText.
base::Result<Import> Load(const std::filesystem::path& path, const Tolerance& tolerance = {});
// A file as one text: unpacked, in UTF-8, with what it includes.
base::Result<std::string> LoadText(const std::filesystem::path& path);
// A network without errors, or the first of them as "file:line: rule: road, lane, s: sentence".
base::Result<std::shared_ptr<const network::Network>> LoadNetwork(const std::filesystem::path& path,
                                                                  const Tolerance& tolerance = {});

// Of lanes that traffic is led onto and that go on nowhere.
inline constexpr std::string_view kDeadEndRule = "rodeira.lane.dead_end";

// One sentence for each rule and what was done about it: the first place, and how many there are. In order of the
// lines.
std::vector<Finding> OneEachKind(const std::vector<Finding>& findings);

// Wrong input with the id of the finding's rule and "path:line" as its place.
base::Error ToError(const Finding& finding, const std::filesystem::path& path);
// What the file holds: a table for people, ending in a newline.
std::string Describe(const Import& import);

}  // namespace rodeira::opendrive
