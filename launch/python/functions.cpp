// SPDX-License-Identifier: Apache-2.0
#include <map>
#include <string>
#include <tuple>
#include <vector>

#include "common/analysis/measures/encroachment.hpp"
#include "common/analysis/measures/gap_acceptance.hpp"
#include "common/analysis/measures/mean_deviation.hpp"
#include "launch/python/columns.hpp"
#include "launch/python/extension.hpp"

namespace rodeira::python {
namespace {

namespace py = pybind11;
using Signs = std::vector<std::tuple<double, double>>;  // station, lateral position of the lane's middle

py::tuple ValueOf(const measures::Measure& m) {
  std::map<std::string, std::string> options;
  for (const measures::UsedOption& option : m.options) options[option.name] = option.value;
  return py::make_tuple(m.value ? py::object(py::float_(*m.value)) : py::object(py::none()), m.unit, m.n, m.valid_share,
                        m.reason, options);
}

std::vector<measures::LaneChangeSign> SignsOf(const Signs& signs) {
  std::vector<measures::LaneChangeSign> all;
  for (const auto& [s_m, target_t_m] : signs) {
    if (!all.empty() && !(s_m > all.back().s_m)) throw py::value_error("signs of ascending stations were expected");
    all.push_back({s_m, target_t_m});
  }
  return all;
}

std::pair<std::vector<double>, std::vector<double>> PathOf(const Numbers& s_m, const Numbers& t_m) {
  auto path = std::pair(VectorOf(s_m), VectorOf(t_m));
  if (path.first.size() != path.second.size()) throw py::value_error("s and t of the same length were expected");
  return path;
}

py::tuple MeanDeviation(const Numbers& s_m, const Numbers& t_m, double from_s_m, double to_s_m, const Signs& signs,
                        double before_m, double length_m, double start_t_m) {
  if (!(length_m > 0.0)) throw py::value_error("a change of the reference path longer than 0 m was expected");
  const auto [s, t] = PathOf(s_m, t_m);
  return ValueOf(measures::MeanDeviation(s, t, from_s_m, to_s_m, SignsOf(signs), {before_m, length_m, start_t_m}));
}

py::tuple CorrectChanges(const Numbers& s_m, const Numbers& t_m, const Signs& signs, double half_lane_m, double by_m) {
  const auto [s, t] = PathOf(s_m, t_m);
  return ValueOf(measures::CorrectChanges(s, t, SignsOf(signs), half_lane_m, by_m));
}

std::vector<measures::Footprint> FootprintsOf(const py::tuple& path, double length_m, double width_m) {
  const std::vector<double> x = VectorOf(path[0].cast<Numbers>()), y = VectorOf(path[1].cast<Numbers>()),
                            heading = VectorOf(path[2].cast<Numbers>());
  if (x.size() != y.size() || x.size() != heading.size())
    throw py::value_error("x, y and heading of the same length were expected");
  std::vector<measures::Footprint> footprints(x.size());
  for (std::size_t i = 0; i < x.size(); ++i) footprints[i] = {{x[i], y[i]}, heading[i], length_m, width_m};
  return footprints;
}

py::tuple PostEncroachment(const py::tuple& a, double a_length_m, double a_width_m, const py::tuple& b,
                           double b_length_m, double b_width_m, double rate_hz) {
  const auto first = FootprintsOf(a, a_length_m, a_width_m), second = FootprintsOf(b, b_length_m, b_width_m);
  if (first.size() != second.size()) throw py::value_error("two paths of the same length were expected");
  if (!(rate_hz > 0.0)) throw py::value_error("a rate above 0 was expected");
  return ValueOf(measures::PostEncroachmentTime(first, second, rate_hz));
}

py::tuple RaffGap(const Numbers& accepted_s, const Numbers& rejected_s) {
  return ValueOf(measures::RaffCriticalGap(VectorOf(accepted_s), VectorOf(rejected_s)));
}

py::tuple TroutbeckGap(const std::vector<std::tuple<double, double>>& drivers) {
  std::vector<measures::GapDecision> decisions;
  for (const auto& [accepted_s, largest_rejected_s] : drivers) decisions.push_back({accepted_s, largest_rejected_s});
  return ValueOf(measures::TroutbeckCriticalGap(decisions));
}

}  // namespace

void AddFunctions(py::module_& module) {
  module.def("mean_deviation", MeanDeviation);
  module.def("correct_changes", CorrectChanges);
  module.def("post_encroachment", PostEncroachment);
  module.def("raff_gap", RaffGap);
  module.def("troutbeck_gap", TroutbeckGap);
}

}  // namespace rodeira::python
