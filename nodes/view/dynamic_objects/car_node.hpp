// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <osg/MatrixTransform>
#include <osg/Uniform>
#include <osg/ref_ptr>

#include <array>
#include <map>
#include <optional>
#include <string>

#include "common/view/scene/vehicles/car_mesh.hpp"
#include "common/view/scene/vehicles/person_mesh.hpp"
#include "common/view/scene/vehicles/scene_snapshot.hpp"
#include "nodes/view/materials/material_library.hpp"

namespace rodeira::nodes {

// One car in OpenSceneGraph's scene.
class CarNode {
 public:
  CarNode(MaterialLibrary& look, scene::AgentKind kind, const scene::CarShape& shape, scene::Colour paint);
  osg::Node* node() { return body_; }

  // The car's body in W; wheels and lamps stay as they are on it.
  void Place(const Eigen::Vector3d& p_WB_W, const Eigen::Quaterniond& q_WB);
  // Wheel 0 to 3: front left, front right, rear left, rear right. Steering is positive to the left, spin rolling
  // forward.
  void Turn(std::size_t wheel, const Eigen::Vector3d& hub_B, double steer_rad, double spin_rad);
  // By scene::Lamp, each from 0 (dull) to 1.
  void SetLamps(const std::array<float, scene::kLamps>& glows);
  // How much of a chosen car's pulse is seen, 0 to 1.
  void Pulse(double share);
  // Shows this model instead of the procedural car, in its frame B (x forward, z up, metres, the ground at z = 0). Its
  // nodes that are called wheel_front_left, wheel_front_right, wheel_rear_left and wheel_rear_right, each about its
  // hub, turn, steer and move as wheels do; those that are called lamp_brake, lamp_indicator_left,
  // lamp_indicator_right, lamp_reversing and lamp_head, as many as there are, look and shine as the procedural car's
  // lamps.
  void UseModel(MaterialLibrary& look, osg::Node& model);
  // Leaves away what stands in the eyes of a person in it: of a car what is above its waist, of a van, a lorry
  // and a bus all but the shadow.
  void SeenFromInside(bool inside);

 private:
  osg::ref_ptr<osg::Geometry> Painted(MaterialLibrary& look, const scene::Mesh& mesh);

  scene::AgentKind kind_;
  scene::CarShape shape_;
  osg::ref_ptr<osg::MatrixTransform> body_;
  std::array<osg::ref_ptr<osg::MatrixTransform>, 4> wheels_;
  osg::ref_ptr<osg::Group> frame_;
  osg::ref_ptr<osg::Node> shadow_;
  osg::ref_ptr<osg::Group> worn_pulse_;  // null: it wears no model
  osg::ref_ptr<osg::Uniform> glows_, pulse_;
};

// A pedestrian.
class PersonNode {
 public:
  PersonNode(MaterialLibrary& look, double height_m, scene::Colour clothes);
  osg::Node* node() { return body_; }

  // Where it is; its limbs as far as it has walked.
  void Place(const scene::AgentPose& person);
  // As CarNode::Pulse.
  void Pulse(double share) { pulse_->set(static_cast<float>(share)); }

 private:
  double leg_m_;
  scene::PersonMeshes meshes_;
  osg::ref_ptr<osg::MatrixTransform> body_;
  std::array<osg::ref_ptr<osg::MatrixTransform>, 4> limbs_;
  osg::ref_ptr<osg::Uniform> pulse_;
};

// All vehicles and people of a moment: makes those that are new, moves those that are there, removes those that are
// gone.
class Fleet {
 public:
  // The library outlives it.
  explicit Fleet(MaterialLibrary& look) : look_(look), group_(new osg::Group) {}
  osg::Node* node() { return group_; }
  // A model for driven cars, which ReadModel can read.
  void WearModel(const std::string& file);
  // `inside`: the number, in the moment, of the body with the camera, or none; `chosen`: the one that pulses; both
  // counted behind the cars for the traffic. `dark`: headlights are on.
  void Show(const scene::SceneSnapshot& moment, std::optional<std::size_t> inside, std::optional<std::size_t> chosen,
            bool dark);

 private:
  template <class Pose, class Node, class Make, class Update>
  void Match(const std::vector<const Pose*>& poses, std::map<std::uint64_t, Node>& nodes, Make make, Update update);

  MaterialLibrary& look_;
  std::string car_model_;  // empty: the procedural one
  osg::ref_ptr<osg::Group> group_;
  std::map<std::uint64_t, CarNode> cars_;
  std::map<std::uint64_t, CarNode> agents_;
  std::map<std::uint64_t, PersonNode> people_;
};

}  // namespace rodeira::nodes
