// SPDX-License-Identifier: Apache-2.0
#include "common/driving/manoeuvres/force_trace.hpp"

namespace rodeira::manoeuvres {

base::Status ForceTrace::Initialise(const dynamics::InitialCondition& initial, ground::Ground& ground) {
  if (auto status = car_->Initialise(initial, ground); !status) return status;
  time_s_ = 0.0;
  times_s_.clear();
  forces_.clear();
  Write();
  return {};
}

void ForceTrace::Step(const dynamics::Controls& controls, ground::Ground& ground, double dt_s) {
  constexpr double kApart_s = 0.01;
  car_->Step(controls, ground, dt_s);
  time_s_ += dt_s;
  if (time_s_ > kApart_s * (static_cast<double>(times_s_.size()) - 1e-6)) Write();
}

void ForceTrace::Write() {
  times_s_.push_back(time_s_);
  forces_.push_back(car_->FindJointForces());
}

plot::Table ForceTrace::ForceTable() const {
  plot::Table table;
  table.names.emplace_back("time_s");
  if (forces_.empty()) return table;
  for (const dynamics::JointForce& joint : forces_.front().joints) {
    for (const char* axis : {"_x_N", "_y_N", "_z_N"}) table.names.push_back(joint.body + "_" + joint.point + axis);
  }
  for (const dynamics::SpringForce& spring : forces_.front().springs) {
    table.names.push_back(spring.name + "_N");
    table.names.push_back(spring.name + "_damper_N");
  }
  for (std::size_t row = 0; row < forces_.size(); ++row) {
    table.values.push_back(times_s_[row]);
    for (const dynamics::JointForce& joint : forces_[row].joints)
      table.values.insert(table.values.end(), joint.force_B.data(), joint.force_B.data() + 3);
    for (const dynamics::SpringForce& spring : forces_[row].springs) {
      table.values.push_back(spring.force_N);
      table.values.push_back(spring.damper_N);
    }
  }
  return table;
}

std::vector<plot::Diagram> ForceTrace::Diagrams() const {
  std::vector<plot::Diagram> diagrams;
  if (forces_.empty()) return diagrams;
  const auto begin = [&](const std::string& title) { diagrams.push_back({title, "time, s", "force, N", {}}); };
  const auto add = [&](const std::string& name, const auto& value) {
    plot::Curve curve{name, {}};
    for (std::size_t row = 0; row < forces_.size(); ++row)
      curve.points.emplace_back(times_s_[row], value(forces_[row]));
    diagrams.back().curves.push_back(std::move(curve));
  };
  const dynamics::JointForces& first = forces_.front();
  for (std::size_t i = 0; i < first.joints.size(); ++i) {
    if (i == 0 || first.joints[i].body != first.joints[i - 1].body) begin("on " + first.joints[i].body);
    add(first.joints[i].point, [i](const dynamics::JointForces& forces) { return forces.joints[i].force_B.norm(); });
  }
  begin("springs, tension positive");
  for (std::size_t i = 0; i < first.springs.size(); ++i)
    add(first.springs[i].name, [i](const dynamics::JointForces& forces) { return forces.springs[i].force_N; });
  begin("their dampers");
  for (std::size_t i = 0; i < first.springs.size(); ++i)
    add(first.springs[i].name, [i](const dynamics::JointForces& forces) { return forces.springs[i].damper_N; });
  return diagrams;
}

}  // namespace rodeira::manoeuvres
