// SPDX-License-Identifier: Apache-2.0
#include "common/vehicle/dynamics/vehicle_library.hpp"

#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <utility>

#include "common/core/base/shared_object.hpp"
#include "common/core/config/declared.hpp"
#include "common/vehicle/dynamics/vehicle_schema.hpp"

namespace rodeira::dynamics {
namespace {

// Grows if the meaning of what passes changes and no size does.
constexpr std::size_t kLayoutVersion = 1;

constexpr std::size_t LayoutOfVehicles() {
  std::size_t layout = kLayoutVersion;
  for (const std::size_t size :
       {sizeof(VehicleModel), sizeof(VehicleState), sizeof(WheelState), sizeof(VehicleDimensions),
        sizeof(InitialCondition), sizeof(Controls), sizeof(Wrench), sizeof(ground::Ground), sizeof(ground::GroundQuery),
        sizeof(ground::GroundPoint), sizeof(config::Map), sizeof(base::StateWriter), sizeof(base::StateReader),
        sizeof(base::Error), sizeof(base::Status)})
    layout = layout * 1'000'003 + size;
  return layout;
}

bool IsSound(const VehicleState& state) {
  return state.p_WB_W.allFinite() && state.v_WB_W.allFinite() && state.w_WB_B.allFinite() && state.a_WB_W.allFinite() &&
         std::fabs(state.q_WB.norm() - 1.0) < 1e-6;
}

// A laboratory's model and what the simulator needs of it: a finite state and a place in the world.
class LibraryModel final : public VehicleModel {
 public:
  explicit LibraryModel(std::unique_ptr<VehicleModel> model) : model_(std::move(model)), shown_(model_->state()) {}

  base::Status Initialise(const InitialCondition& initial, ground::Ground& ground) override {
    if (auto status = model_->Initialise(initial, ground); !status) return status;
    if (!IsSound(model_->state()))
      return base::Failed("vehicle.not_finite",
                          "the model's state after Initialise is not finite, or its attitude has no unit length");
    shown_ = model_->state();
    return {};
  }
  void Step(const Controls& controls, ground::Ground& ground, double dt_s) override {
    if (is_lost_) return;
    model_->Step(controls, ground, dt_s);
    is_lost_ = !IsSound(model_->state());
    if (!is_lost_) shown_ = model_->state();
  }
  void SetPush(const Wrench& push) override { model_->SetPush(push); }
  bool can_be_pushed() const override { return model_->can_be_pushed(); }
  const VehicleState& state() const override { return shown_; }
  const VehicleDimensions& dimensions() const override { return model_->dimensions(); }
  void Save(base::StateWriter& writer) const override { model_->Save(writer); }
  void Restore(base::StateReader& reader) override {
    model_->Restore(reader);
    shown_ = model_->state();
    is_lost_ = false;
  }
  bool can_save() const override { return model_->can_save(); }
  std::vector<std::string> output_names() const override { return model_->output_names(); }
  std::vector<double> Outputs() const override { return model_->Outputs(); }
  base::Status problem() const override {
    if (auto status = model_->problem(); !status || !is_lost_) return status;
    return base::Failed("vehicle.not_finite", fmt::format("the model's state is not finite, or its attitude has no "
                                                          "unit length; its last position was ({:.3f}, {:.3f}) m",
                                                          shown_.p_WB_W.x(), shown_.p_WB_W.y()));
  }

 private:
  std::unique_ptr<VehicleModel> model_;
  VehicleState shown_;  // the newest sound one
  bool is_lost_ = false;
};

}  // namespace

std::string VehicleBuild() { return base::BuildText(LayoutOfVehicles()); }

std::unique_ptr<VehicleModel> MakeFromLibrary(const config::Map& root) {
  const config::DeclaredMap declared(root, LibrarySchema().keys);
  const std::filesystem::path path = declared.MapWith("library").Path("library");
  if (path.empty()) return nullptr;  // the missing key is told already
  const auto entry =
      base::LoadSharedObject(path, {kVehicleBuildEntry, kVehicleMakeEntry, "RODEIRA_VEHICLE"}, VehicleBuild());
  if (!entry) {
    root.Problem("library", entry.error().id, entry.error().Text());
    return nullptr;
  }
  std::unique_ptr<VehicleModel> model;
  reinterpret_cast<VehicleMaker>(entry.value())(root, model);
  if (model == nullptr) {
    root.Problem("library", "the shared object made no model");
    return nullptr;
  }
  return std::make_unique<LibraryModel>(std::move(model));
}

base::Status CheckLibraryModel(VehicleModel& model, const config::Map& root) {
  const VehicleDimensions& d = model.dimensions();
  const std::pair<const char*, double> positive[] = {
      {"wheelbase_m", d.wheelbase_m},   {"track_front_m", d.track_front_m},
      {"track_rear_m", d.track_rear_m}, {"wheel_radius_m", d.wheel_radius_m},
      {"front_m", d.front_m},           {"rear_m", d.rear_m},
      {"width_m", d.width_m},           {"height_m", d.height_m},
      {"mass_kg", d.mass_kg},           {"steering_ratio", d.steering_ratio}};
  for (const auto& [name, value] : positive) {
    if (std::isfinite(value) && value > 0.0) continue;
    return base::WrongInput(
        "vehicle.wrong_dimension",
        fmt::format("the model's dimension {} is {}; a finite number over 0 was expected", name, value),
        root.Place("library"));
  }
  return {};
}

}  // namespace rodeira::dynamics
