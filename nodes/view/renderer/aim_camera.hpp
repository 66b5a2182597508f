// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <osg/Camera>

#include "common/view/scene/camera/camera.hpp"

namespace rodeira::nodes {

inline constexpr double kNear_m = 0.3;  // fixed: depths then mean the same in every frame

// The scene's camera as OpenSceneGraph's, for a picture so many times as wide as it is high; nothing is drawn beyond
// `far_m`.
void AimCamera(osg::Camera& eye, const scene::Camera& camera, double aspect, double far_m);

}  // namespace rodeira::nodes
