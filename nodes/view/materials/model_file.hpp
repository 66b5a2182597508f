// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <osg/Group>
#include <osg/ref_ptr>

#include <string>
#include <vector>

#include "common/core/base/result.hpp"
#include "common/view/scene/road_furniture/static_objects.hpp"

namespace rodeira::nodes {

// Reads a model by OpenSceneGraph, each file once. Wrong input where it cannot be read. Several threads may ask.
base::Status ReadModel(const std::string& file);

// A copy of a model of one's own; null where it cannot be read.
osg::ref_ptr<osg::Node> CopyOfModel(const std::string& file);

// The models at their places, in copies of their own. Those that cannot be read are left out: ask ReadModel first.
osg::ref_ptr<osg::Group> PlaceModels(const std::vector<scene::PlacedModel>& models);

}  // namespace rodeira::nodes
