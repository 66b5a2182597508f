// SPDX-License-Identifier: Apache-2.0
#include "common/vehicle/dynamics/tir_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "common/core/base/files.hpp"
#include "common/core/base/suggest.hpp"

namespace rodeira::dynamics {
namespace {

constexpr std::size_t kMostBytes = 1u << 20;
constexpr auto kNeeded =
    std::to_array<std::string_view>({"FITTYP", "FNOMIN", "PCX1", "PDX1", "PKX1", "PCY1", "PDY1", "PKY1"});
constexpr auto kUnits = std::to_array<std::pair<std::string_view, std::string_view>>(
    {{"LENGTH", "meter"}, {"FORCE", "newton"}, {"ANGLE", "radians"}, {"MASS", "kg"}, {"TIME", "second"}});

// Coefficients of the directions and scales that the forces here have no use for: relaxation, moments, turn slip,
// structure.
constexpr auto kUnused =
    std::to_array<std::string_view>({"PTX1", "PTX2", "PTX3", "PTY1", "PTY2", "LCZ", "LGAZ", "LGYR", "LKZC", "LMP",
                                     "LMUV", "LMX", "LMY", "LRES", "LS", "LSGAL", "LSGKP", "LTR", "LVMX"});

std::string_view Trimmed(std::string_view text) {
  constexpr std::string_view kBlank = " \t\r\f\v";
  const auto begin = text.find_first_not_of(kBlank);
  if (begin == std::string_view::npos) return {};
  return text.substr(begin, text.find_last_not_of(kBlank) - begin + 1);
}

std::string Upper(std::string_view text) {
  std::string upper(text);
  std::transform(upper.begin(), upper.end(), upper.begin(),
                 [](char c) { return c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c; });
  return upper;
}

std::optional<double> Number(std::string_view text) {
  if (text.starts_with('+')) text.remove_prefix(1);
  double value = 0.0;
  const auto [end, problem] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (problem != std::errc() || end != text.data() + text.size() || !std::isfinite(value)) return std::nullopt;
  return value;
}

const MagicFormulaCoefficient* Coefficient(std::string_view key) {
  const auto all = MagicFormulaCoefficients();
  const auto found = std::find_if(all.begin(), all.end(), [&](const auto& each) { return each.name == key; });
  return found == all.end() ? nullptr : &*found;
}

class Reader {
 public:
  explicit Reader(std::string_view name) : name_(name) {}

  base::Result<MagicFormulaSettings> Read(std::string_view text) {
    for (std::size_t begin = 0; begin <= text.size();) {
      const std::size_t end = std::min(text.find('\n', begin), text.size());
      ++line_;
      if (auto status = Line(text.substr(begin, end - begin)); !status) return status.error();
      begin = end + 1;
    }
    for (const std::string_view key : kNeeded) {
      if (!lines_.contains(key))
        return base::WrongInput(fmt::format("a tyre property file with '{}' was expected, and there is none", key),
                                std::string(name_));
    }
    return Checked();
  }

 private:
  base::Error Wrong(std::string_view message, int line) const {
    return base::WrongInput(message, fmt::format("{}:{}", name_, line));
  }

  base::Status Line(std::string_view line) {
    line = Trimmed(line.substr(0, line.find_first_of("$!")));
    if (line.starts_with('[')) {
      section_ = Upper(Trimmed(line.substr(1, line.find(']') - 1)));
      return {};
    }
    const auto equals = line.find('=');
    if (equals == std::string_view::npos) return {};  // a table's heading or row
    const std::string key = Upper(Trimmed(line.substr(0, equals)));
    const std::string_view value = Trimmed(line.substr(equals + 1));
    if (section_ == "UNITS") return Unit(key, value);
    return Value(key, value);
  }

  base::Status Unit(const std::string& key, std::string_view value) const {
    for (const auto& [quantity, unit] : kUnits) {
      if (key != quantity) continue;
      std::string found = Upper(value);
      std::erase(found, '\'');
      std::erase(found, '"');
      const std::string expected = Upper(unit);
      if (found == expected || found + "S" == expected || found == expected + "S" ||
          (key == "LENGTH" && found == "M") || (key == "FORCE" && found == "N") || (key == "ANGLE" && found == "RAD") ||
          (key == "TIME" && (found == "S" || found == "SEC")) || (key == "MASS" && found == "KILOGRAM")) {
        return {};
      }
      return Wrong(fmt::format("{} is given in {}; '{}' was expected: SI units are read", key, value, unit), line_);
    }
    return {};
  }

  base::Status Value(const std::string& key, std::string_view value) {
    const MagicFormulaCoefficient* coefficient = Coefficient(key);
    if (key == "TYRESIDE") return Side(value);
    if (coefficient == nullptr && key != "FITTYP") return Unused(key);
    const auto number = Number(value);
    if (!number) return Wrong(fmt::format("'{}' is '{}'; a number was expected", key, value), line_);
    if (const auto [first, is_new] = lines_.emplace(key, line_); !is_new)
      return Wrong(fmt::format("'{}' stands in line {} already", key, first->second), line_);
    (coefficient != nullptr ? tyre_.*coefficient->member : fit_type_) = *number;
    return {};
  }

  base::Status Side(std::string_view value) {
    std::string found = Upper(value);
    std::erase(found, '\'');
    std::erase(found, '"');
    if (found != "LEFT" && found != "RIGHT")
      return Wrong(fmt::format("TYRESIDE is {}; 'LEFT' or 'RIGHT' was expected", value), line_);
    tyre_.measured_on = found == "LEFT" ? TyreSide::kLeft : TyreSide::kRight;
    return {};
  }

  // Among the coefficients of the two directions and their scales there is none that is unknown: it would be a slip
  // of the pen.
  base::Status Unused(const std::string& key) const {
    const bool strict =
        section_.starts_with("LONGITUDINAL") || section_.starts_with("LATERAL") || section_.starts_with("SCALING");
    if (!strict || std::ranges::find(kUnused, key) != kUnused.end()) return {};
    std::vector<std::string> known(kUnused.begin(), kUnused.end());
    for (const auto& each : MagicFormulaCoefficients()) known.emplace_back(each.name);
    return Wrong(fmt::format("'{}' is no coefficient of the Magic Formula{}", key, base::DidYouMean(key, known)),
                 line_);
  }

  base::Result<MagicFormulaSettings> Checked() {
    constexpr std::array kOld{5.0, 6.0, 51.0, 52.0};
    constexpr std::array kNew{60.0, 61.0, 62.0};
    const auto is_one_of = [this](const auto& types) {
      return std::find(types.begin(), types.end(), fit_type_) != types.end();
    };
    if (!is_one_of(kOld) && !is_one_of(kNew)) {
      return Wrong(
          fmt::format("FITTYP is {}; 5, 6, 51, 52 (Magic Formula 5.2) or 60, 61, 62 (6.1) was expected", fit_type_),
          lines_.at("FITTYP"));
    }
    tyre_.version = is_one_of(kOld) ? MagicFormulaVersion::k52 : MagicFormulaVersion::k61;
    for (const char* key : {"FNOMIN", "FZMAX", "NOMPRES", "INFLPRES", "LFZO", "PCX1", "PDX1", "PKX1", "PCY1", "PDY1"}) {
      const double value = tyre_.*Coefficient(key)->member;
      if (lines_.contains(key) && !(value > 0.0))
        return Wrong(fmt::format("'{}' is {}; more than 0 was expected", key, value), lines_.at(key));
    }
    if (!(tyre_.pky1 < 0.0)) {
      return Wrong(
          fmt::format("'PKY1' is {}; a negative number was expected: a positive slip angle gives a force to the right",
                      tyre_.pky1),
          lines_.at("PKY1"));
    }
    return tyre_;
  }

  std::string_view name_;
  int line_ = 0;
  std::string section_;
  double fit_type_ = 0.0;
  std::map<std::string, int, std::less<>> lines_;  // where what was read stands
  MagicFormulaSettings tyre_;
};

}  // namespace

base::Result<MagicFormulaSettings> ParseTir(std::string_view text, std::string_view name) {
  return Reader(name).Read(text);
}

base::Result<MagicFormulaSettings> LoadTir(const std::filesystem::path& path) {
  const auto text = base::ReadText(path, kMostBytes);
  if (!text) return text.error();
  return ParseTir(text.value(), path.string());
}

}  // namespace rodeira::dynamics
