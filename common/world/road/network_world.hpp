// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "common/core/base/result.hpp"
#include "common/world/network/network.hpp"
#include "common/world/opendrive/import.hpp"
#include "common/world/road/surface_detail.hpp"
#include "common/world/road/world_spec.hpp"

// Worlds that are OpenDRIVE files.
namespace rodeira::road {

// By its name: `.xodr`, packed `.xodr.gz`, `.xodrz` or `.zip`, or `.xml`, in letters of either case.
bool IsOpenDrive(const std::filesystem::path& file);
// Of a file that by its name is something that world files name (an elevation file, a measured surface, a CSV of a
// line): a sentence that says under which key. Nothing of others.
std::optional<base::Error> WhatWorldsName(const std::filesystem::path& file);
// The OpenDRIVE file with the roads of a world: the file itself, or the `network` of a world file. Empty: of neither
// kind.
std::filesystem::path OpenDriveOf(const std::filesystem::path& world_file);

// In the middle of a lane at s, facing its traffic. The network must have the lane, other than a centre.
StartPose PoseOn(const network::Network& network, const network::LaneKey& key, double s_m);

// Where the car starts on roads that do not say it: on the drivable lane that is longest in one lane section
// outside of junctions, of those that lead on if there are any, 10 m behind its beginning (or in its middle), where it
// is 2 m wide; at the origin where there is none.
StartPose StartOn(const network::Network& network);

// The measured and made surfaces of the file's roads. Those that an import keeps can be read.
base::Result<SurfaceDetail> LoadSurfaces(const opendrive::Import& import, const std::filesystem::path& file);

// What was repaired in the file, and lanes that end in a junction: one sentence a kind, with the first place.
std::vector<std::string> RepairSentences(const opendrive::Import& import, const std::filesystem::path& file);

// Wrong input where no lane of the network is for driving: with the types of lanes that it has.
std::optional<base::Error> NothingToDrive(const network::Network& network, const std::filesystem::path& file);

// A world of the file's roads, with the start of StartOn. Wrong input: the first error of the file.
base::Result<WorldSpec> ReadNetworkWorld(const std::filesystem::path& file);

// What `rodeira world check` says of the file: errors and warnings with their places, by line, and a table of what the
// file holds, which is empty where there are errors. strict: ASAM's own tolerances, and nothing is repaired. Of
// warnings of one kind the first is said, with their number; verbose: each. Without repair errors stay errors.
struct NetworkCheck {
  std::vector<base::Error> errors;
  std::vector<std::string> warnings;
  std::string table;
  std::shared_ptr<const network::Network> network;  // null where there are errors
};
NetworkCheck CheckNetwork(const std::filesystem::path& file, bool strict, bool verbose = false, bool repair = true);
// Writes the file as it is read, after repair: what was not repaired keeps its bytes. Says what ASAM's own tolerances
// still find in it, one sentence a kind. Wrong input: the file is refused, or `out` cannot be written.
base::Result<std::vector<std::string>> WriteRepaired(const std::filesystem::path& file,
                                                     const std::filesystem::path& out);

// Extents, roads, lanes; and where a point lies, as further lines of an answer of SUELO.
std::string DescribeNetwork(const network::Network& network);
// Road, s_m, t_m, lane and speed limit (km/h), a line each. Empty without a place.
std::string DescribePlace(const network::Network& network, const std::optional<network::Place>& place);

// The plan as SVG: lanes in the colours of their types, lines between them, junctions, the ids of roads.
std::string PlotNetwork(const network::Network& network);

}  // namespace rodeira::road
