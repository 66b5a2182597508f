// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "common/core/base/result.hpp"
#include "common/world/road/world.hpp"

// The output of `rodeira world check | info | query | build`: texts ending in a newline.
namespace rodeira::road {

// Every problem of a world file, by line; none if World::Load succeeds.
std::vector<base::Error> WorldProblems(const std::filesystem::path& world_yaml);
// Warnings: jumps of curvature, closed gaps, steep approaches to junctions.
std::vector<std::string> WorldWarnings(const std::filesystem::path& world_yaml);

// Name, content hash, extents, start; each road's length, junctions, smallest radius, heights, grades.
std::string DescribeWorld(const World& world);

// SUELO's answer at (x, y), where a road is near the place on it, and the longitude and latitude where the world has a
// projection (its terrain's, or an OpenDRIVE file's geoReference) that PROJ knows.
std::string DescribePoint(const World& world, double x_m, double y_m, std::optional<double> z_hint_m = std::nullopt);

// The place on a world's map that has this longitude and latitude (WGS 84). Wrong input where the world has no
// projection, or PROJ does not know it, or the projection has no such place.
base::Result<Eigen::Vector2d> PlaceOnMap(const World& world, double longitude_deg, double latitude_deg);

// Whether a world file says that its terrain is generated, so that there is something for BuildWorld to write. False
// for what cannot be read.
bool IsGenerated(const std::filesystem::path& world_file);

// Writes a world file into `folder` as it stands, but for the files that it names outside of its own folder, which it
// names there by their whole paths. Nothing where it lies there itself. Wrong input where it cannot be read or written.
base::Status CopyWorld(const std::filesystem::path& world_yaml, const std::filesystem::path& folder);

// Writes the generated terrain of a world as STEM.bt and STEM.prj into `folder` and beside them STEM.yaml, the same
// world file naming the .bt instead of the generator, with the files that it names (CopyNamed, logical_files.hpp); STEM
// is the world file's. That world has the same content hash, or it is a failure and no world file is written. Returns
// what was written. Wrong input where the terrain is no generated one, or where the world file itself would be
// overwritten.
base::Result<std::string> BuildWorld(const std::filesystem::path& world_yaml, const std::filesystem::path& folder);
// The same of a world that was loaded from that file.
base::Result<std::string> BuildWorld(const World& world, const std::filesystem::path& world_yaml,
                                     const std::filesystem::path& folder);

}  // namespace rodeira::road
