// SPDX-License-Identifier: Apache-2.0
#include "common/analysis/measures/condition.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

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
constexpr std::string_view kSigns = "<>=!", kBlank = " \t";

std::string_view Trimmed(std::string_view text) {
  const auto begin = text.find_first_not_of(kBlank);
  if (begin == std::string_view::npos) return {};
  return text.substr(begin, text.find_last_not_of(kBlank) - begin + 1);
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
  const std::string_view number = Trimmed(rest.substr(relation->first.size()));
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

bool Condition::Holds(const Drive& drive, std::size_t k) const {
  return std::ranges::all_of(
      terms, [&](const Term& term) { return Compare(SeriesValue(drive, term.column, k), term.relation, term.number); });
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
