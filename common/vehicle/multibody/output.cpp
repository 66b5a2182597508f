// SPDX-License-Identifier: Apache-2.0
#include "common/vehicle/multibody/output.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <sstream>

#include "common/core/base/suggest.hpp"
#include "common/vehicle/multibody/mechanism_schema.hpp"

namespace rodeira::multibody {

double Output::ValueOf(const System& system) const {
  switch (kind_) {
    case Kind::kPosition:
      return Evaluate(form_, system.q().data())[component_];
    case Kind::kVelocity:
      return Evaluate(form_, system.qd().data())[component_];
    case Kind::kAcceleration:
      return Evaluate(form_, system.qdd().data())[component_];
    case Kind::kAngle: {
      const Vector3d way = Evaluate(form_, system.q().data());
      return std::atan2(way.y(), way.x());
    }
    case Kind::kEnergy:
      return system.Energy();
    case Kind::kKinetic:
      return system.KineticEnergy();
    case Kind::kPotential:
      return system.PotentialEnergy();
    case Kind::kReaction:
      return system.multipliers()[static_cast<std::size_t>(index_)];
    case Kind::kJoint:
      return joint_->Now(system)[component_];
    case Kind::kForce:
      return system.drawing().loads[static_cast<std::size_t>(index_)].load->Force(system.motion());
  }
  return 0.0;
}

double Output::ValueOf(const System& system, const Balance& balance) const {
  if (kind_ == Kind::kReaction) return balance.multipliers[static_cast<std::size_t>(index_)];
  if (kind_ == Kind::kJoint) return joint_->In(system, balance)[component_];
  return ValueOf(system);
}

class OutputReader {
 public:
  OutputReader(const config::Map& outputs, const DrawingReader& reader, const System& system)
      : outputs_(outputs), reader_(reader), system_(system) {}

  void Read(const std::string& name) {
    std::istringstream words(outputs_.Text(name));
    std::vector<std::string> what;
    for (std::string word; words >> word;) what.push_back(word);
    Output output;
    output.name = name;
    if (what.size() == 3 && what[0] == "angle") {
      const auto from = reader_.Point(outputs_, name, what[1]);
      const auto to = reader_.Point(outputs_, name, what[2]);
      if (!from || !to) return;
      output.kind_ = Output::Kind::kAngle;
      output.form_ = Sum(*to, *from, -1.0);
    } else if (what.size() == 3 && what[0] == "joint") {
      if (!FindJoint(name, what[1], what[2], output)) return;
    } else if (what.size() >= 2 && (what[0] == "reaction" || what[0] == "force")) {
      if (!FindIndex(name, what, output)) return;
    } else if (what.size() != 1 || !FindOne(name, what[0], output)) {
      if (what.size() != 1)
        outputs_.Problem(name, "config.unknown_name",
                         fmt::format("'{}' is no output; P.x, P.vx, P.ax, a coordinate, energy, reaction NAME, "
                                     "force NAME, joint BODY P.x or angle P Q was expected",
                                     outputs_.Text(name)));
      return;
    }
    found.push_back(output);
  }

  void Default() {
    const Drawing& drawing = system_.drawing();
    for (std::size_t i = 0; i < drawing.entities.size(); ++i) {
      const EntityDrawing& entity = drawing.entities[i];
      Output output;
      output.kind_ = Output::Kind::kPosition;
      output.form_ = Single(static_cast<int>(i));
      for (int c = 0; c < 3; ++c) {
        output.component_ = c;
        if (entity.is_scalar() && c == 0)
          output.name = entity.name + (entity.kind == EntityKind::kAngle ? "_rad" : "_m");
        else if (entity.kind == EntityKind::kPoint && !entity.fixed[static_cast<std::size_t>(c)])
          output.name = fmt::format("{}_{}_m", entity.name, "xyz"[c]);
        else
          continue;
        found.push_back(output);
      }
    }
    Output energy;
    energy.name = "energy_J";
    found.push_back(energy);
  }

  std::vector<Output> found;

 private:
  bool FindIndex(const std::string& name, const std::vector<std::string>& what, Output& output) {
    std::string wanted = what[1];
    for (std::size_t i = 2; i < what.size(); ++i) wanted += " " + what[i];
    std::vector<std::string> names;
    const bool force = what[0] == "force";
    const int count = force ? static_cast<int>(system_.drawing().loads.size()) : system_.constraints().count();
    for (int i = 0; i < count; ++i) {
      names.push_back(force ? system_.drawing().loads[static_cast<std::size_t>(i)].name
                            : system_.constraints().name(i));
      if (names.back() != wanted) continue;
      output.kind_ = force ? Output::Kind::kForce : Output::Kind::kReaction;
      output.index_ = i;
      return true;
    }
    outputs_.Problem(
        name, "config.unknown_name",
        fmt::format("'{}' is no {}{}", wanted, force ? "force" : "constraint", base::DidYouMean(wanted, names)));
    return false;
  }

  // "P.x" on this body.
  bool FindJoint(const std::string& name, const std::string& body, const std::string& at, Output& output) {
    const std::vector<std::string>& names = system_.drawing().body_names;
    const auto which = std::find(names.begin(), names.end(), body);
    const std::size_t component =
        at.size() > 2 && at[at.size() - 2] == '.' ? std::string("xyz").find(at.back()) : std::string::npos;
    if (which == names.end() || component == std::string::npos) {
      outputs_.Problem(name, "config.unknown_name",
                       which == names.end() ? fmt::format("'{}' is no body{}", body, base::DidYouMean(body, names))
                                            : fmt::format("'{}' was found; a point and .x, .y or .z was expected", at));
      return false;
    }
    const auto point = reader_.Entity(outputs_, name, at.substr(0, at.size() - 2), false);
    if (!point) return false;
    auto joint = JointForce::Make(system_, static_cast<int>(which - names.begin()), *point);
    if (!joint) {
      outputs_.Problem(name, joint.error().id, joint.error().message);
      return false;
    }
    output.kind_ = Output::Kind::kJoint;
    output.joint_ = std::move(joint).value();
    output.component_ = static_cast<int>(component);
    return true;
  }

  bool FindOne(const std::string& name, const std::string& what, Output& output) {
    if (what == "energy" || what == "kinetic" || what == "potential") {
      output.kind_ = what == "energy"    ? Output::Kind::kEnergy
                     : what == "kinetic" ? Output::Kind::kKinetic
                                         : Output::Kind::kPotential;
      return true;
    }
    const auto dot = what.rfind('.');
    const std::string of = what.substr(0, dot);
    const std::string part = dot == std::string::npos ? "" : what.substr(dot + 1);
    if (part.empty() || part == "rate" || part == "acceleration") {
      const auto entity = reader_.Entity(outputs_, name, of, true);
      if (!entity) return false;
      output.kind_ = part.empty()     ? Output::Kind::kPosition
                     : part == "rate" ? Output::Kind::kVelocity
                                      : Output::Kind::kAcceleration;
      output.form_ = Single(*entity);
      return true;
    }
    const std::size_t component = std::string("xyz").find(part.back());
    const std::string kind = part.substr(0, part.size() - 1);
    if (component == std::string::npos || (kind != "" && kind != "v" && kind != "a")) {
      outputs_.Problem(
          name, fmt::format("'{}' was found after the dot; x, y, z, vx … az, rate or acceleration was expected", part));
      return false;
    }
    const auto point = reader_.Point(outputs_, name, of);
    if (!point) return false;
    output.kind_ = kind.empty()  ? Output::Kind::kPosition
                   : kind == "v" ? Output::Kind::kVelocity
                                 : Output::Kind::kAcceleration;
    output.form_ = *point;
    output.component_ = static_cast<int>(component);
    return true;
  }

  const config::Map& outputs_;
  const DrawingReader& reader_;
  const System& system_;
};

std::vector<Output> ReadOutputs(const config::Map& root, const DrawingReader& reader, const System& system) {
  const config::Map outputs = config::DeclaredMap(root, MechanismKeys()).MapWith("outputs").OptionalChild("outputs");
  OutputReader output_reader(outputs, reader, system);
  for (const std::string& name : outputs.Keys()) output_reader.Read(name);
  if (!root.Has("outputs")) output_reader.Default();
  return output_reader.found;
}

}  // namespace rodeira::multibody
