// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <memory>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

#include "common/core/base/hash.hpp"
#include "common/core/base/suggest.hpp"
#include "common/world/road/world.hpp"
#include "launch/python/columns.hpp"
#include "launch/python/extension.hpp"

namespace rodeira::python {
namespace {

namespace py = pybind11;
using LaneName = std::tuple<std::string, int, int>;  // the road's id, the section's number, the lane's id

// A world file with its lanes, named by the ids of their roads.
class PythonWorld {
 public:
  explicit PythonWorld(const std::string& file) : file_(file), world_(ValueOrRaise(road::World::Load(file))) {
    if (world_->network() == nullptr)
      Raise(base::WrongInput("world.no_road", "the world has no roads; lanes were expected", file));
  }

  std::string name() const { return world_->name(); }
  std::string content_hash() const { return base::Hex(world_->content_hash()); }

  std::vector<LaneName> Lanes() const {
    std::vector<LaneName> names;
    for (const network::LaneKey& key : network().Lanes()) names.push_back(NameOf(key));
    return names;
  }

  // Columns of one row a point: road (index into RoadIds, -1: none), section, lane, s, t, z, distance, lane width,
  // position in the lane, lane's heading. z may be NaN.
  py::dict Locate(const Numbers& x_m, const Numbers& y_m, const Numbers& z_m) const {
    const std::vector<double> x = VectorOf(x_m), y = VectorOf(y_m), z = VectorOf(z_m);
    if (x.size() != y.size() || x.size() != z.size())
      throw py::value_error("x, y and z of the same length were expected");
    constexpr const char* kNames[] = {
        "road", "section", "lane", "s_m", "t_m", "z_m", "distance_m", "lane_width_m", "lane_position_m", "heading_rad"};
    std::vector<std::vector<double>> columns(std::size(kNames), std::vector<double>(x.size(), std::nan("")));
    network::Hint hint;
    for (std::size_t i = 0; i < x.size(); ++i) {
      const auto place = network().Locate(x[i], y[i], std::isnan(z[i]) ? std::nullopt : std::optional(z[i]), &hint);
      columns[0][i] = -1.0;
      if (!place) continue;
      const network::LaneKey& key = place->lane;
      const auto span = network().Span(key, place->s_m);
      const double values[] = {static_cast<double>(key.road),
                               static_cast<double>(key.section),
                               static_cast<double>(key.lane),
                               place->s_m,
                               place->t_m,
                               place->z_m,
                               place->distance_m,
                               span ? span->width_m() : std::nan(""),
                               span ? place->t_m - span->centre_t_m() : std::nan(""),
                               network().roads()[key.road].axis().Evaluate(place->s_m).heading_rad};
      for (std::size_t c = 0; c < columns.size(); ++c) columns[c][i] = values[c];
    }
    py::dict all;
    for (std::size_t c = 0; c < columns.size(); ++c) all[kNames[c]] = ArrayOf(columns[c]);
    return all;
  }

  std::vector<std::string> RoadIds() const {
    std::vector<std::string> ids;
    for (const network::Road& road : network().roads()) ids.push_back(road.spec().id);
    return ids;
  }

  // The lanes that a lane goes on into in the direction of its traffic, each with the station at which it is entered.
  std::vector<std::tuple<LaneName, double>> Next(const LaneName& name) const {
    std::vector<std::tuple<LaneName, double>> next;
    for (const network::LaneEnd& end : network().Successors(KeyOf(name))) {
      const network::LaneSection& section = network().Section(end.lane);
      next.emplace_back(NameOf(end.lane), end.end == network::End::kStart ? section.s_m : section.end_s_m);
    }
    return next;
  }

  // The stations at which a lane begins and ends, along the road.
  std::pair<double, double> Stations(const LaneName& name) const {
    const network::LaneSection& section = network().Section(KeyOf(name));
    return {section.s_m, section.end_s_m};
  }

  // Whether the traffic of the lane goes along the stations.
  bool Along(const LaneName& name) const {
    const network::LaneKey key = KeyOf(name);
    const auto next = network().Successors(key), at_end = network().AtEnd(key);
    return next.data() == at_end.data();
  }

  // Points of the lane's right edge, middle and left edge as seen along the stations: arrays of (n, 3).
  py::tuple Lines(const LaneName& name, double step_m) const {
    if (!(step_m > 0.0)) throw py::value_error("a step above 0 m was expected");
    const network::LaneKey key = KeyOf(name);
    const network::LaneSection& section = network().Section(key);
    const network::Road& road = network().roads()[key.road];
    const auto pieces = static_cast<py::ssize_t>(std::max(1.0, std::ceil((section.end_s_m - section.s_m) / step_m)));
    py::array_t<double> right({pieces + 1, py::ssize_t{3}}), middle({pieces + 1, py::ssize_t{3}}),
        left({pieces + 1, py::ssize_t{3}});
    for (py::ssize_t i = 0; i <= pieces; ++i) {
      const double share = static_cast<double>(i) / static_cast<double>(pieces);
      const double s = road.Held(key.section, section.s_m + share * (section.end_s_m - section.s_m));
      const auto span = network().Span(key, s);
      const auto at = [&](double t) { return road.Surface(s, t, section, *span).p_W; };
      const double low = std::min(span->inner_t_m, span->outer_t_m), high = std::max(span->inner_t_m, span->outer_t_m);
      const Eigen::Vector3d points[] = {at(low), at(span->centre_t_m()), at(high)};
      py::array_t<double>* arrays[] = {&right, &middle, &left};
      for (int line = 0; line < 3; ++line) {
        for (py::ssize_t axis = 0; axis < 3; ++axis) arrays[line]->mutable_at(i, axis) = points[line][axis];
      }
    }
    return py::make_tuple(right, middle, left);
  }

 private:
  const network::Network& network() const { return *world_->network(); }
  LaneName NameOf(const network::LaneKey& key) const {
    return {network().roads()[key.road].spec().id, static_cast<int>(key.section), key.lane};
  }
  network::LaneKey KeyOf(const LaneName& name) const {
    const auto& [road, section, lane] = name;
    const auto found = network().FindRoad(road);
    if (!found)
      Raise(base::WrongInput("world.unknown_road", "unknown road '" + road + "'" + base::DidYouMean(road, RoadIds()),
                             file_));
    const auto sections = network().roads()[*found].spec().sections.size();
    const network::LaneKey key{*found, static_cast<std::uint32_t>(section), lane};
    if (section < 0 || static_cast<std::size_t>(section) >= sections || network().Find(key) == nullptr)
      Raise(base::WrongInput("world.unknown_lane",
                             "road '" + road + "' has no lane " + std::to_string(lane) + " in section " +
                                 std::to_string(section) + "; it has " + std::to_string(sections) + " sections",
                             file_));
    return key;
  }

  std::string file_;
  std::shared_ptr<const road::World> world_;
};

}  // namespace

void AddWorld(py::module_& module) {
  py::class_<PythonWorld>(module, "World")
      .def(py::init<const std::string&>())
      .def_property_readonly("name", &PythonWorld::name)
      .def_property_readonly("content_hash", &PythonWorld::content_hash)
      .def("lanes", &PythonWorld::Lanes)
      .def("road_ids", &PythonWorld::RoadIds)
      .def("locate", &PythonWorld::Locate)
      .def("next", &PythonWorld::Next)
      .def("stations", &PythonWorld::Stations)
      .def("along", &PythonWorld::Along)
      .def("lines", &PythonWorld::Lines);
}

}  // namespace rodeira::python
