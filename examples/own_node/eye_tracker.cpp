// SPDX-License-Identifier: Apache-2.0
// The gaze of a driver: it follows the point that the vehicle will reach in a moment.
#include <cmath>
#include <memory>

#include "common/runtime/dds/external_node.hpp"
#include "gaze.h"
#include "idl/codec.hpp"
#include "idl/messages.hpp"
#include "idl/topics.hpp"

namespace {

using namespace rodeira;

class EyeTracker final : public lockstep::Node {
 public:
  explicit EyeTracker(double lookahead_s) : lookahead_s_(lookahead_s) {}

  // The sample valid at step 0.
  base::Status Initialise(lockstep::Outbox& outbox) override {
    Publish(outbox);
    return {};
  }
  base::Status Step(const lockstep::StepInfo& step, const lockstep::Inbox& inbox, lockstep::Outbox& outbox) override {
    const auto vehicle = idl::Decode<msg::VehicleState>(*inbox.Latest(idl::topics::kVehicleState).payload);
    if (!vehicle) return vehicle.error();
    const auto& position = vehicle.value().position_w_m();
    const auto& velocity = vehicle.value().velocity_w_mps();
    const double weight = 1.0 - std::exp(-step.dt_s / 0.2);  // the eye follows within 0.2 s
    const double target_x_m = position.x() + lookahead_s_ * velocity.x();
    const double target_y_m = position.y() + lookahead_s_ * velocity.y();
    x_m_ += weight * (target_x_m - x_m_);
    y_m_ += weight * (target_y_m - y_m_);
    z_m_ += weight * (position.z() - z_m_);
    distance_m_ = std::hypot(x_m_ - position.x(), y_m_ - position.y());
    Publish(outbox);
    return {};
  }

  // All that later steps depend on: a run can be continued from here.
  void Save(base::StateWriter& out) const override {
    out.Put("x_m", x_m_);
    out.Put("y_m", y_m_);
    out.Put("z_m", z_m_);
    out.Put("distance_m", distance_m_);
  }
  void Restore(base::StateReader& in) override {
    in.Get("x_m", x_m_);
    in.Get("y_m", y_m_);
    in.Get("z_m", z_m_);
    in.Get("distance_m", distance_m_);
  }

 private:
  void Publish(lockstep::Outbox& outbox) const {
    lab::Gaze gaze;
    gaze.target_x_m(x_m_);
    gaze.target_y_m(y_m_);
    gaze.target_z_m(z_m_);
    gaze.distance_m(distance_m_);
    outbox.Put("lab/gaze", idl::Encode(gaze));
  }

  double lookahead_s_;
  double x_m_ = 0.0, y_m_ = 0.0, z_m_ = 0.0;
  double distance_m_ = 0.0;
};

base::Result<std::unique_ptr<lockstep::Node>> MakeEyeTracker(launch::NodeContext& context) {
  const double lookahead_s = context.config().Number("lookahead_s", {0.0, 10.0}, 1.0);
  return std::unique_ptr<lockstep::Node>(std::make_unique<EyeTracker>(lookahead_s));
}

}  // namespace

RODEIRA_NODE(MakeEyeTracker);
