#pragma once

#include <osg/Group>
#include <osg/MatrixTransform>
#include <osg/ref_ptr>

#include <optional>

#include "common/road/world.hpp"
#include "common/scene/moment.hpp"
#include "nodes/view/look.hpp"

namespace rodeira::view {

// What the driver of a chosen car of the traffic is about: the speed that it plans (green, as long as it would drive in a second), the
// direction of its path (yellow, from its front), and the point that it steers for (a cyan post).
class VectorsNode {
 public:
  // The world must outlive it.
  VectorsNode(Look& look, const road::World& world);
  osg::Node* node() { return group_; }
  // Nothing where nobody of the traffic is chosen (numbered as in Picture::chosen), or where nothing is said of it.
  void Show(const scene::Moment& moment, std::optional<std::size_t> chosen);

 private:
  struct Arrow {
    osg::ref_ptr<osg::MatrixTransform> shaft, tip;
  };
  Arrow MakeArrow(Look& look, scene::Colour colour);
  static void Lay(const Arrow& arrow, const Eigen::Vector3d& from_W, const Eigen::Vector3d& to_W);

  const road::World& world_;
  osg::ref_ptr<osg::Group> group_;
  Arrow target_, path_;
  osg::ref_ptr<osg::MatrixTransform> ahead_;
};

}  // namespace rodeira::view
