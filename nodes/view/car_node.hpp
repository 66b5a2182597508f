#pragma once

#include <osg/MatrixTransform>
#include <osg/Uniform>
#include <osg/ref_ptr>

#include <array>
#include <map>
#include <optional>

#include "common/scene/car_mesh.hpp"
#include "common/scene/moment.hpp"
#include "nodes/view/look.hpp"

namespace rodeira::view {

// One car in OpenSceneGraph's scene.
class CarNode {
 public:
  CarNode(Look& look, const scene::CarShape& shape, scene::Colour paint);
  osg::Node* node() { return body_; }

  void Place(const Eigen::Vector3d& p_WB_W, const Eigen::Quaterniond& q_WB);
  void Turn(std::size_t wheel, const Eigen::Vector3d& hub_B, double steer_rad, double spin_rad);
  void Brake(bool braking);
  // How much of a chosen car's pulse is seen, 0 to 1.
  void Pulse(double share);
  // Leaves away what stands in the eyes of somebody who sits in it.
  void SeenFromInside(bool inside) { frame_->setNodeMask(inside ? 0U : ~0U); }

 private:
  osg::ref_ptr<osg::Geometry> Painted(Look& look, const scene::Mesh& mesh);

  scene::CarShape shape_;
  osg::ref_ptr<osg::MatrixTransform> body_;
  std::array<osg::ref_ptr<osg::MatrixTransform>, 4> wheels_;
  osg::ref_ptr<osg::Group> frame_;
  osg::ref_ptr<osg::Uniform> brake_glow_, pulse_;
};

// All cars of a moment: makes those that are new, moves those that are there, removes those that are gone.
class Fleet {
 public:
  explicit Fleet(Look& look) : look_(look), group_(new osg::Group) {}
  osg::Node* node() { return group_; }
  // `inside`: the number, in the moment, of the car that the camera is in, or none; `chosen`: who pulses, counted behind the cars for the traffic.
  void Show(const scene::Moment& moment, std::optional<std::size_t> inside, std::optional<std::size_t> chosen);

 private:
  template <class Pose, class Update>
  void Match(const std::vector<Pose>& poses, std::map<std::uint64_t, CarNode>& nodes, Update update);

  Look& look_;
  osg::ref_ptr<osg::Group> group_;
  std::map<std::uint64_t, CarNode> cars_;
  std::map<std::uint64_t, CarNode> agents_;
};

}  // namespace rodeira::view
