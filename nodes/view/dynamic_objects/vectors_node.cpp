// SPDX-License-Identifier: Apache-2.0
#include "nodes/view/dynamic_objects/vectors_node.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "common/core/base/constants.hpp"
#include "common/view/scene/mesh/loft.hpp"
#include "common/view/scene/mesh/solids.hpp"
#include "nodes/view/materials/to_osg.hpp"

namespace rodeira::nodes {
namespace {

constexpr scene::Colour kPoints = scene::Colour::Of(0x20c040), kPath = scene::Colour::Of(0xf0c020),
                        kTarget = scene::Colour::Of(0xe020d0), kAhead = scene::Colour::Of(0x20d0f0);
constexpr double kThick_m = 0.12, kTip_m = 0.7, kWide_m = 0.3;  // of an arrow
constexpr double kPost_m = 1.6, kPathHigh_m = 0.5, kPath_m = 6.0;
constexpr double kAboveRoof_m = 0.4, kTargetAboveRoof_m = 0.9;
constexpr double kBall_m = 0.22, kLine_m = 0.06, kStick_m = 0.03;

scene::Mesh Tip(scene::Colour colour) {
  const double w = kWide_m, thin = 0.01;
  const auto ring = [](double x, double half) {
    return std::vector<Eigen::Vector3d>{{x, -half, -half}, {x, half, -half}, {x, half, half}, {x, -half, half}};
  };
  return scene::Loft({ring(0.0, w), ring(kTip_m, thin)}, scene::Material::kLamp, colour, 0.2);
}

// About the origin.
scene::Mesh Ball(scene::Colour colour) {
  constexpr int kRings = 8, kSides = 12;
  std::vector<std::vector<Eigen::Vector3d>> rings;
  for (int i = 0; i <= kRings; ++i) {
    const double up = base::kPi * (static_cast<double>(i) / kRings - 0.5),
                 wide = std::max(1e-3, kBall_m * std::cos(up));
    rings.emplace_back();
    for (int k = 0; k < kSides; ++k) {
      const double turn = 2.0 * base::kPi * k / kSides;
      rings.back().emplace_back(wide * std::cos(turn), wide * std::sin(turn), kBall_m * std::sin(up));
    }
  }
  return scene::Loft(rings, scene::Material::kLamp, colour, 1.0);
}

}  // namespace

osg::ref_ptr<osg::MatrixTransform> VectorsNode::Add(MaterialLibrary& look, const scene::Mesh& mesh) {
  osg::ref_ptr<osg::MatrixTransform> placed = new osg::MatrixTransform;
  placed->addChild(look.GeometryOf(mesh));
  placed->setNodeMask(kThrowsNone);
  group_->addChild(placed);
  return placed;
}

VectorsNode::Arrow VectorsNode::MakeArrow(MaterialLibrary& look, scene::Colour colour) {
  const double half = 0.5 * kThick_m;
  return {Add(look, scene::Box({0.0, -half, -half}, {1.0, half, half}, scene::Material::kLamp, colour)),
          Add(look, Tip(colour))};
}

VectorsNode::VectorsNode(MaterialLibrary& look, const road::World& world)
    : world_(world),
      group_(new osg::Group),
      points_(MakeArrow(look, kPoints)),
      path_(MakeArrow(look, kPath)),
      line_(Add(look, scene::Box({0.0, -0.5 * kLine_m, -0.5 * kLine_m}, {1.0, 0.5 * kLine_m, 0.5 * kLine_m},
                                 scene::Material::kLamp, kTarget))),
      target_(Add(look, Ball(kTarget))) {
  scene::Mesh post = scene::Pole(0.0, kPost_m, 0.12, 0.12, 8, kAhead);
  post.material = scene::Material::kLamp;
  ahead_ = Add(look, post);
  scene::Mesh stick = scene::Pole(-1.0, 0.0, kStick_m, kStick_m, 8, kTarget);
  stick.material = scene::Material::kLamp;
  stick_ = Add(look, stick);
  group_->setNodeMask(0U);
}

Eigen::Vector3d VectorsNode::OnGround(const Eigen::Vector2d& at_W, double near_z_m) const {
  return {at_W.x(), at_W.y(), world_.At(at_W.x(), at_W.y(), near_z_m).z_m};
}

void VectorsNode::Lay(const Arrow& arrow, const Eigen::Vector3d& from_W, const Eigen::Vector3d& to_W) {
  const double length_m = (to_W - from_W).norm();
  const bool seen = length_m > kTip_m;
  arrow.shaft->setNodeMask(seen ? kThrowsNone : 0U);
  arrow.tip->setNodeMask(seen ? kThrowsNone : 0U);
  if (!seen) return;
  const osg::Vec3d along = ToOsg((to_W - from_W) / length_m);
  const osg::Matrixd turn = osg::Matrixd::rotate(osg::Vec3d(1.0, 0.0, 0.0), along);
  arrow.shaft->setMatrix(osg::Matrixd::scale(length_m - kTip_m, 1.0, 1.0) * turn *
                         osg::Matrixd::translate(ToOsg(from_W)));
  arrow.tip->setMatrix(turn * osg::Matrixd::translate(ToOsg(to_W) - along * kTip_m));
}

void VectorsNode::Show(const Picture& picture) {
  const std::size_t cars = picture.moment.cars.size();
  std::optional<DriverAim> aim;
  if (picture.chosen && *picture.chosen < cars) aim = picture.driver_aim;
  if (picture.chosen && *picture.chosen >= cars && *picture.chosen - cars < picture.moment.agents.size()) {
    const auto& detail = picture.moment.agents[*picture.chosen - cars].detail;
    if (detail)
      aim = DriverAim{detail->target_speed_mps, detail->target_B, detail->path_turn_rad, detail->look_ahead_W};
  }
  group_->setNodeMask(aim ? ~0U : 0U);
  if (aim) Place(*scene::BodyAt(picture.moment, *picture.chosen), *aim);
}

void VectorsNode::Place(const scene::Body& body, const DriverAim& aim) {
  const Eigen::Vector3d& at_W = body.p_WB_W;
  const auto from_car = [&](double ahead_m, double left_m, double up_m) -> Eigen::Vector3d {
    return at_W + body.q_WB * Eigen::Vector3d(ahead_m, left_m, up_m);
  };
  ahead_->setMatrix(osg::Matrixd::translate(ToOsg(OnGround(aim.look_ahead_W, at_W.z()))));
  const Eigen::Vector3d roof_W = from_car(0.0, 0.0, body.height_m + kAboveRoof_m);
  Lay(points_, roof_W, roof_W + body.q_WB * Eigen::Vector3d(std::max(aim.speed_mps, 0.0), 0.0, 0.0));
  const Eigen::Vector3d front_W = from_car(body.front_m, 0.0, kPathHigh_m);
  const Eigen::Vector3d path_W =
      front_W + kPath_m * (body.q_WB * Eigen::Vector3d(std::cos(aim.path_turn_rad), std::sin(aim.path_turn_rad), 0.0));
  Lay(path_, front_W, OnGround(path_W.head<2>(), path_W.z()) + Eigen::Vector3d(0.0, 0.0, kPathHigh_m));
  // On a stick, so that it is seen above whatever car it lies before or under.
  const Eigen::Vector3d foot_W = OnGround(from_car(aim.target_B.x(), aim.target_B.y(), 0.0).head<2>(), at_W.z());
  const double high_m = body.height_m + kTargetAboveRoof_m;
  const Eigen::Vector3d target_W = foot_W + Eigen::Vector3d(0.0, 0.0, high_m);
  target_->setMatrix(osg::Matrixd::translate(ToOsg(target_W)));
  stick_->setMatrix(osg::Matrixd::scale(1.0, 1.0, high_m) * osg::Matrixd::translate(ToOsg(target_W)));
  const Eigen::Vector3d eye_W = from_car(0.0, 0.0, high_m), way_W = target_W - eye_W;
  const double way_m = way_W.norm();
  line_->setNodeMask(way_m > kBall_m ? kThrowsNone : 0U);
  if (way_m > kBall_m) {
    line_->setMatrix(osg::Matrixd::scale(way_m, 1.0, 1.0) *
                     osg::Matrixd::rotate(osg::Vec3d(1.0, 0.0, 0.0), ToOsg(way_W / way_m)) *
                     osg::Matrixd::translate(ToOsg(eye_W)));
  }
}

}  // namespace rodeira::nodes
