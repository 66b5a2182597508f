#include "nodes/vehicle/vehicle_node.hpp"

#include <utility>

#include "common/geometry/angle.hpp"
#include "common/vehicle/vehicle_model.hpp"
#include "idl/codec.hpp"
#include "idl/topics.hpp"
#include "nodes/vehicle/vehicle_wire.hpp"

namespace rodeira::nodes {
namespace {

namespace topics = idl::topics;

class VehicleNode final : public lockstep::Node {
 public:
  VehicleNode(std::unique_ptr<vehicle::VehicleModel> model, const vehicle::InitialCondition& initial, terrain::Ground& ground)
      : model_(std::move(model)), initial_(initial), ground_(ground) {}

  base::Status Initialise(lockstep::Outbox& outbox) override {
    if (auto status = model_->Initialise(initial_, ground_); !status) return status;  // INI
    Publish(outbox);
    return {};
  }

  base::Status Step(const lockstep::StepInfo& step, const lockstep::Inbox& inbox, lockstep::Outbox& outbox) override {
    const auto controls = idl::Decode<msg::Controls>(*inbox.Latest(topics::kControls).payload);
    if (!controls) return controls.error();
    model_->Step(FromWire(controls.value()), ground_, step.dt_s);  // CALCULO
    Publish(outbox);
    return {};
  }

  base::Status TakeOver(const std::vector<lockstep::Sample>& published) override {
    if (published.empty()) return base::WrongInput("no published state of the car was found");
    const auto state = idl::Decode<msg::VehicleState>(*published.back().payload);
    if (!state) return state.error();
    return model_->Initialise(vehicle::FromState(FromWire(state.value())), ground_);
  }

  void Save(base::StateWriter& out) const override { out.Put("model", *model_); }
  void Restore(base::StateReader& in) override { in.Get("model", *model_); }

 private:
  void Publish(lockstep::Outbox& outbox) const { outbox.Put(topics::kVehicleState, idl::Encode(ToWire(model_->state(), model_->dimensions()))); }

  std::unique_ptr<vehicle::VehicleModel> model_;
  vehicle::InitialCondition initial_;
  terrain::Ground& ground_;
};

}  // namespace

base::Result<std::unique_ptr<lockstep::Node>> MakeVehicleNode(launch::NodeContext& context) {
  const config::Map config = context.config();
  const std::filesystem::path file = config.Path("vehicle");
  const config::Map start = config.OptionalChild("start");
  vehicle::InitialCondition initial;
  const bool own_place = start.Has("x_m") || start.Has("y_m");
  if (own_place) {
    initial.x_m = start.Number("x_m");
    initial.y_m = start.Number("y_m");
  }
  const double heading_deg = start.Number("heading_deg", {-360.0, 360.0}, 0.0);
  initial.heading_rad = heading_deg * geometry::kPi / 180.0;
  initial.speed_mps = start.Number("speed_mps", {-20.0, 100.0}, 0.0);
  if (auto status = context.launch().file().Finish(); !status) return status.error();
  auto model = vehicle::LoadVehicle(file);
  if (!model) return model.error();
  const auto world = context.World();
  if (!world) return world.error();
  if (!own_place) {
    initial.x_m = world.value().start_x_m;
    initial.y_m = world.value().start_y_m;
    if (!start.Has("heading_deg")) initial.heading_rad = world.value().start_heading_rad;
  }
  context.set_world_hash(world.value().content_hash);
  return std::unique_ptr<lockstep::Node>(std::make_unique<VehicleNode>(std::move(model).value(), initial, context.Ground()));
}

}  // namespace rodeira::nodes
