// SPDX-License-Identifier: Apache-2.0
#include "common/vehicle/dynamics/tir_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "common/core/base/files.hpp"
#include "common/core/base/suggest.hpp"
#include "common/vehicle/dynamics/usual_tyre.hpp"

namespace rodeira::dynamics {
namespace {

constexpr std::size_t kMaxBytes = 1u << 20;
constexpr double kMaxLoad_N = 1e7;       // ten times what the largest tyre of an aircraft or a mine bears
constexpr double kLoadsOfNominal = 4.0;  // a file without FZMAX holds for loads up to this many times FNOMIN
constexpr auto kNeeded = std::to_array<std::string_view>({"FNOMIN", "PCX1", "PDX1", "PKX1", "PCY1", "PDY1", "PKY1"});
constexpr auto kUnits = std::to_array<std::pair<std::string_view, std::string_view>>(
    {{"LENGTH", "meter"}, {"FORCE", "newton"}, {"ANGLE", "radians"}, {"MASS", "kg"}, {"TIME", "second"}});

// Other names of coefficients, as PAC2002 has them.
constexpr auto kAliases = std::to_array<std::pair<std::string_view, std::string_view>>(
    {{"IP", "INFLPRES"}, {"IP_NOM", "NOMPRES"}, {"LKYG", "LKYC"}, {"LKZG", "LKZC"}, {"LMR", "LRES"}});

// Coefficients of the directions and scales that the forces here have no use for: relaxation, moments, turn slip,
// structure.
constexpr auto kUnused = std::to_array<std::string_view>(
    {"PTX1", "PTX2",  "PTX3", "PTX4", "PTY1", "PTY2", "PTY3", "LCZ", "LGAZ",  "LGYR",  "LKZC", "LKZG", "LKG",
     "LMP",  "LMPHI", "LMR",  "LMUV", "LMX",  "LMY",  "LRES", "LS",  "LSGAL", "LSGKP", "LTR",  "LVMX", "LIP"});

// What a file of the other version lacks rightly.
const std::set<std::string_view> kOnlyIn61{"PKY4", "PKY5", "PKY6", "PKY7",     "PEY5",   "RBX3", "RBY4",
                                           "LKYC", "PPX1", "PPX2", "PPX3",     "PPX4",   "PPY1", "PPY2",
                                           "PPY3", "PPY4", "PPY5", "INFLPRES", "NOMPRES"};
const std::set<std::string_view> kOnlyIn52{"PHY3", "LGAX", "LGAY"};

std::string Listed(const std::vector<std::string>& names) {
  constexpr std::size_t kShown = 6;
  std::string text;
  for (std::size_t i = 0; i < std::min(names.size(), kShown); ++i) text += (i == 0 ? "" : ", ") + names[i];
  return names.size() > kShown ? text + fmt::format(" and {} more", names.size() - kShown) : text;
}

const MagicFormulaCoefficient* Coefficient(std::string_view key) {
  const auto all = MagicFormulaCoefficients();
  const auto found = std::find_if(all.begin(), all.end(), [&](const auto& each) { return each.name == key; });
  return found == all.end() ? nullptr : &*found;
}

class TirReader {
 public:
  TirReader(std::string_view name, const TirVersion& version) : name_(name), version_(version) {
    file_.version = version.name;
    file_.warnings = version.warnings;
    tyre_.version = version.equations;
    tyre_.friction_ellipse = version.has_ellipse;
  }

  base::Result<TirFile> Read(const TirText& tir) {
    for (const TirEntry& entry : tir.entries) {
      if (auto status = Entry(entry); !status) return status.error();
    }
    for (const auto& step :
         {&TirReader::CheckExtraKeys, &TirReader::CheckNeeded, &TirReader::CheckLoads, &TirReader::ChooseSigns,
          &TirReader::ChoosePressure, &TirReader::CheckStiffness, &TirReader::CheckValues}) {
      if (auto status = (this->*step)(); !status) return status.error();
    }
    TellMissing();
    file_.formula = tyre_;
    if (aligning_.unloaded_radius > 0.0 && lines_.contains("QDZ1") && lines_.contains("QBZ1"))
      file_.aligning = aligning_;
    return std::move(file_);
  }

 private:
  base::Error Wrong(std::string_view message, int line) const {
    return base::WrongInput("tyre.wrong_line", message, fmt::format("{}:{}", name_, line));
  }
  base::Error Wrong(std::string_view message, const std::string& key) const {
    const auto found = lines_.find(key);
    return found == lines_.end() ? base::WrongInput("tyre.wrong_line", message, std::string(name_))
                                 : Wrong(message, found->second);
  }
  void Warn(std::string sentence) { file_.warnings.push_back(std::move(sentence)); }

  base::Status Entry(const TirEntry& entry) {
    if (entry.section == "UNITS") return Unit(entry);
    if (entry.key == "TYRESIDE") return Side(entry);
    std::string key = entry.key;
    for (const auto& [other, own] : kAliases) {
      if (key == other) key = own;
    }
    const MagicFormulaCoefficient* coefficient = Coefficient(key);
    double* const aligning = AligningValue(key);
    const bool is_range = key == "FZMIN" || key == "LIP";
    if (coefficient == nullptr && aligning == nullptr && !is_range) {
      NoteExtraKey(entry);
      return {};
    }
    if (entry.value.empty()) {
      empty_.push_back(entry.key);
      return {};
    }
    const auto number = TirNumber(entry.value);
    if (!number) return Wrong(fmt::format("'{}' is '{}'; a number was expected", entry.key, entry.value), entry.line);
    if (const auto [first, is_new] = lines_.emplace(key, entry.line); !is_new)
      return Wrong(fmt::format("'{}' is given in line {} already", entry.key, first->second), entry.line);
    if (key == "FZMIN")
      fzmin_ = *number;
    else if (key == "LIP")
      nominal_pressure_scale_ = *number;
    else
      (coefficient != nullptr ? tyre_.*coefficient->member : *aligning) = *number;
    return {};
  }

  // Null: no coefficient of the aligning moment.
  double* AligningValue(std::string_view key) {
    const auto found = std::ranges::find(AligningCoefficients(), key, &AligningCoefficient::name);
    return found == AligningCoefficients().end() ? nullptr : &(aligning_.*(found->member));
  }

  base::Status Unit(const TirEntry& entry) const {
    for (const auto& [quantity, unit] : kUnits) {
      if (entry.key != quantity) continue;
      const std::string found = UpperCase(entry.value);
      const std::string expected = UpperCase(unit);
      if (found == expected || found + "S" == expected || found == expected + "S" ||
          (entry.key == "LENGTH" && found == "M") || (entry.key == "FORCE" && found == "N") ||
          (entry.key == "ANGLE" && found == "RAD") || (entry.key == "TIME" && (found == "S" || found == "SEC")) ||
          (entry.key == "MASS" && found == "KILOGRAM")) {
        return {};
      }
      return Wrong(
          fmt::format("{} is given in '{}'; '{}' was expected: SI units are read", entry.key, entry.value, unit),
          entry.line);
    }
    return {};
  }

  base::Status Side(const TirEntry& entry) {
    const std::string side = UpperCase(entry.value);
    if (side == "LEFT" || side == "RIGHT") {
      tyre_.measured_on = side == "LEFT" ? TyreSide::kLeft : TyreSide::kRight;
    } else if (side.empty() || side == "UNKNOWN" || side == "NONE" || side == "BOTH" || side == "SYMMETRIC") {
      Warn(fmt::format("TYRESIDE is '{}': the tyre is the same on both sides of a car", entry.value));
    } else {
      return Wrong(fmt::format("TYRESIDE is '{}'; 'LEFT' or 'RIGHT' was expected, or 'UNKNOWN'", entry.value),
                   entry.line);
    }
    return {};
  }

  void NoteExtraKey(const TirEntry& entry) {
    const bool is_of_forces = entry.section.starts_with("LONGITUDINAL") || entry.section.starts_with("LATERAL") ||
                              entry.section.starts_with("SCALING");
    if (is_of_forces && std::ranges::find(kUnused, entry.key) == kUnused.end())
      extra_.emplace_back(entry.key, entry.line);
  }

  // A key that is not known is a misspelt one if the one that it resembles is missing.
  base::Status CheckExtraKeys() {
    std::vector<std::string> missing;
    const auto& others = version_.equations == MagicFormulaVersion::k52 ? kOnlyIn61 : kOnlyIn52;
    for (const auto& each : MagicFormulaCoefficients()) {
      const bool is_expected = std::ranges::find(empty_, each.name) == empty_.end() && !others.contains(each.name);
      if (is_expected && !lines_.contains(each.name)) missing.emplace_back(each.name);
    }
    std::vector<std::string> passed_over;
    for (const auto& [key, line] : extra_) {
      const std::string near = base::NearestName(key, missing);
      if (!near.empty())
        return Wrong(fmt::format("'{}' is no coefficient of the Magic Formula; did you mean '{}'?", key, near), line);
      passed_over.push_back(key);
    }
    if (!passed_over.empty())
      Warn(fmt::format("passed over, for the forces do not depend on it here: {}", Listed(passed_over)));
    return {};
  }

  base::Status CheckNeeded() {
    for (const std::string_view key : kNeeded) {
      if (lines_.contains(key)) continue;
      return base::WrongInput("tyre.missing_key",
                              fmt::format("a tyre property file with '{}' was expected, and there is none", key),
                              std::string(name_));
    }
    for (const char* key : {"FNOMIN", "FZMAX", "NOMPRES", "INFLPRES", "LFZO"}) {
      const double value = tyre_.*Coefficient(key)->member;
      if (lines_.contains(key) && !(value > 0.0))
        return Wrong(fmt::format("'{}' is {}; more than 0 was expected", key, value), std::string(key));
    }
    return {};
  }

  base::Status CheckLoads() {
    const double nominal = tyre_.fnomin * tyre_.lfzo;
    if (nominal > kMaxLoad_N || nominal < 1.0)
      return Wrong(fmt::format("'FNOMIN' times 'LFZO' is {:g} N; 1 to {:g} N was expected", nominal, kMaxLoad_N),
                   std::string("FNOMIN"));
    if (!lines_.contains("FZMAX")) {
      tyre_.fzmax = std::max(tyre_.fzmax, kLoadsOfNominal * nominal);
      Warn(fmt::format("there is no FZMAX: loads above {:g} N are computed at {:g} N", tyre_.fzmax, tyre_.fzmax));
      return {};
    }
    if (tyre_.fzmax > kMaxLoad_N)
      return Wrong(fmt::format("'FZMAX' is {:g} N; at most {:g} N was expected", tyre_.fzmax, kMaxLoad_N),
                   std::string("FZMAX"));
    if (tyre_.fzmax <= fzmin_)
      return Wrong(fmt::format("'FZMAX' is {:g} N, 'FZMIN' {:g} N; a range of loads was expected", tyre_.fzmax, fzmin_),
                   std::string("FZMAX"));
    if (tyre_.fzmax < 0.1 * nominal)
      return Wrong(fmt::format("'FZMAX' is {:g} N, 'FNOMIN' {:g} N; a range that reaches the nominal load was expected",
                               tyre_.fzmax, nominal),
                   std::string("FZMAX"));
    if (tyre_.fzmax < nominal)
      Warn(fmt::format("FZMAX, {:g} N, lies below the nominal load, {:g} N: larger loads are computed at FZMAX",
                       tyre_.fzmax, nominal));
    return {};
  }

  // D sin(C atan(K x / (C D) …)) is the same for -D, and for -C.
  base::Status ChooseSigns() {
    using S = MagicFormulaSettings;
    const auto flip = [&](double S::*first, std::initializer_list<double S::*> others) {
      if (!(tyre_.*first < 0.0)) return false;
      tyre_.*first = -(tyre_.*first);
      for (double S::*other : others) tyre_.*other = -(tyre_.*other);
      return true;
    };
    if (flip(&S::pdx1, {&S::pdx2}))
      Warn("PDX1 is negative: read with the opposite sign, as PDX2 is; the curve is the same");
    if (flip(&S::pdy1, {&S::pdy2, &S::rvy1, &S::rvy2, &S::rvy3}))
      Warn("PDY1 is negative: read with the opposite sign, as PDY2 and RVY1 to RVY3 are; the curve is the same");
    (void)flip(&S::pcx1, {});
    (void)flip(&S::pcy1, {});
    for (const auto& [key, value] : {std::pair("PCX1", tyre_.pcx1), std::pair("PDX1", tyre_.pdx1),
                                     std::pair("PCY1", tyre_.pcy1), std::pair("PDY1", tyre_.pdy1)}) {
      if (!(value > 0.0)) return Wrong(fmt::format("'{}' is 0; another number was expected", key), std::string(key));
    }
    return {};
  }

  base::Status CheckStiffness() {
    const double nominal = tyre_.fnomin * tyre_.lfzo;
    const double along = LongitudinalStiffness(tyre_, nominal), across = -CorneringStiffness(tyre_, nominal);
    if (!(along > 0.0))
      return Wrong(fmt::format("the slip stiffness at FNOMIN, by PKX1 and its partners, is {:.6g} N; more than 0 was "
                               "expected",
                               along),
                   std::string("PKX1"));
    if (!(across < 0.0))
      return Wrong(fmt::format("the cornering stiffness at FNOMIN, by PKY1, PKY2 and PKY4, is {:.6g} N; a negative "
                               "number was expected: a positive slip angle gives a force to the right",
                               across),
                   std::string("PKY1"));
    return {};
  }

  // What no tyre has is refused; what no tyre of a road vehicle has is warned of.
  base::Status CheckValues() {
    for (const UnusualTyreValue& unusual : UnusualTyreValues(tyre_, &aligning_)) {
      const std::string key(unusual.key);
      if (unusual.is_impossible) return Wrong(fmt::format("'{}': {}", key, unusual.sentence), key);
      const auto line = lines_.find(key);
      Warn(line == lines_.end() ? unusual.sentence
                                : fmt::format("'{}' in line {}: {}", key, line->second, unusual.sentence));
    }
    return {};
  }

  base::Status ChoosePressure() {
    const bool has_nominal = lines_.contains("NOMPRES"), has_pressure = lines_.contains("INFLPRES");
    if (has_nominal && !has_pressure) {
      tyre_.inflpres = tyre_.nompres;
      Warn(fmt::format("there is no INFLPRES: the tyre is at its nominal pressure, {:g} Pa", tyre_.nompres));
    } else if (has_pressure && !has_nominal) {
      tyre_.nompres = tyre_.inflpres;
      Warn(fmt::format("there is no NOMPRES: the pressure, {:g} Pa, counts as the nominal one", tyre_.inflpres));
    } else {
      tyre_.nompres *= nominal_pressure_scale_;
    }
    if (!version_.has_pressure) tyre_.inflpres = tyre_.nompres;
    return {};
  }

  void TellMissing() {
    if (!empty_.empty()) Warn(fmt::format("values that are left empty count as absent: {}", Listed(empty_)));
    if (tyre_.friction_ellipse) return;
    std::vector<std::string> combined;
    for (const char* key : {"RBX1", "RBX2", "RCX1", "RBY1", "RBY2", "RCY1"}) {
      if (!lines_.contains(key)) combined.emplace_back(key);
    }
    if (!combined.empty())
      Warn(fmt::format("combined slip by usual coefficients, for these are missing: {}", Listed(combined)));
  }

  std::string_view name_;
  const TirVersion& version_;
  double fzmin_ = 0.0;
  double nominal_pressure_scale_ = 1.0;
  std::map<std::string, int, std::less<>> lines_;  // where what was read stands
  std::vector<std::string> empty_;
  std::vector<std::pair<std::string, int>> extra_;
  MagicFormulaSettings tyre_;
  AligningSettings aligning_;
  TirFile file_;
};

}  // namespace

base::Result<TirFile> ReadTir(const TirText& tir, const TirVersion& version, std::string_view name) {
  return TirReader(name, version).Read(tir);
}

base::Result<MagicFormulaSettings> ParseTir(std::string_view text, std::string_view name) {
  const TirText tir = SplitTir(text);
  const auto version = FindTirVersion(tir, name);
  if (!version) return version.error();
  if (version.value().model != TirVersion::Model::kMagicFormula)
    return base::WrongInput(
        "tyre.wrong_model",
        fmt::format("this is a tyre of the model {}; one of the Magic Formula was expected", version.value().name),
        std::string(name));
  auto file = ReadTir(tir, version.value(), name);
  if (!file) return file.error();
  return file.value().formula;
}

base::Result<MagicFormulaSettings> LoadTir(const std::filesystem::path& path) {
  const auto text = base::ReadText(path, kMaxBytes);
  if (!text) return text.error();
  return ParseTir(text.value(), path.string());
}

}  // namespace rodeira::dynamics
