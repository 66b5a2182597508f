// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <osg/Camera>
#include <osg/Geometry>
#include <osg/Group>
#include <osg/Texture2D>
#include <osg/ref_ptr>

#include <array>

#include "common/view/scene/camera/mirror.hpp"
#include "common/view/scene/lighting/air.hpp"
#include "nodes/view/frame/picture.hpp"
#include "nodes/view/overlays/heat_node.hpp"
#include "nodes/view/overlays/overlay.hpp"
#include "nodes/view/renderer/sun_shadow.hpp"

namespace rodeira::nodes {

// The driver's mirrors: each draws the scene backward into a picture of its own, which is shown reversed over the large
// one.
class Mirrors {
 public:
  // `scene`: what they show; cameras go below `root`, frames and pictures below `overlay`.
  Mirrors(osg::Group& root, osg::Group& scene, osg::Group& overlay);

  // Of the body that the picture goes with; none: no mirrors. `in_turn`: where the picture goes on from the one before,
  // one of them is drawn anew and the others show what they showed, otherwise all are.
  void Show(const Picture& picture, const std::optional<scene::Body>& body, const scene::Air& air,
            const SunShadow& shadow, const HeatNode& heat, int width_px, int height_px, bool in_turn);

 private:
  struct Glass {
    osg::ref_ptr<osg::Camera> camera;
    osg::ref_ptr<osg::Texture2D> texture;
    osg::ref_ptr<osg::Geometry> pane;
    Boxes::Box box;  // for which it was fitted, of the picture's pixels
  };
  static Glass MakeGlass(osg::Group& root, osg::Group& scene, osg::Group& overlay);
  bool GoesOn(const Picture& picture, const Eigen::Vector3d& eye_W);
  void Fit(Glass& glass, const Boxes::Box& box);

  Boxes frames_;
  std::array<Glass, scene::kMirrors> glasses_;
  struct Shown {  // the picture before
    std::int64_t time_ns = 0;
    std::size_t followed = 0;
    std::array<bool, scene::kMirrors> mirrors{};
    Eigen::Vector3d eye_W = Eigen::Vector3d::Zero();
  };
  std::optional<Shown> before_;
  std::size_t turn_ = 0;
};

}  // namespace rodeira::nodes
