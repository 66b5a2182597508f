// SPDX-License-Identifier: Apache-2.0
#include "common/vehicle/dynamics/tir_version.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace rodeira::dynamics {
namespace {

struct OtherFormat {
  std::string_view name, what;
};
constexpr auto kOthers = std::to_array<OtherFormat>({{"PAC89", "the Magic Formula of 1989"},
                                                     {"PACEJKA_89", "the Magic Formula of 1989"},
                                                     {"PAC94", "the Magic Formula of 1994"},
                                                     {"PACEJKA_94", "the Magic Formula of 1994"},
                                                     {"PAC_TIME", "the Magic Formula of the TIME procedure"},
                                                     {"PAC-TIME", "the Magic Formula of the TIME procedure"},
                                                     {"FTIRE", "a structural tyre"},
                                                     {"RMOD_K", "a structural tyre"},
                                                     {"CDTIRE", "a structural tyre"},
                                                     {"UA", "the tyre of the University of Arizona"},
                                                     {"5.2.1", "a tyre by tables"},
                                                     {"521_TIRE", "a tyre by tables"},
                                                     {"SOFT_SOIL", "a tyre on soft soil"},
                                                     {"AIRCRAFT_BASIC", "an aircraft's tyre"}});

// PAC_MC, PAC_MC2, MF_MC, MF-MCTYRE, MF_MOTORCYCLE …
bool IsOfMotorcycle(std::string_view format) {
  return format.find("MOTORCYCLE") != std::string_view::npos || format.find("_MC") != std::string_view::npos ||
         format.find("-MC") != std::string_view::npos;
}

struct VersionReader {
  const TirText& tir;
  std::string_view name;

  base::Error Wrong(std::string_view message, const TirEntry* entry) const {
    return base::WrongInput("tyre.wrong_model", message,
                            entry == nullptr ? std::string(name) : fmt::format("{}:{}", name, entry->line));
  }

  base::Error Motorcycle(const TirEntry* entry) const {
    return Wrong(fmt::format("{} = {} is a motorcycle's tyre; a car's tyre was expected", entry->key, entry->value),
                 entry);
  }

  // A contour and a kind of vehicle tell a motorcycle's tyre whatever the version.
  const TirEntry* SignOfMotorcycle() const {
    for (const char* key : {"TYPE", "VEHICLE_TYPE", "TYRE_TYPE"}) {
      const std::string word = tir.Word(key);
      if (word.find("MOTORCYCLE") != std::string::npos || word == "MC" || word == "BIKE") return tir.Find(key);
    }
    if (IsOfMotorcycle(tir.Word("PROPERTY_FILE_FORMAT"))) return tir.Find("PROPERTY_FILE_FORMAT");
    for (const char* key : {"MC_CONTOUR_A", "MC_CONTOUR_B"}) {
      const TirEntry* contour = tir.Find(key);
      if (contour != nullptr && TirNumber(contour->value).value_or(0.0) != 0.0) return contour;
    }
    return nullptr;
  }

  base::Result<TirVersion> ByFitType(const TirEntry& entry) const {
    const auto number = TirNumber(entry.value);
    const int type = number && *number == static_cast<int>(*number) ? static_cast<int>(*number) : -1;
    TirVersion version;
    const bool is_old = type == 5 || type == 6 || type == 21 || type == 51 || type == 52;
    version.equations = is_old ? MagicFormulaVersion::k52 : MagicFormulaVersion::k61;
    switch (type) {
      case 5:
        version.name = "Magic Formula 5.0";
        break;
      case 51:
        version.name = "Magic Formula 5.1";
        break;
      case 6:
      case 21:  // of TNO's programs before MF-Tyre 6
      case 52:
        version.name = "Magic Formula 5.2";
        return version;
      case 60:
        version.name = "Magic Formula 6.0";
        version.has_pressure = false;
        version.warnings.push_back(
            "FITTYP 60: computed by the equations of 6.1 without inflation pressure, which 6.0 does not know");
        return version;
      case 61:
        version.name = "Magic Formula 6.1";
        return version;
      case 62:
        version.name = "Magic Formula 6.2";
        version.warnings.push_back(
            "FITTYP 62: the forces of 6.2 are those of 6.1; its effects of camber on load and radius are missing");
        return version;
      default:
        return Wrong(fmt::format("FITTYP is {}; 5, 6, 21, 51, 52 (Magic Formula 5.2) or 60, 61, 62 (6.1) was expected",
                                 entry.value.empty() ? "empty" : entry.value),
                     &entry);
    }
    version.warnings.push_back(fmt::format(
        "FITTYP {}: computed by the equations of 5.2; a coefficient that the older version does not know is 0", type));
    return version;
  }

  base::Result<TirVersion> Read() const {
    if (!tir.HasSection("MODEL") && !tir.HasSection("UNITS") && tir.Find("FITTYP") == nullptr)
      return Wrong("this is no tyre property file (.tir): it has no section [MODEL]", nullptr);
    const TirEntry* format_entry = tir.Find("PROPERTY_FILE_FORMAT");
    const std::string format = tir.Word("PROPERTY_FILE_FORMAT");
    for (const OtherFormat& other : kOthers) {
      if (format != other.name) continue;
      return Wrong(fmt::format("PROPERTY_FILE_FORMAT is '{}', {}; the Magic Formula 5 or 6, PAC2002 or FIALA was "
                               "expected",
                               format_entry->value, other.what),
                   format_entry);
    }
    if (const TirEntry* sign = SignOfMotorcycle()) return Motorcycle(sign);
    if (format == "FIALA") return TirVersion{TirVersion::Model::kFiala, "Fiala", {}, false, false, {}};
    const bool has_ellipse = tir.Word("FE_METHOD") == "YES";
    if (format == "PAC2002")
      return TirVersion{TirVersion::Model::kMagicFormula, "PAC2002", MagicFormulaVersion::k52, true, has_ellipse, {}};
    const TirEntry* type = tir.Find("FITTYP");
    if (type == nullptr && (format == "MF_05" || format == "MF-TYRE" || format == "MF_TYRE")) {
      return TirVersion{TirVersion::Model::kMagicFormula,
                        "Magic Formula 5.2",
                        MagicFormulaVersion::k52,
                        true,
                        has_ellipse,
                        {fmt::format("there is no FITTYP; '{}' is computed by the equations of 5.2", format)}};
    }
    if (type == nullptr && format_entry != nullptr && format != "USER") {
      return Wrong(fmt::format("PROPERTY_FILE_FORMAT is '{}', and there is no FITTYP; 'PAC2002', 'FIALA' or a FITTYP "
                               "of the Magic Formula was expected",
                               format_entry->value),
                   format_entry);
    }
    if (type == nullptr) return Wrong("a tyre property file with 'FITTYP' was expected, and there is none", nullptr);
    auto version = ByFitType(*type);
    if (version) version.value().has_ellipse = has_ellipse;
    return version;
  }
};

}  // namespace

base::Result<TirVersion> FindTirVersion(const TirText& tir, std::string_view name) {
  return VersionReader{tir, name}.Read();
}

}  // namespace rodeira::dynamics
