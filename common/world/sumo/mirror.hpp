// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <pugixml.hpp>

// netconvert draws networks of left-hand traffic as if they kept to the right. So they are imported as their mirror
// image, which keeps to the right, and the OpenDRIVE of that is mirrored back.
namespace rodeira::sumo {

// A network of left-hand traffic is replaced by its mirror image (y is -y). False: it is of right-hand traffic, or is
// no network; then nothing is done.
bool MirrorLeftHandNet(const std::filesystem::path& net);

// The mirror image of an OpenDRIVE network with lanes on the right alone: lanes on the left, for left-hand traffic.
void MirrorToLeftHand(pugi::xml_node drive);

}  // namespace rodeira::sumo
