#include "nodes/view/vectors_node.hpp"

#include <algorithm>

#include "common/scene/loft.hpp"
#include "common/scene/solids.hpp"

namespace rodeira::view {
namespace {

constexpr scene::Colour kTarget = scene::Colour::Of(0x20c040), kPath = scene::Colour::Of(0xf0c020), kAhead = scene::Colour::Of(0x20d0f0);
constexpr double kThick_m = 0.12, kTip_m = 0.7, kWide_m = 0.3;  // of an arrow
constexpr double kPost_m = 1.6, kPathHigh_m = 0.5;
constexpr double kAboveRoof_m = 0.4;

osg::Vec3d ToOsg(const Eigen::Vector3d& v) { return {v.x(), v.y(), v.z()}; }

scene::Mesh Tip(scene::Colour colour) {
  const double w = kWide_m, thin = 0.01;
  const auto ring = [](double x, double half) { return std::vector<Eigen::Vector3d>{{x, -half, -half}, {x, half, -half}, {x, half, half}, {x, -half, half}}; };
  return scene::Loft({ring(0.0, w), ring(kTip_m, thin)}, scene::Material::kLamp, colour, 0.2);
}

}  // namespace

VectorsNode::Arrow VectorsNode::MakeArrow(Look& look, scene::Colour colour) {
  Arrow arrow{new osg::MatrixTransform, new osg::MatrixTransform};
  const double half = 0.5 * kThick_m;
  arrow.shaft->addChild(look.GeometryOf(scene::Box({0.0, -half, -half}, {1.0, half, half}, scene::Material::kLamp, colour)));
  arrow.tip->addChild(look.GeometryOf(Tip(colour)));
  group_->addChild(arrow.shaft);
  group_->addChild(arrow.tip);
  return arrow;
}

VectorsNode::VectorsNode(Look& look, const road::World& world)
    : world_(world), group_(new osg::Group), target_(MakeArrow(look, kTarget)), path_(MakeArrow(look, kPath)), ahead_(new osg::MatrixTransform) {
  scene::Mesh post = scene::Pole(0.0, kPost_m, 0.12, 0.12, 8, kAhead);
  post.material = scene::Material::kLamp;
  ahead_->addChild(look.GeometryOf(post));
  group_->addChild(ahead_);
  group_->setNodeMask(0U);
}

void VectorsNode::Lay(const Arrow& arrow, const Eigen::Vector3d& from_W, const Eigen::Vector3d& to_W) {
  const double length_m = (to_W - from_W).norm();
  const bool seen = length_m > kTip_m;
  arrow.shaft->setNodeMask(seen ? kThrowsNone : 0U);
  arrow.tip->setNodeMask(seen ? kThrowsNone : 0U);
  if (!seen) return;
  const osg::Vec3d along = ToOsg((to_W - from_W) / length_m);
  const osg::Matrixd turn = osg::Matrixd::rotate(osg::Vec3d(1.0, 0.0, 0.0), along);
  arrow.shaft->setMatrix(osg::Matrixd::scale(length_m - kTip_m, 1.0, 1.0) * turn * osg::Matrixd::translate(ToOsg(from_W)));
  arrow.tip->setMatrix(turn * osg::Matrixd::translate(ToOsg(to_W) - along * kTip_m));
}

void VectorsNode::Show(const scene::Moment& moment, std::optional<std::size_t> chosen) {
  const std::size_t cars = moment.cars.size();
  const bool there = chosen && *chosen >= cars && *chosen - cars < moment.agents.size() && moment.agents[*chosen - cars].detail;
  group_->setNodeMask(there ? ~0U : 0U);
  if (!there) return;
  const scene::AgentPose& agent = moment.agents[*chosen - cars];
  const scene::AgentDetail& detail = *agent.detail;
  const Eigen::Vector3d front_W = agent.p_WB_W + agent.q_WB * Eigen::Vector3d(0.5 * agent.length_m, 0.0, kPathHigh_m);
  const Eigen::Vector2d& at = detail.look_ahead_W;
  const Eigen::Vector3d foot_W(at.x(), at.y(), world_.At(at.x(), at.y(), agent.p_WB_W.z()).z_m);
  ahead_->setMatrix(osg::Matrixd::translate(ToOsg(foot_W)));
  ahead_->setNodeMask(kThrowsNone);
  Lay(path_, front_W, foot_W + Eigen::Vector3d(0.0, 0.0, kPathHigh_m));
  const Eigen::Vector3d roof_W = agent.p_WB_W + agent.q_WB * Eigen::Vector3d(0.0, 0.0, agent.height_m + kAboveRoof_m);
  Lay(target_, roof_W, roof_W + agent.q_WB * Eigen::Vector3d(std::max(detail.target_speed_mps, 0.0), 0.0, 0.0));
}

}  // namespace rodeira::view
