// SPDX-License-Identifier: Apache-2.0
#include "common/world/design/design_reader.hpp"
#include "common/world/design/behind_end.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <deque>
#include <set>

#include "common/core/base/suggest.hpp"
#include "common/core/geometry/angle.hpp"
#include "common/world/design/design_schema.hpp"
#include "common/world/design/join_check.hpp"
#include "common/world/design/junction_builder.hpp"
#include "common/world/design/props_reader.hpp"

namespace rodeira::design {
namespace {

using config::DeclaredMap;
using config::Map;
using network::End;

constexpr std::size_t kMaxFiles = 1000;
constexpr double kFromStart_m = 10.0;  // of a road, where nothing else is said

// One name for a file, however it is written; of what cannot be a file the text itself.
std::filesystem::path Canonical(const std::filesystem::path& path) {
  std::error_code problem;
  std::filesystem::path canonical = std::filesystem::weakly_canonical(path, problem);
  return problem ? path.lexically_normal() : canonical;
}

// The file itself and what it includes, each once, in the order in which they are named.
class Files {
 public:
  explicit Files(const config::File& file) {
    roots_.push_back(file.root());
    seen_.insert(Canonical(file.path()));
    for (std::size_t i = 0; i < roots_.size(); ++i) Include(roots_[i]);
  }

  const std::deque<Map>& roots() const { return roots_; }
  // Problems of the included files.
  std::vector<base::Error> Problems() const {
    std::vector<base::Error> all;
    for (const config::File& file : files_) {
      const auto problems = file.Problems();
      all.insert(all.end(), problems.begin(), problems.end());
    }
    return all;
  }

 private:
  void Include(const Map root) {
    const config::DeclaredList declared = DeclaredMap(root, DesignKeys()).Items("include");
    const config::List& list = declared.list();
    for (std::size_t i = 0; i < list.size(); ++i) {
      const std::filesystem::path named = declared.Text(i);
      const std::string place = list.Place(i);
      const std::filesystem::path folder = std::filesystem::path(place.substr(0, place.rfind(':'))).parent_path();
      const std::filesystem::path path = named.is_absolute() ? named : folder / named;
      if (!seen_.insert(Canonical(path)).second) {
        list.Problem(i, "config.duplicate_name", fmt::format("'{}' is included already", named.string()));
        continue;
      }
      if (seen_.size() > kMaxFiles) return;
      auto file = config::File::Load(path);
      if (!file) {
        list.Problem(i, file.error().id, file.error().Text());
        continue;
      }
      files_.push_back(std::move(file).value());
      roots_.push_back(files_.back().root());
      const std::string version = DeclaredMap(roots_.back(), IncludeSchema().keys).MapWith("rodeira").Text("rodeira");
      if (version != "world/2" && roots_.back().Has("rodeira"))
        roots_.back().Problem("rodeira", "config.other_version",
                              fmt::format("'rodeira' is '{}'; an included file says 'world/2'", version));
    }
  }

  std::deque<config::File> files_;
  std::deque<Map> roots_;
  std::set<std::filesystem::path> seen_;
};

struct Link {
  std::size_t road = 0;
  End end = End::kEnd, contact = End::kStart;
  std::string other;
  Map map;
};

void ReadLinks(const DeclaredMap& road, std::size_t index, std::vector<Link>& links) {
  for (const char* key : {"predecessor", "successor"}) {
    if (!road.map().Has(key)) continue;
    const DeclaredMap link = road.Child(key);
    const std::string other = link.Text("road");
    const bool start = link.Word("end") == "start";
    links.push_back({index, *key == 's' ? End::kEnd : End::kStart, start ? End::kStart : End::kEnd, other, link.map()});
  }
}

// The piece at an end of a road of the file; nothing where a junction lies there.
std::optional<std::size_t> PieceAt(const Layout& layout, std::size_t design, End end) {
  std::optional<std::size_t> found;
  for (std::size_t i = 0; i < layout.pieces.size(); ++i) {
    if (layout.pieces[i].design == design && (end == End::kEnd || !found)) found = i;
  }
  return found;
}

void JoinLanes(network::RoadSpec& own, End end, const network::RoadSpec& other, End contact) {
  const int sign = end == contact ? -1 : 1;
  for (auto* side : {&own.sections[0].left, &own.sections[0].right}) {
    for (network::Lane& lane : *side) {
      const network::Lane* beyond = other.sections[0].Find(sign * lane.id);
      if (beyond == nullptr || network::IsDrivable(beyond->type) != network::IsDrivable(lane.type)) continue;
      (end == End::kEnd ? lane.successors : lane.predecessors) = {beyond->id};
    }
  }
}

void JoinRoads(const std::vector<Link>& links, const std::vector<RoadDesign>& designs, Layout& layout,
               std::vector<std::string>& warnings) {
  std::set<std::pair<std::pair<std::size_t, End>, std::pair<std::size_t, End>>> seen;
  std::vector<network::RoadSpec> specs;
  for (const network::Road& road : layout.network.roads) specs.push_back(road.spec());
  const auto join = [&](std::size_t own, End end, std::size_t other, End contact) {
    auto& link = end == End::kEnd ? specs[own].successor : specs[own].predecessor;
    link = network::RoadLink{false, specs[other].id, contact};
    JoinLanes(specs[own], end, specs[other], contact);
  };
  for (const Link& link : links) {
    std::vector<std::string> ids;
    std::optional<std::size_t> target;
    for (std::size_t i = 0; i < designs.size(); ++i) {
      ids.push_back(designs[i].spec.id);
      if (designs[i].spec.id == link.other) target = i;
    }
    if (!target) {
      link.map.Problem("road", "world.unknown_road",
                       fmt::format("there is no road '{}'{}", link.other, base::DidYouMean(link.other, ids)));
      continue;
    }
    const auto own = PieceAt(layout, link.road, link.end), other = PieceAt(layout, *target, link.contact);
    if (!own || !other) continue;
    const auto at = [&](std::size_t piece, End end) {
      const Piece& part = layout.pieces[piece];
      return JoinEnd{layout.network.roads[piece], end, designs[part.design].spec.id,
                     end == End::kStart ? part.from_s_m : part.to_s_m};
    };
    // Said by both roads, it is looked at once.
    const auto pair = std::minmax({std::pair(link.road, link.end), std::pair(*target, link.contact)});
    if (seen.insert(pair).second && !CheckJoin(link.map, at(*own, link.end), at(*other, link.contact), warnings))
      continue;
    join(*own, link.end, *other, link.contact);
    join(*other, link.contact, *own, link.end);
  }
  if (links.empty()) return;
  std::vector<network::Road> roads;
  for (std::size_t i = 0; i < specs.size(); ++i)
    roads.emplace_back(std::move(specs[i]), layout.network.roads[i].axis());
  layout.network.roads = std::move(roads);
}

// The lanes that a car could start on instead.
std::string DrivenLanes(const network::RoadSpec& spec) {
  std::string lanes;
  for (const auto* side : {&spec.sections[0].right, &spec.sections[0].left}) {
    for (const network::Lane& lane : *side) {
      if (network::IsDrivable(lane.type))
        lanes += fmt::format("{}{}", lanes.empty() ? "; driven on are " : ", ", lane.id);
    }
  }
  return lanes;
}

std::optional<StartPlace> FindStart(const StartSpec& start_spec, const Map& map, const std::vector<RoadDesign>& designs,
                                    const Layout& layout) {
  std::vector<std::string> ids;
  std::optional<std::size_t> road;
  for (std::size_t i = 0; i < designs.size(); ++i) {
    ids.push_back(designs[i].spec.id);
    if (designs[i].spec.id == start_spec.road || (start_spec.road.empty() && i == 0)) road = i;
  }
  if (!road) {
    map.Problem("road", "world.unknown_road",
                fmt::format("there is no road '{}'{}", start_spec.road, base::DidYouMean(start_spec.road, ids)));
    return std::nullopt;
  }
  const network::RoadSpec& spec = designs[*road].spec;
  int lane = start_spec.lane.value_or(0);
  if (!start_spec.lane) {  // the first drivable one beside the axis, on the side that vehicles keep to
    for (const int id : spec.left_hand ? std::array{1, -1} : std::array{-1, 1}) {
      const network::Lane* found = spec.sections[0].Find(id);
      if (lane == 0 && found != nullptr && network::IsDrivable(found->type)) lane = id;
    }
  }
  const network::Lane* found = spec.sections[0].Find(lane);
  if (found == nullptr || lane == 0) {
    map.Problem("lane", "world.unknown_lane", fmt::format("road '{}' has no lane {}", spec.id, lane));
    return std::nullopt;
  }
  if (!network::IsDrivable(found->type)) {
    map.Problem(start_spec.lane ? "lane" : "",
                fmt::format("lane {} of road '{}' is one of the type '{}': no vehicle drives there{}", lane, spec.id,
                            network::LaneTypeName(found->type), DrivenLanes(spec)));
    return std::nullopt;
  }
  const bool against = found->direction < 0;
  const double s = start_spec.s_m.value_or(against ? spec.length_m - std::min(kFromStart_m, 0.5 * spec.length_m)
                                                   : std::min(kFromStart_m, 0.5 * spec.length_m));
  if (s > spec.length_m) {
    map.Problem("s_m", "config.out_of_range",
                fmt::format("'start.s_m' is {}; the road is {:.3f} m long", s, spec.length_m));
    return std::nullopt;
  }
  const auto at = [&](double station) -> std::optional<StartPlace> {
    for (std::size_t i = 0; i < layout.pieces.size(); ++i) {
      const Piece& piece = layout.pieces[i];
      if (piece.design == *road && station >= piece.from_s_m && station <= piece.to_s_m)
        return StartPlace{static_cast<std::uint32_t>(i), lane, station - piece.from_s_m};
    }
    return std::nullopt;
  };
  if (const auto place = at(s)) return place;
  // In a junction: 10 m behind it, as the lane is driven.
  std::optional<double> behind;
  for (const Piece& piece : layout.pieces) {
    if (piece.design != *road || (against ? piece.from_s_m > s : piece.to_s_m < s)) continue;
    const double into = std::min(kFromStart_m, 0.5 * (piece.to_s_m - piece.from_s_m));
    const double station = against ? piece.to_s_m - into : piece.from_s_m + into;
    if (!behind || (against ? station > *behind : station < *behind)) behind = station;
  }
  if (behind && !start_spec.s_m) return at(*behind);
  map.Problem(map.Has("s_m") ? "s_m" : "", fmt::format("'start.s_m' {} of road '{}' lies in a junction{}", s, spec.id,
                                                       behind ? fmt::format("; {:.1f} is behind it", *behind) : ""));
  return std::nullopt;
}

// Whether a bump can go on in a junction: there it lies on the lanes of its way through, and nothing of it is faded at
// the road's edges beside it.
bool GoesOn(const network::Bump& bump, const RoadDesign& design, const network::Road& way) {
  constexpr double kFades_m = 0.5, kRounding_m = 1e-6;
  const auto within = [&](const network::Road& road, double s_m, double inset_m) {
    double right, left;
    const double s = std::clamp(s_m, 0.0, road.length_m());
    road.SectionAt(s).Bounds(road.spec().lane_offset, s, s, right, left);
    return bump.piece.right_t_m >= right + inset_m - kRounding_m && bump.piece.left_t_m <= left - inset_m + kRounding_m;
  };
  const auto whole = BuildRoad(design);
  return whole && within(way, 0.5 * way.length_m(), 0.0) &&
         within(*whole, 0.5 * (bump.piece.from_s_m + bump.piece.to_s_m), kFades_m);
}

// What is laid on the roads between junctions, and on the ways along them through junctions. A bump that lies elsewhere
// is a problem of its road.
std::vector<network::Laid> DistributeLaid(const std::vector<RoadDesign>& designs, const Layout& layout) {
  std::vector<network::Laid> laid;
  if (std::all_of(designs.begin(), designs.end(), [](const RoadDesign& road) { return road.laid.empty(); }))
    return laid;
  laid.resize(layout.network.roads.size());
  const auto lay = [&](std::size_t road, const Piece& piece) {
    laid[road] = network::CutLaid(designs[piece.design].laid, piece.from_s_m, piece.to_s_m);
  };
  for (std::size_t i = 0; i < layout.pieces.size(); ++i) lay(i, layout.pieces[i]);
  for (const auto& [road, piece] : layout.along) lay(road, piece);
  for (std::size_t i = 0; i < designs.size(); ++i) {
    for (const network::Bump& bump : designs[i].laid.bumps) {
      const auto overlap = [&](const Piece& piece) {
        const double from = std::max(piece.from_s_m, bump.piece.from_s_m),
                     to = std::min(piece.to_s_m, bump.piece.to_s_m);
        return piece.design == i ? std::max(0.0, to - from) : 0.0;
      };
      double length = 0.0;
      bool goes_on = true;
      for (const Piece& piece : layout.pieces) length += overlap(piece);
      for (const auto& [road, piece] : layout.along) {
        if (!(overlap(piece) > 0.0)) continue;
        length += overlap(piece);
        goes_on = goes_on && GoesOn(bump, designs[i], layout.network.roads[road]);
      }
      const bool whole = length > bump.piece.to_s_m - bump.piece.from_s_m - 1e-6;
      if (whole && goes_on) continue;
      designs[i].map.Problem(
          "bumps", "world.road_does_not_fit",
          fmt::format(
              "the bump from s = {:g} to {:g} m reaches into a junction{}", bump.piece.from_s_m, bump.piece.to_s_m,
              whole
                  ? "; there it was expected on lanes that are driven on, half a metre or more within the road's edges"
                  : " at which its road ends"));
    }
  }
  return laid;
}

}  // namespace

Design ReadDesign(const config::File& file, const std::array<double, 7>& friction, const std::string& name,
                  const std::string& geo_reference, const StartSpec& start, const Map& start_map,
                  const TerrainIsAt& terrain_is_at, const terrain::GroundMove& move) {
  Design design;
  const Files files(file);
  Context context;
  context.move = move;
  context.materials = UsualMaterials(friction);
  const Map usual = UsualTemplates();
  for (const std::string& known : usual.Keys()) context.templates.emplace(known, usual);
  context.left_hand = DeclaredMap(file.root(), DesignKeys()).Word("rule") == "left";
  for (const Map& root : files.roots()) {
    const DeclaredMap keys(root, DesignKeys());
    ReadMaterials(keys, context);
    const Map templates = keys.MapWith("templates").OptionalChild("templates");
    for (const std::string& own : templates.Keys()) context.templates.insert_or_assign(own, templates);
  }
  std::vector<RoadDesign> designs;
  std::vector<Link> links;
  for (const Map& root : files.roots()) {
    const DeclaredMap keys(root, DesignKeys());
    const config::DeclaredList roads = keys.Items("roads");
    for (std::size_t i = 0; i < roads.size(); ++i) {
      const DeclaredMap item = roads.At(i);
      ReadLinks(item, designs.size(), links);
      designs.push_back(ReadRoad(item, context, designs));
    }
    root.IgnoreKey("junctions");
    ReadProps(keys, terrain_is_at, move, design.props);
  }
  const auto sound = [&] {
    design.problems = files.Problems();
    return design.problems.empty() && file.Finish().ok();
  };
  design.warnings = context.warnings;
  design.missing = context.missing;
  if (designs.empty() || !sound()) {  // what can be told of the junctions without the roads
    for (const Map& root : files.roots()) (void)ReadJunctions(DeclaredMap(root, DesignKeys()), designs, {});
    design.problems = files.Problems();
  }
  if (designs.empty() || !sound()) return design;

  std::vector<network::Road> roads;
  for (const RoadDesign& road : designs) {
    auto built = BuildRoad(road);
    if (!built) continue;
    CheckBends(road, *built);
    roads.push_back(std::move(*built));
  }
  if (!sound()) return design;
  std::vector<JunctionSpec> junctions;
  for (const Map& root : files.roots()) {
    auto more = ReadJunctions(DeclaredMap(root, DesignKeys()), designs, roads);
    std::move(more.begin(), more.end(), std::back_inserter(junctions));
  }
  if (!sound()) return design;
  FitHeights(junctions, designs, roads, design.warnings);
  for (std::size_t i = 0; i < roads.size(); ++i) roads[i] = *BuildRoad(designs[i]);
  Layout layout = BuildLayout(designs, roads, junctions);
  if (!sound()) return design;
  JoinRoads(links, designs, layout, design.warnings);
  design.laid = DistributeLaid(designs, layout);
  for (const Piece& piece : layout.pieces) design.road_places.push_back(designs[piece.design].map.Place());
  for (const RoadDesign& road : designs) WarnBehindEnd(road.map, road.spec.length_m, design.warnings);
  for (std::size_t i = 0; i < roads.size(); ++i) CheckFits(i, designs[i], roads[i], layout.pieces, terrain_is_at);
  if (start_map.Has("x_m") == false) design.start = FindStart(start, start_map, designs, layout);
  if (!sound()) return design;
  layout.network.name = name;
  layout.network.geo_reference = geo_reference;
  design.junctions = std::move(layout.surfaces);
  design.network = std::make_shared<const network::Network>(std::move(layout.network));
  return design;
}

}  // namespace rodeira::design
