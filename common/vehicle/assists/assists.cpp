// SPDX-License-Identifier: Apache-2.0
#include "common/vehicle/assists/assists.hpp"

#include <span>

namespace rodeira::assists {

AssistCommand Assists::Step(const AssistSettings& settings, const AssistCar& car, const AssistInput& input,
                            double dt_s) {
  AssistCommand command{input.brake_Nm, input.throttle};
  if (!settings.any()) return command;
  motion_.Step(car, input, brake_Nm_, dt_s);
  if (settings.tcs) command.throttle = traction_.Step(settings.traction, car, input, motion_, command.brake_Nm, dt_s);
  if (settings.esc)
    command.throttle =
        stability_.Step(settings.stability, car, input, motion_, command.throttle, command.brake_Nm, dt_s);
  if (settings.abs) command.brake_Nm = anti_lock_.Step(settings.anti_lock, car, input, motion_, command.brake_Nm, dt_s);
  brake_Nm_ = command.brake_Nm;
  return command;
}

void Assists::Save(base::StateWriter& writer) const {
  writer.Put("motion", motion_);
  writer.Put("anti_lock", anti_lock_);
  writer.Put("traction", traction_);
  writer.Put("stability", stability_);
  writer.Put("brake_Nm", std::span<const double>(brake_Nm_));
}

void Assists::Restore(base::StateReader& reader) {
  reader.Get("motion", motion_);
  reader.Get("anti_lock", anti_lock_);
  reader.Get("traction", traction_);
  reader.Get("stability", stability_);
  reader.Get("brake_Nm", std::span<double>(brake_Nm_));
}

}  // namespace rodeira::assists
