// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <osg/Camera>
#include <osg/Matrixd>
#include <osg/StateSet>
#include <osg/Texture2D>
#include <osg/ref_ptr>

#include "common/view/scene/lighting/air.hpp"
#include "common/view/scene/lighting/sun_view.hpp"
#include "nodes/view/frame/quality.hpp"

namespace rodeira::nodes {

// What the sun sees, as depths: what it does not see lies in shadow. Two maps: a sharp one of all that stands, moves or
// is ground, about the place that is looked at, and a wide one of the ground alone, for what hills and bridges shade
// beyond it.
class SunShadow {
 public:
  // `scene`: what throws shadows (kThrowsShadow, kGroundThrowsShadow); the cameras go below `root`; its state all
  // shaders read. Nothing where the traits have no map.
  SunShadow(osg::Group& root, osg::Group& scene, const QualityTraits& traits);

  // For the next picture, about this place. Without sun there are no shadows.
  void Show(osg::StateSet& state, const scene::Air& air, const Eigen::Vector3d& about_W);
  // For an eye that looks through this view: its state says where on the sharp map a place of its own frame is.
  void SetEye(osg::StateSet& state, const osg::Matrixd& view) const;

 private:
  const QualityTraits traits_;
  osg::ref_ptr<osg::Camera> near_, wide_;
  osg::Matrixd world_to_map_;
};

}  // namespace rodeira::nodes
