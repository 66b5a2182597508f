// SPDX-License-Identifier: Apache-2.0
#include "nodes/view/dynamic_objects/car_node.hpp"

#include <osg/BlendFunc>
#include <osg/Depth>
#include <osg/NodeVisitor>
#include <osg/PolygonOffset>

#include <cmath>
#include <string_view>
#include <utility>
#include <vector>

#include "common/core/base/constants.hpp"
#include "nodes/view/materials/model_file.hpp"
#include "nodes/view/materials/to_osg.hpp"

namespace rodeira::nodes {
namespace {

constexpr double kPulse_Hz = 1.25;
constexpr double kPressed = 0.02;  // of a brake pedal

// A material's state with a uniform of one's own. One farther down would win, so it is a copy.
osg::ref_ptr<osg::StateSet> StateWith(MaterialLibrary& look, scene::Material material,
                                      const osg::ref_ptr<osg::Uniform>& uniform) {
  osg::ref_ptr<osg::StateSet> state = new osg::StateSet(*look.StateOf(material), osg::CopyOp::SHALLOW_COPY);
  state->addUniform(uniform);
  return state;
}

osg::ref_ptr<osg::Geometry> WithUniform(MaterialLibrary& look, const scene::Mesh& mesh,
                                        const osg::ref_ptr<osg::Uniform>& uniform) {
  osg::ref_ptr<osg::Geometry> geometry = look.GeometryOf(mesh);
  geometry->setStateSet(StateWith(look, mesh.material, uniform));
  return geometry;
}

// All nodes of that name, but none within another one.
std::vector<osg::ref_ptr<osg::Node>> NodesCalled(std::string_view name, osg::Node& root) {
  class Find final : public osg::NodeVisitor {
   public:
    explicit Find(std::string_view wanted) : osg::NodeVisitor(TRAVERSE_ALL_CHILDREN), name_(wanted) {}
    void apply(osg::Node& node) override {
      if (node.getName() == name_)
        found.emplace_back(&node);
      else
        traverse(node);
    }
    std::vector<osg::ref_ptr<osg::Node>> found;

   private:
    std::string_view name_;
  } find(name);
  root.accept(find);
  return std::move(find.found);
}

// Makes whatever is drawn below a node a lamp, with the state of lamps.
class MakeLamp final : public osg::NodeVisitor {
 public:
  MakeLamp(scene::Lamp lamp, osg::StateSet& state)
      : osg::NodeVisitor(TRAVERSE_ALL_CHILDREN), lamp_(lamp), state_(&state) {}
  void apply(osg::Geometry& geometry) override {
    const unsigned vertices = geometry.getVertexArray() != nullptr ? geometry.getVertexArray()->getNumElements() : 0;
    osg::ref_ptr<osg::Vec2Array> which = new osg::Vec2Array(vertices);
    for (osg::Vec2& one : *which) one = {static_cast<float>(lamp_), 0.0F};
    geometry.setTexCoordArray(1, which);
    const scene::Colour c = scene::ColourOf(lamp_);
    osg::ref_ptr<osg::Vec4ubArray> colour = new osg::Vec4ubArray;
    colour->push_back({c.red, c.green, c.blue, 255});
    colour->setNormalize(true);
    geometry.setColorArray(colour, osg::Array::BIND_OVERALL);
    geometry.setStateSet(state_);
  }

 private:
  scene::Lamp lamp_;
  osg::ref_ptr<osg::StateSet> state_;
};

// How the pulse lies over a model, whatever its own states: its shape once more in the pulse's colour, as dense as the
// share that is seen.
osg::ref_ptr<osg::StateSet> PulseState(const osg::ref_ptr<osg::Uniform>& pulse) {
  constexpr int kBin = 3;  // behind all that is solid, and the sky
  constexpr osg::StateAttribute::OverrideValue kWhatever = osg::StateAttribute::OVERRIDE | osg::StateAttribute::ON;
  osg::ref_ptr<osg::StateSet> state = new osg::StateSet;
  // ftransform: the same depths, to the bit, as of what has no shaders.
  state->setAttributeAndModes(
      ProgramOf("void main() { gl_Position = ftransform(); }",
                "uniform float pulse;\nvoid main() { gl_FragColor = vec4(1.0, 0.95, 0.55, 0.65 * pulse); }"),
      kWhatever);
  state->addUniform(pulse, kWhatever);
  state->setAttributeAndModes(new osg::BlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA), kWhatever);
  state->setAttributeAndModes(new osg::Depth(osg::Depth::LEQUAL, 0.0, 1.0, false), kWhatever);
  state->setAttributeAndModes(new osg::PolygonOffset(-1.0F, -1.0F), kWhatever);
  state->setRenderBinDetails(kBin, "RenderBin", osg::StateSet::OVERRIDE_RENDERBIN_DETAILS);
  return state;
}

}  // namespace

CarNode::CarNode(MaterialLibrary& look, scene::AgentKind kind, const scene::CarShape& shape, scene::Colour paint)
    : kind_(kind),
      shape_(shape),
      body_(new osg::MatrixTransform),
      frame_(new osg::Group),
      glows_(new osg::Uniform(osg::Uniform::FLOAT, "glows", static_cast<int>(scene::kLamps))),
      pulse_(new osg::Uniform("pulse", 0.0F)) {
  const scene::CarMeshes car = scene::BuildVehicle(kind, shape, paint);
  std::map<scene::Material, scene::Mesh> parts;  // as few as there are materials: each costs a call a frame
  const auto gather = [&parts](const scene::Mesh& mesh) {
    scene::Mesh& part = parts[mesh.material];
    part.material = mesh.material;
    part.Append(mesh);
  };
  for (const scene::Mesh& mesh : car.body) gather(mesh);
  for (const auto& [material, part] : parts)
    body_->addChild(material == scene::Material::kCarPaint ? WithUniform(look, part, pulse_) : look.GeometryOf(part));
  parts.clear();
  for (const scene::Mesh& mesh : car.frame) gather(mesh);
  for (const auto& [material, part] : parts)
    frame_->addChild(material == scene::Material::kCarPaint ? WithUniform(look, part, pulse_) : look.GeometryOf(part));
  body_->addChild(frame_);
  body_->addChild(WithUniform(look, car.lamps, glows_));
  shadow_ = look.MakeShadow(static_cast<float>(shape.front_m - shape.length_m), static_cast<float>(shape.front_m),
                            static_cast<float>(0.5 * shape.width_m));
  body_->addChild(shadow_);
  parts.clear();
  for (const scene::Mesh& mesh : car.wheel) gather(mesh);
  for (std::size_t i = 0; i < wheels_.size(); ++i) {
    wheels_[i] = new osg::MatrixTransform;
    for (const auto& [material, part] : parts) wheels_[i]->addChild(look.GeometryOf(part));
    body_->addChild(wheels_[i]);
    Turn(i, shape.hubs_B[i], 0.0, 0.0);
  }
}

void CarNode::SeenFromInside(bool inside) {
  const unsigned mask = inside ? 0U : ~0U;
  frame_->setNodeMask(mask);
  if (kind_ == scene::AgentKind::kCar) return;
  for (unsigned i = 0; i < body_->getNumChildren(); ++i) {
    if (body_->getChild(i) != shadow_) body_->getChild(i)->setNodeMask(mask);
  }
}

void CarNode::UseModel(MaterialLibrary& look, osg::Node& model) {
  static constexpr std::array kWheels = {"wheel_front_left", "wheel_front_right", "wheel_rear_left",
                                         "wheel_rear_right"};
  static constexpr std::array<const char*, scene::kLamps> kLampNames = {
      "lamp_brake", "lamp_indicator_left", "lamp_indicator_right", "lamp_reversing", "lamp_head"};
  body_->removeChildren(0, body_->getNumChildren());
  frame_->removeChildren(0, frame_->getNumChildren());
  body_->addChild(shadow_);
  body_->addChild(&model);
  worn_pulse_ = new osg::Group;
  worn_pulse_->setStateSet(PulseState(pulse_));
  worn_pulse_->addChild(&model);
  worn_pulse_->setNodeMask(0U);
  body_->addChild(worn_pulse_);
  shape_.tread_out_m = 0.0;
  for (std::size_t i = 0; i < wheels_.size(); ++i) {
    wheels_[i]->removeChildren(0, wheels_[i]->getNumChildren());
    body_->addChild(wheels_[i]);
    const auto found = NodesCalled(kWheels[i], model);
    if (found.empty()) continue;
    const osg::Node::ParentList parents = found.front()->getParents();
    for (osg::Group* parent : parents) parent->removeChild(found.front());
    wheels_[i]->addChild(found.front());
  }
  const osg::ref_ptr<osg::StateSet> shining = StateWith(look, scene::Material::kCarLamp, glows_);
  for (std::size_t i = 0; i < kLampNames.size(); ++i) {
    MakeLamp make(static_cast<scene::Lamp>(i), *shining);
    for (const auto& lamp : NodesCalled(kLampNames[i], model)) lamp->accept(make);
  }
}

void CarNode::Place(const Eigen::Vector3d& p_WB_W, const Eigen::Quaterniond& q_WB) {
  body_->setMatrix(ToOsg(p_WB_W, q_WB));
}

void CarNode::Turn(std::size_t wheel, const Eigen::Vector3d& hub_B, double steer_rad, double spin_rad) {
  const Eigen::Quaterniond q =
      Eigen::AngleAxisd(steer_rad, Eigen::Vector3d::UnitZ()) * Eigen::AngleAxisd(spin_rad, Eigen::Vector3d::UnitY());
  const Eigen::Vector3d out(0.0, (hub_B.y() > 0.0 ? 1.0 : -1.0) * shape_.tread_out_m, 0.0);
  wheels_[wheel]->setMatrix(ToOsg(hub_B + out, Eigen::Quaterniond(q)));
}

void CarNode::SetLamps(const std::array<float, scene::kLamps>& glows) {
  for (unsigned i = 0; i < glows.size(); ++i) glows_->setElement(i, glows[i]);
}

void CarNode::Pulse(double share) {
  pulse_->set(static_cast<float>(share));
  if (worn_pulse_) worn_pulse_->setNodeMask(share > 0.0 ? kThrowsNone : 0U);
}

PersonNode::PersonNode(MaterialLibrary& look, double height_m, scene::Colour clothes)
    : leg_m_(scene::LegLength_m(height_m)),
      meshes_(scene::BuildPerson(height_m, clothes)),
      body_(new osg::MatrixTransform),
      pulse_(new osg::Uniform("pulse", 0.0F)) {
  body_->addChild(WithUniform(look, meshes_.trunk, pulse_));
  for (std::size_t i = 0; i < limbs_.size(); ++i) {
    limbs_[i] = new osg::MatrixTransform;
    limbs_[i]->addChild(WithUniform(look, meshes_.limbs[i].mesh, pulse_));
    body_->addChild(limbs_[i]);
  }
}

void PersonNode::Place(const scene::AgentPose& person) {
  const double swing = scene::LegSwing_rad(person.wheel_spin_rad, person.wheel_radius_m, leg_m_);
  for (std::size_t i = 0; i < limbs_.size(); ++i) {
    const scene::Limb& limb = meshes_.limbs[i];
    limbs_[i]->setMatrix(
        ToOsg(limb.joint_B, Eigen::Quaterniond(Eigen::AngleAxisd(-limb.swings * swing, Eigen::Vector3d::UnitY()))));
  }
  // Legs that part reach less far down.
  const Eigen::Vector3d lower(0.0, 0.0, leg_m_ * (1.0 - std::cos(swing)));
  body_->setMatrix(ToOsg(person.p_WB_W - lower, person.q_WB));
}

template <class Pose, class Node, class Make, class Update>
void Fleet::Match(const std::vector<const Pose*>& poses, std::map<std::uint64_t, Node>& nodes, Make make,
                  Update update) {
  auto known = nodes.begin();
  for (const Pose* pose : poses) {  // both ascend by id
    while (known != nodes.end() && known->first < pose->id) {
      group_->removeChild(known->second.node());
      known = nodes.erase(known);
    }
    if (known == nodes.end() || known->first != pose->id) {
      known = nodes.emplace_hint(known, pose->id, make(*pose));
      group_->addChild(known->second.node());
    }
    update(known->second, *pose);
    ++known;
  }
  while (known != nodes.end()) {
    group_->removeChild(known->second.node());
    known = nodes.erase(known);
  }
}

void Fleet::WearModel(const std::string& file) {
  car_model_ = file;
  for (auto& [id, car] : cars_) group_->removeChild(car.node());
  cars_.clear();  // they are made anew
}

void Fleet::Show(const scene::SceneSnapshot& moment, std::optional<std::size_t> inside,
                 std::optional<std::size_t> chosen, bool dark) {
  const double now = 0.5 - 0.5 * std::cos(2.0 * base::kPi * kPulse_Hz * static_cast<double>(moment.time_ns) * 1e-9);
  const auto pulse = [&](std::size_t number) { return chosen == number ? now : 0.0; };
  const auto number_of = [&](const scene::AgentPose& agent) {
    return moment.cars.size() + static_cast<std::size_t>(&agent - moment.agents.data());
  };
  const auto pulse_of = [&](const scene::AgentPose& agent) { return pulse(number_of(agent)); };
  std::vector<const scene::CarPose*> cars;
  std::vector<const scene::AgentPose*> agents, people;
  for (const scene::CarPose& car : moment.cars) cars.push_back(&car);
  for (const scene::AgentPose& agent : moment.agents)
    (agent.kind == scene::AgentKind::kPedestrian ? people : agents).push_back(&agent);
  const auto make_car = [&](const scene::CarPose& car) {
    CarNode node(look_, scene::AgentKind::kCar, scene::CarShape::Of(car), car.colour);
    if (const auto model = car_model_.empty() ? nullptr : CopyOfModel(car_model_)) node.UseModel(look_, *model);
    return node;
  };
  Match(cars, cars_, make_car, [&](CarNode& node, const scene::CarPose& car) {
    node.Place(car.p_WB_W, car.q_WB);
    node.SeenFromInside(inside == static_cast<std::size_t>(&car - moment.cars.data()));
    for (std::size_t i = 0; i < car.wheels.size(); ++i)
      node.Turn(i, car.wheels[i].hub_B, car.wheels[i].steer_rad, car.wheels[i].spin_rad);
    scene::CarLights lights = car.lights;
    lights.brake = lights.brake || car.brake > kPressed;  // of recordings that have no lights yet
    node.SetLamps(scene::GlowsOf(lights, dark, moment.time_ns));
    node.Pulse(pulse(static_cast<std::size_t>(&car - moment.cars.data())));
  });
  const auto make_agent = [&](const scene::AgentPose& agent) {
    return CarNode(look_, agent.kind, scene::CarShape::Of(agent), agent.colour);
  };
  Match(agents, agents_, make_agent, [&](CarNode& node, const scene::AgentPose& agent) {
    node.Place(agent.p_WB_W, agent.q_WB);
    const scene::CarShape shape = scene::CarShape::Of(agent);
    for (std::size_t i = 0; i < 4; ++i)
      node.Turn(i, shape.hubs_B[i], i < 2 ? agent.steer_rad : 0.0, agent.wheel_spin_rad);
    node.SeenFromInside(inside == number_of(agent));
    node.SetLamps(scene::GlowsOf(agent.lights, dark, moment.time_ns));
    node.Pulse(pulse_of(agent));
  });
  const auto make_person = [&](const scene::AgentPose& agent) {
    return PersonNode(look_, agent.height_m, agent.colour);
  };
  Match(people, people_, make_person, [&](PersonNode& node, const scene::AgentPose& person) {
    node.Place(person);
    node.Pulse(pulse_of(person));
  });
}

}  // namespace rodeira::nodes
