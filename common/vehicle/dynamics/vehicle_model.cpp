// SPDX-License-Identifier: Apache-2.0
#include "common/vehicle/dynamics/vehicle_model.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <vector>

#include "common/core/base/suggest.hpp"
#include "common/vehicle/dynamics/bicycle_model.hpp"
#include "common/vehicle/dynamics/fmu_model.hpp"
#include "common/vehicle/dynamics/multibody_model.hpp"
#include "common/vehicle/dynamics/ode_model.hpp"
#include "common/vehicle/dynamics/vehicle_library.hpp"

namespace rodeira::dynamics {

bool IsFinite(const InitialCondition& initial) {
  return std::isfinite(initial.x_m) && std::isfinite(initial.y_m) && std::isfinite(initial.heading_rad) &&
         std::isfinite(initial.speed_mps) && std::isfinite(initial.lateral_speed_mps) &&
         std::isfinite(initial.yaw_rate_radps) && !std::isinf(initial.z_hint_m);
}

InitialCondition FromState(const VehicleState& state) {
  const Eigen::Vector3d v_WB_B = state.v_WB_B();
  InitialCondition initial;
  initial.x_m = state.p_WB_W.x();
  initial.y_m = state.p_WB_W.y();
  initial.z_hint_m = state.p_WB_W.z();
  initial.heading_rad = state.heading_rad();
  initial.speed_mps = v_WB_B.x();
  initial.lateral_speed_mps = v_WB_B.y();
  initial.yaw_rate_radps = state.w_WB_B.z();
  return initial;
}

namespace {

std::vector<ModelKind> AllKinds(std::span<const ModelKind> more) {
  std::vector<ModelKind> kinds;
  kinds.push_back(
      {"bicycle", [](const config::Map& root) { return std::make_unique<BicycleModel>(ReadBicycle(root)); }});
  kinds.push_back({"multibody",
                   [](const config::Map& root) { return std::make_unique<MultibodyModel>(ReadMultibody(root)); },
                   [](VehicleModel& model, const config::Map& root) {
                     auto& car = static_cast<MultibodyModel&>(model);
                     if (auto status = car.Build(); !status) return status;
                     car.ReadOutputs(root);
                     return base::Status();
                   }});
  kinds.push_back({"fmu", [](const config::Map& root) { return std::make_unique<FmuModel>(ReadFmu(root)); },
                   [](VehicleModel& model, const config::Map&) { return static_cast<FmuModel&>(model).Build(); }});
  kinds.push_back({"ode", [](const config::Map& root) { return std::make_unique<OdeModel>(ReadOde(root)); },
                   [](VehicleModel& model, const config::Map&) { return static_cast<OdeModel&>(model).Build(); }});
  kinds.push_back({"library", MakeFromLibrary, CheckLibraryModel});
  kinds.insert(kinds.end(), more.begin(), more.end());
  return kinds;
}

// The files that have the same car in other models, by their names.
std::map<std::string, std::filesystem::path> ReadModels(const config::Map& models) {
  std::map<std::string, std::filesystem::path> files;
  for (const std::string& name : models.Keys()) files[name] = models.Path(name);
  return files;
}

// `named`: another file has sent us here for this model.
base::Result<std::unique_ptr<VehicleModel>> Load(const std::filesystem::path& path, std::string_view wanted, bool named,
                                                 std::span<const ModelKind> more) {
  auto file = config::File::Load(path);
  if (!file) return file.error();
  const config::Map root = file.value().root();
  const std::vector<ModelKind> kinds = AllKinds(more);
  std::vector<std::string> names;
  for (const ModelKind& kind : kinds) names.push_back(kind.name);
  (void)root.Choice("rodeira", {"vehicle/1"});
  (void)root.Text("name", "");
  const std::string own = root.Choice("model", names);
  const auto said = root.Peek({"model"});
  if (!said || std::ranges::find(names, *said) == names.end()) {  // no model: which other keys are known is open
    for (const base::Error& problem : file.value().Problems()) {
      const bool is_other_kind = problem.id == base::ErrorId("config.other_kind");
      if (is_other_kind || problem.message.find("'model'") != std::string::npos) return problem;
    }
  }
  const auto models = ReadModels(root.OptionalChild("models"));
  if (!wanted.empty() && wanted != own) {
    if (named)
      return base::WrongInput(
          "vehicle.wrong_model",
          fmt::format("'model' is '{}'; '{}' was expected of a file that another one names for it", own, wanted),
          root.Place("model"));
    const auto other = models.find(std::string(wanted));
    if (other == models.end()) {
      std::vector<std::string> known{own};
      for (const auto& [name, where] : models) known.push_back(name);
      return base::WrongInput(
          "vehicle.wrong_model",
          fmt::format("this car is wanted as model '{}'{}", wanted, base::DidYouMean(wanted, known)), path.string());
    }
    return Load(other->second, wanted, true, more);
  }
  for (const ModelKind& kind : kinds) {
    if (kind.name != own) continue;
    std::unique_ptr<VehicleModel> model = kind.make(root);
    // A wrong file ends the reading early: then the keys that were not read are no problem, only the first error is.
    if (const base::Status status = file.value().Finish(); !status) return status.error();
    if (kind.complete) {
      if (const base::Status status = kind.complete(*model, root); !status) {
        return status.error().context.empty() ? status.error().WithContext(path.string()) : status.error();
      }
      if (const base::Status status = file.value().Finish(); !status) return status.error();
    }
    return model;
  }
  return base::WrongInput("vehicle.wrong_model", "'model' is not known", root.Place("model"));
}

}  // namespace

base::Result<std::unique_ptr<VehicleModel>> LoadVehicle(const std::filesystem::path& path, std::string_view wanted,
                                                        std::span<const ModelKind> more) {
  return Load(path, wanted, false, more);
}

}  // namespace rodeira::dynamics
