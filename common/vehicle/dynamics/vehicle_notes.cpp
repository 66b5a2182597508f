// SPDX-License-Identifier: Apache-2.0
#include "common/vehicle/dynamics/vehicle_notes.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "common/core/config/config.hpp"
#include "common/vehicle/dynamics/fmu_model.hpp"
#include "common/vehicle/dynamics/tyre_file.hpp"

namespace rodeira::dynamics {

std::vector<std::string> NotesOn(const VehicleModel& model, const std::filesystem::path& file) {
  if (const auto* fmu = dynamic_cast<const FmuModel*>(&model)) return fmu->notes();
  const auto yaml = config::File::Load(file);
  if (!yaml) return {};
  std::vector<std::string> notes;
  const config::Map tyres = yaml.value().root().OptionalChild("tyre");
  for (const char* axle : {"front", "rear"}) {
    const auto path = tyres.OptionalChild(axle).OptionalPath("tir");
    const auto tyre = path ? LoadTyreFile(*path) : base::Result<TyreFile>(TyreFile());
    if (!tyre) continue;
    for (const std::string& warning : tyre.value().warnings) {
      std::string note = fmt::format("{}: {}", path->string(), warning);
      if (std::ranges::find(notes, note) == notes.end()) notes.push_back(std::move(note));
    }
  }
  return notes;
}

}  // namespace rodeira::dynamics
