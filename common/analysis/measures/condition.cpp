// SPDX-License-Identifier: Apache-2.0
#include "common/analysis/measures/condition.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

#include "common/core/base/suggest.hpp"

namespace rodeira::measures {
namespace {

using Relation = Condition::Relation;
// Longer signs first: "<=" begins with "<".
constexpr std::array<std::pair<std::string_view, Relation>, 6> kRelations{{{"<=", Relation::kAtMost},
                                                                           {">=", Relation::kAtLeast},
                                                                           {"==", Relation::kEqual},
                                                                           {"!=", Relation::kNotEqual},
                                                                           {"<", Relation::kBelow},
                                                                           {">", Relation::kAbove}}};
constexpr std::string_view kSigns = "<>=!", kBlank = " \t", kRoad = "road", kStation = "s_m";

std::string_view Trimmed(std::string_view text) {
  const auto begin = text.find_first_not_of(kBlank);
  if (begin == std::string_view::npos) return {};
  return text.substr(begin, text.find_last_not_of(kBlank) - begin + 1);
}

// 'NAME', or a word that begins like no number.
bool IsName(std::string_view text) {
  if (text.size() > 2 && text.front() == '\'' && text.back() == '\'') return true;
  return !text.empty() && text.find_first_of(" \t'\"") == std::string_view::npos &&
         std::string_view("+-.0123456789").find(text.front()) == std::string_view::npos && text != "nan" &&
         text != "inf";
}

base::Result<Condition::Term> ParseTerm(std::string_view text) {
  const auto sign = text.find_first_of(kSigns);
  const auto column = Trimmed(text.substr(0, sign));
  if (sign == std::string_view::npos || column.empty()) {
    return base::WrongInput(
        "measure.wrong_condition",
        fmt::format("'{}' is no comparison; COLUMN, one of < <= > >= == !=, and a number were expected, as "
                    "speed_mps > 20; several are joined by 'and'",
                    Trimmed(text)));
  }
  Condition::Term term;
  const auto found = FindSeries(column);
  if (!found) return found.error();
  term.column = found.value();
  const std::string_view rest = text.substr(sign);
  const auto relation =
      std::ranges::find_if(kRelations, [rest](const auto& known) { return rest.starts_with(known.first); });
  if (relation == kRelations.end()) {
    const auto end = std::min(rest.find_first_not_of(kSigns), rest.size());
    return base::WrongInput("measure.wrong_condition",
                            fmt::format("'{}' compares nothing; < <= > >= == or != was expected", rest.substr(0, end)));
  }
  term.relation = relation->second;
  std::string_view number = Trimmed(rest.substr(relation->first.size()));
  const bool by_name = term.relation == Relation::kEqual || term.relation == Relation::kNotEqual;
  if (column == kRoad && by_name && IsName(number)) {
    if (number.front() == '\'') number = number.substr(1, number.size() - 2);
    term.road = std::string(number);
    return term;
  }
  const auto [end, error] = std::from_chars(number.data(), number.data() + number.size(), term.number);
  if (error != std::errc() || end != number.data() + number.size() || !std::isfinite(term.number))
    return base::WrongInput("measure.wrong_condition", fmt::format("'{}' is no number; one was expected behind '{} {}'",
                                                                   number, column, relation->first));
  return term;
}

bool Compare(double value, Relation relation, double number) {
  switch (relation) {
    case Relation::kBelow:
      return value < number;
    case Relation::kAtMost:
      return value <= number;
    case Relation::kAbove:
      return value > number;
    case Relation::kAtLeast:
      return value >= number;
    case Relation::kEqual:
      return value == number;
    case Relation::kNotEqual:
      return !std::isnan(value) && value != number;
  }
  return false;
}

}  // namespace

std::string Condition::FindRoads(std::span<const NamedRoad> roads) {
  for (Term& term : terms) {
    if (term.road.empty()) continue;
    const auto found = std::ranges::find(roads, term.road, &NamedRoad::name);
    if (found != roads.end()) {
      term.parts = found->parts;
      continue;
    }
    std::vector<std::string> names;
    for (const NamedRoad& road : roads) names.push_back(road.name);
    return fmt::format("the world has no road '{}'{}", term.road,
                       roads.empty() ? "; it has no roads" : base::DidYouMean(term.road, names));
  }
  return {};
}

bool Condition::Holds(const Drive& drive, std::size_t k) const {
  static const std::size_t kStationColumn = FindSeries(kStation).value();
  double from_s_m = 0.0;  // of the part of the named road that the vehicle is on
  for (const Term& term : terms) {
    if (term.road.empty()) continue;
    const double road = drive.road[k];
    const auto part = std::ranges::find(term.parts, road, &NamedRoad::Part::road);
    const bool on_it = part != term.parts.end(), wanted = term.relation == Relation::kEqual;
    if (std::isnan(road) || on_it != wanted) return false;
    if (on_it) from_s_m = part->from_s_m;
  }
  return std::ranges::all_of(terms, [&](const Term& term) {
    if (!term.road.empty()) return true;
    const double value = SeriesValue(drive, term.column, k);
    return Compare(term.column == kStationColumn ? value + from_s_m : value, term.relation, term.number);
  });
}

base::Result<Condition> ParseCondition(std::string_view text) {
  constexpr std::string_view kAnd = " and ";
  Condition condition;
  condition.text = std::string(Trimmed(text));
  std::string_view rest = condition.text;
  while (true) {
    const auto joint = rest.find(kAnd);
    auto term = ParseTerm(rest.substr(0, joint));
    if (!term) return term.error();
    condition.terms.push_back(term.value());
    if (joint == std::string_view::npos) return condition;
    rest = rest.substr(joint + kAnd.size());
  }
}

std::vector<std::pair<std::size_t, std::size_t>> SamplesWhile(const Condition& condition, const Drive& drive,
                                                              std::size_t from, std::size_t to) {
  std::vector<std::pair<std::size_t, std::size_t>> runs;
  bool before = false;
  for (std::size_t k = from; k < std::min(to, drive.size()); ++k) {
    const bool holds = !std::isnan(drive.x_m[k]) && condition.Holds(drive, k);
    if (holds && !before) runs.emplace_back(k, k);
    if (holds) runs.back().second = k + 1;
    before = holds;
  }
  return runs;
}

}  // namespace rodeira::measures
