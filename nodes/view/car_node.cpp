#include "nodes/view/car_node.hpp"

#include <cmath>
#include <numbers>

namespace rodeira::view {
namespace {

constexpr double kPulse_Hz = 1.25;

osg::Matrixd ToOsg(const Eigen::Vector3d& p, const Eigen::Quaterniond& q) {
  return osg::Matrixd::rotate(osg::Quat(q.x(), q.y(), q.z(), q.w())) * osg::Matrixd::translate(p.x(), p.y(), p.z());
}

}  // namespace

CarNode::CarNode(Look& look, const scene::CarShape& shape, scene::Colour paint)
    : shape_(shape), body_(new osg::MatrixTransform), frame_(new osg::Group), brake_glow_(new osg::Uniform("glow", 1.0F)), pulse_(new osg::Uniform("pulse", 0.0F)) {
  const scene::CarMeshes car = scene::BuildCar(shape, paint);
  std::map<scene::Material, scene::Mesh> parts;  // as few as there are materials: each costs a call a frame
  const auto gather = [&parts](const scene::Mesh& mesh) {
    scene::Mesh& part = parts[mesh.material];
    part.material = mesh.material;
    part.Append(mesh);
  };
  for (const scene::Mesh& mesh : car.body) gather(mesh);
  for (const auto& [material, part] : parts) body_->addChild(material == scene::Material::kCarPaint ? Painted(look, part) : look.GeometryOf(part));
  parts.clear();
  for (const scene::Mesh& mesh : car.frame) gather(mesh);
  for (const auto& [material, part] : parts) frame_->addChild(material == scene::Material::kCarPaint ? Painted(look, part) : look.GeometryOf(part));
  body_->addChild(frame_);
  const osg::ref_ptr<osg::Geometry> lamps = look.GeometryOf(car.brake_lamps);
  osg::ref_ptr<osg::Group> lamps_group = new osg::Group;
  lamps_group->addChild(lamps);
  // A uniform farther down would win, so the lamps get a copy of their material's state with their own.
  osg::ref_ptr<osg::StateSet> lamps_state = new osg::StateSet(*look.StateOf(scene::Material::kLamp), osg::CopyOp::SHALLOW_COPY);
  lamps_state->addUniform(brake_glow_);
  lamps->setStateSet(lamps_state);
  body_->addChild(lamps_group);
  body_->addChild(look.MakeShadow(static_cast<float>(shape.front_m - shape.length_m), static_cast<float>(shape.front_m), static_cast<float>(0.5 * shape.width_m)));
  parts.clear();
  for (const scene::Mesh& mesh : car.wheel) gather(mesh);
  for (std::size_t i = 0; i < wheels_.size(); ++i) {
    wheels_[i] = new osg::MatrixTransform;
    for (const auto& [material, part] : parts) wheels_[i]->addChild(look.GeometryOf(part));
    body_->addChild(wheels_[i]);
    Turn(i, shape.hubs_B[i], 0.0, 0.0);
  }
}

// A uniform farther down would win, so the paint gets a copy of its material's state with its own.
osg::ref_ptr<osg::Geometry> CarNode::Painted(Look& look, const scene::Mesh& mesh) {
  osg::ref_ptr<osg::Geometry> geometry = look.GeometryOf(mesh);
  osg::ref_ptr<osg::StateSet> state = new osg::StateSet(*look.StateOf(scene::Material::kCarPaint), osg::CopyOp::SHALLOW_COPY);
  state->addUniform(pulse_);
  geometry->setStateSet(state);
  return geometry;
}

void CarNode::Place(const Eigen::Vector3d& p_WB_W, const Eigen::Quaterniond& q_WB) { body_->setMatrix(ToOsg(p_WB_W, q_WB)); }

void CarNode::Turn(std::size_t wheel, const Eigen::Vector3d& hub_B, double steer_rad, double spin_rad) {
  const Eigen::Quaterniond q = Eigen::AngleAxisd(steer_rad, Eigen::Vector3d::UnitZ()) * Eigen::AngleAxisd(spin_rad, Eigen::Vector3d::UnitY());
  const Eigen::Vector3d out(0.0, (hub_B.y() > 0.0 ? 1.0 : -1.0) * shape_.tread_out_m, 0.0);
  wheels_[wheel]->setMatrix(ToOsg(hub_B + out, Eigen::Quaterniond(q)));
}

void CarNode::Brake(bool braking) { brake_glow_->set(braking ? 2.1F : 1.0F); }

void CarNode::Pulse(double share) { pulse_->set(static_cast<float>(share)); }

template <class Pose, class Update>
void Fleet::Match(const std::vector<Pose>& poses, std::map<std::uint64_t, CarNode>& nodes, Update update) {
  auto known = nodes.begin();
  for (const Pose& pose : poses) {  // both ascend by id
    while (known != nodes.end() && known->first < pose.id) {
      group_->removeChild(known->second.node());
      known = nodes.erase(known);
    }
    if (known == nodes.end() || known->first != pose.id) {
      known = nodes.emplace_hint(known, pose.id, CarNode(look_, scene::CarShape::Of(pose), pose.colour));
      group_->addChild(known->second.node());
    }
    known->second.Place(pose.p_WB_W, pose.q_WB);
    update(known->second, pose);
    ++known;
  }
  while (known != nodes.end()) {
    group_->removeChild(known->second.node());
    known = nodes.erase(known);
  }
}

void Fleet::Show(const scene::Moment& moment, std::optional<std::size_t> inside, std::optional<std::size_t> chosen) {
  const double now = 0.5 - 0.5 * std::cos(2.0 * std::numbers::pi * kPulse_Hz * static_cast<double>(moment.time_ns) * 1e-9);
  const auto pulse = [&](std::size_t number) { return chosen == number ? now : 0.0; };
  Match(moment.cars, cars_, [&](CarNode& node, const scene::CarPose& car) {
    node.SeenFromInside(inside && &car == &moment.cars[*inside]);
    for (std::size_t i = 0; i < car.wheels.size(); ++i) node.Turn(i, car.wheels[i].hub_B, car.wheels[i].steer_rad, car.wheels[i].spin_rad);
    node.Brake(car.brake > 0.02);
    node.Pulse(pulse(static_cast<std::size_t>(&car - moment.cars.data())));
  });
  Match(moment.agents, agents_, [&](CarNode& node, const scene::AgentPose& agent) {
    const scene::CarShape shape = scene::CarShape::Of(agent);
    for (std::size_t i = 0; i < 4; ++i) node.Turn(i, shape.hubs_B[i], i < 2 ? agent.steer_rad : 0.0, agent.wheel_spin_rad);
    node.Brake(agent.braking);
    node.Pulse(pulse(moment.cars.size() + static_cast<std::size_t>(&agent - moment.agents.data())));
  });
}

}  // namespace rodeira::view
