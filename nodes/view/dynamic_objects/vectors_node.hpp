// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <osg/Group>
#include <osg/MatrixTransform>
#include <osg/ref_ptr>

#include "common/view/scene/camera/camera.hpp"
#include "common/world/road/world.hpp"
#include "nodes/view/frame/picture.hpp"
#include "nodes/view/materials/material_library.hpp"

namespace rodeira::nodes {

// What the driver of a chosen car goes by: where the car points (green, from above its roof, as long as it would drive
// in a second at the planned speed), the point that is steered for (a magenta ball on a stick) and the line to it,
// where the path leads (yellow, from the car's front), and the point up to which the driver looks (a cyan post).
class VectorsNode {
 public:
  // The world must outlive it.
  VectorsNode(MaterialLibrary& look, const road::World& world);
  osg::Node* node() { return group_; }
  // Nothing where none is chosen, or where nothing is said of it.
  void Show(const Picture& picture);

 private:
  struct Arrow {
    osg::ref_ptr<osg::MatrixTransform> shaft, tip;
  };
  void Place(const scene::Body& body, const DriverAim& aim);
  osg::ref_ptr<osg::MatrixTransform> Add(MaterialLibrary& look, const scene::Mesh& mesh);
  Arrow MakeArrow(MaterialLibrary& look, scene::Colour colour);
  Eigen::Vector3d OnGround(const Eigen::Vector2d& at_W, double near_z_m) const;
  static void Lay(const Arrow& arrow, const Eigen::Vector3d& from_W, const Eigen::Vector3d& to_W);

  const road::World& world_;
  osg::ref_ptr<osg::Group> group_;
  Arrow points_, path_;
  osg::ref_ptr<osg::MatrixTransform> line_, target_, stick_, ahead_;
};

}  // namespace rodeira::nodes
