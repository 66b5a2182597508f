// SPDX-License-Identifier: Apache-2.0
#include "common/vehicle/dynamics/vehicle_notes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <optional>
#include <string_view>

#include "common/core/config/config.hpp"
#include "common/vehicle/dynamics/fmu_model.hpp"
#include "common/vehicle/dynamics/magic_formula.hpp"
#include "common/vehicle/dynamics/tyre_file.hpp"
#include "common/vehicle/dynamics/usual_tyre.hpp"

namespace rodeira::dynamics {
namespace {

// From a light quadricycle to a heavy lorry, with room on both sides.
struct Usual {
  std::string_view part, axle, key;  // PART.AXLE.KEY; no axle: PART.KEY
  double low, high;
};
constexpr auto kUsual = std::to_array<Usual>({{"body", "", "mass_kg", 100.0, 1e5},
                                              {"suspension", "front", "spring_Npm", 1e3, 2e6},
                                              {"suspension", "rear", "spring_Npm", 1e3, 2e6},
                                              {"suspension", "front", "damper_Nspm", 50.0, 2e5},
                                              {"suspension", "rear", "damper_Nspm", 50.0, 2e5},
                                              {"wheel", "", "vertical_Npm", 2e4, 5e6}});

std::optional<double> NumberAt(const config::Map& map, std::string_view key) {
  const std::string text = map.Peek({key}).value_or("");
  const char* begin = text.data() + (text.starts_with('+') ? 1 : 0);
  double value = 0.0;
  const auto [end, problem] = std::from_chars(begin, text.data() + text.size(), value);
  return problem == std::errc() && end != begin && end == text.data() + text.size() ? std::optional(value)
                                                                                    : std::nullopt;
}

void LookAtTyre(const config::Map& axle, std::string_view name, std::vector<std::string>& sentences) {
  const config::Map formula = axle.OptionalChild("magic_formula");
  if (!formula.Has("PKY1")) return;
  MagicFormulaSettings tyre;
  for (const MagicFormulaCoefficient& each : MagicFormulaCoefficients())
    tyre.*each.member = NumberAt(formula, each.name).value_or(tyre.*each.member);
  for (const UnusualTyreValue& unusual : UnusualTyreValues(tyre, nullptr)) {
    const std::string key(unusual.key);
    sentences.push_back(
        fmt::format("{}: 'tyre.{}.magic_formula.{}': {}", formula.Place(key), name, key, unusual.sentence));
  }
}

}  // namespace

std::vector<std::string> UnusualValues(const config::Map& root) {
  std::vector<std::string> sentences;
  for (const Usual& usual : kUsual) {
    const config::Map part = root.OptionalChild(usual.part);
    const config::Map map = usual.axle.empty() ? part : part.OptionalChild(usual.axle);
    const auto value = NumberAt(map, usual.key);
    if (!value || (*value >= usual.low && *value <= usual.high)) continue;
    sentences.push_back(fmt::format("{}: '{}.{}{}{}' is {:g}; {:g} to {:g} is usual of a road vehicle",
                                    map.Place(usual.key), usual.part, usual.axle, usual.axle.empty() ? "" : ".",
                                    usual.key, *value, usual.low, usual.high));
  }
  const config::Map tyres = root.OptionalChild("tyre");
  for (const char* axle : {"front", "rear"}) LookAtTyre(tyres.OptionalChild(axle), axle, sentences);
  return sentences;
}

std::vector<std::string> NotesOn(const VehicleModel& model, const std::filesystem::path& file) {
  if (const auto* fmu = dynamic_cast<const FmuModel*>(&model)) return fmu->notes();
  const auto yaml = config::File::Load(file);
  if (!yaml) return {};
  std::vector<std::string> notes = UnusualValues(yaml.value().root());
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
