// SPDX-License-Identifier: Apache-2.0
#include "common/analysis/measures/live_kinematics.hpp"

namespace rodeira::measures {

LiveKinematics::LiveKinematics(const network::Network* network) {
  if (network == nullptr) return;
  graph_.emplace(*network);
  lanes_.emplace(*graph_);
  leaders_.emplace(*graph_);
}

void LiveKinematics::SetFootprint(double length_m, double front_m, double width_m) {
  drive_.length_m = length_m;
  drive_.front_m = front_m;
  drive_.width_m = width_m;
}

const Drive& LiveKinematics::At(const SubjectSample& subject, std::span<const OtherVehicle> others) {
  GrowColumns(drive_, 0);
  GrowColumns(drive_, 1);
  PutSubject(subject, 0, drive_);
  if (!graph_) return drive_;
  const auto place = lanes_->Find(subject.x_m, subject.y_m, subject.z_m, subject.heading_rad, hint_);
  if (!place) return drive_;
  PutPlace(*place, 0, drive_);
  if (place->track >= 0)
    PutNeighbours(*graph_, *leaders_, static_cast<std::uint32_t>(place->track), place->along_m, others, {}, {}, 0,
                  drive_);
  return drive_;
}

}  // namespace rodeira::measures
