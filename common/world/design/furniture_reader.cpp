// SPDX-License-Identifier: Apache-2.0
#include "common/world/design/furniture_reader.hpp"

#include <filesystem>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "common/core/base/nearest_file.hpp"
#include "common/core/base/suggest.hpp"
#include "common/core/geometry/angle.hpp"
#include "common/world/design/beside.hpp"
#include "common/world/design/object_reader.hpp"
#include "common/world/design/station.hpp"
#include "common/world/design/tables.hpp"

namespace rodeira::design {
namespace {

using config::DeclaredList;
using config::DeclaredMap;
using config::Map;

constexpr double kNearest_m = 0.1;  // of what is repeated

// Where something stands: once, or from a station to another every so often.
struct Stand {
  double s_m, from_s_m, every_m, to_s_m;
  bool repeated;
};

Stand ReadStand(const DeclaredMap& keys, double length_m) {
  const Map& item = keys.map();
  Stand stand{0.0, 0.0, 0.0, 0.0, item.Has("every_m")};
  if (!stand.repeated) {
    stand.s_m = Station(keys, "s_m", length_m);
    return stand;
  }
  if (item.Has("s_m"))
    item.Problem("s_m", "config.conflicting_keys",
                 "what is repeated has 'from_s_m', 'every_m' and 'to_s_m' instead of 's_m'");
  stand.every_m = keys.RequiredNumber("every_m");
  stand.from_s_m = stand.s_m = Station(keys, "from_s_m", length_m, 0.0);
  stand.to_s_m = Station(keys, "to_s_m", length_m, length_m);
  if (stand.to_s_m < stand.from_s_m)
    item.Problem("to_s_m", "config.wrong_order", "'to_s_m' must not lie before 'from_s_m'");
  return stand;
}

constexpr double kAstray_m = 0.05;  // how far from its place a row or a rail may pass
constexpr double kLook_m = 1.0;
constexpr double kOverhead_m = 4.0;  // what hangs so high is driven under

// The stations where something stands.
std::vector<double> StationsOf(const Stand& stand) {
  if (!stand.repeated) return {stand.s_m};
  std::vector<double> stations;
  const double count = std::floor((stand.to_s_m - stand.from_s_m) / stand.every_m + 1e-9);
  for (double i = 0.0; i <= std::min(count, kMaxInRow); i += 1.0)
    stations.push_back(stand.from_s_m + i * stand.every_m);
  return stations;
}

// What stands where one drives is told, once for each item of the file.
void WarnOnLanes(const Map& item, const std::string& what, const network::RoadSpec& spec,
                 const std::vector<double>& stations, const Beside& beside, double reach_m,
                 std::vector<std::string>& warnings) {
  for (const double s : stations) {
    const double t = beside.At(s);
    const network::Lane* lane = DrivenLaneAt(spec, s, t, reach_m);
    if (lane == nullptr) continue;
    warnings.push_back(
        fmt::format("{}: {} of road '{}' at s = {:.1f} m, t = {:.2f} m stands on lane {}, which is driven on",
                    item.Place(), what, spec.id, s, t, lane->id));
    return;
  }
}

double ReadRotation(const DeclaredMap& item) { return item.Number("rotation_deg") * geometry::kPi / 180.0; }

void ReadSign(const DeclaredMap& keys, const Context& context, double length_m, network::RoadSpec& spec,
              std::vector<std::string>& warnings) {
  const Map& item = keys.map();
  std::vector<std::string> names;
  for (const SignKind& kind : SignKinds()) names.emplace_back(kind.name);
  const std::string name = keys.MapWith("type").Text("type");
  const SignKind* kind = FindSign(name);
  if (kind == nullptr) {
    if (item.Has("type"))
      item.Problem("type", "config.unknown_name",
                   fmt::format("there is no sign '{}'{}", name, base::DidYouMean(name, names)));
    kind = &SignKinds().front();
  }
  std::optional<double> value;
  if (kind->with_value || item.Has("value")) value = keys.RequiredNumber("value");
  if (!kind->with_value && value)
    item.Problem("value", "config.conflicting_keys", fmt::format("the sign '{}' shows no value", name));
  const Stand stand = ReadStand(keys, length_m);
  const std::string facing = keys.Word("for");
  const bool right_side = (facing != "against") != context.left_hand;
  const double rotation = ReadRotation(keys), height = keys.Number("z_m");
  const double size = keys.Number("height_m", kind->height_m);
  const std::string text = keys.Text("text");
  if (text.empty() && (name == "town" || name == "end_of_town"))
    warnings.push_back(
        fmt::format("{}: the sign '{}' names no town: its 'text' is what stands on it", item.Place("type"), name));
  if (stand.repeated && stand.every_m >= kNearest_m && (stand.to_s_m - stand.from_s_m) / stand.every_m > kMaxInRow)
    return item.Problem("every_m", "config.out_of_range", "more than 100 000 signs; fewer were expected");
  const Beside beside(keys, spec, -0.3, right_side);
  const std::vector<double> stations = StationsOf(stand);
  if (height < kOverhead_m)
    WarnOnLanes(item, fmt::format("the sign '{}'", name), spec, stations, beside, 0.0, warnings);
  for (const double s : stations) {
    network::Signal signal = MakeSign(*kind, value);
    signal.id = fmt::format("{}-sign{}", spec.id, spec.signals.size());
    signal.s_m = s;
    signal.t_m = beside.At(s);
    signal.z_offset_m = height;
    signal.orientation = facing == "along" ? "+" : facing == "against" ? "-" : "none";
    signal.h_offset_rad = rotation;
    signal.width_m *= size / kind->height_m;
    signal.height_m = size;
    signal.text = text;
    spec.signals.push_back(std::move(signal));
  }
}

// A row or a rail beside an edge that need not be straight: one repeat for each piece that is.
std::vector<network::Repeat> RepeatsOf(const Stand& stand, bool continuous, const Beside& beside,
                                       const network::Object& object) {
  std::vector<double> stations;
  if (continuous) {
    const int steps = std::max(1, static_cast<int>(std::ceil((stand.to_s_m - stand.from_s_m) / kLook_m)));
    for (int i = 0; i <= steps; ++i)
      stations.push_back(i == steps ? stand.to_s_m : stand.from_s_m + (stand.to_s_m - stand.from_s_m) * i / steps);
    for (const double s : beside.Knots()) {
      if (s > stand.from_s_m && s < stand.to_s_m) stations.push_back(s);
    }
    std::sort(stations.begin(), stations.end());
    stations.erase(std::unique(stations.begin(), stations.end()), stations.end());
  } else {
    stations = StationsOf(stand);
    if (stations.size() > 1 || stand.to_s_m > stand.from_s_m)
      stations.push_back(
          std::max(stand.to_s_m, stations.back()));  // the row says where it ends, whether one stands there or not
  }
  std::vector<double> across;
  for (const double s : stations) across.push_back(beside.At(s));
  std::vector<network::Repeat> repeats;
  for (const auto& [from, to] : StraightPieces(stations, across, kAstray_m, continuous)) {
    if (!continuous && from == to && from + 1 == stations.size() && from > 0) continue;  // only the end that was said
    network::Repeat repeat;
    repeat.s_m = stations[from], repeat.length_m = stations[to] - stations[from], repeat.distance_m = stand.every_m;
    repeat.t_start_m = across[from], repeat.t_end_m = across[to];
    repeat.z_start_m = repeat.z_end_m = object.z_offset_m;
    repeat.height_start_m = repeat.height_end_m = object.height_m;
    repeat.width_start_m = repeat.width_end_m = object.width_m;
    repeats.push_back(repeat);
  }
  return repeats;
}

void ReadObject(const DeclaredMap& keys, double length_m, network::RoadSpec& spec, std::vector<std::string>& warnings) {
  const Map& item = keys.map();
  auto [object, continuous] = ReadObjectItself(keys, fmt::format("{}-object{}", spec.id, spec.objects.size()));
  object.hdg_rad = ReadRotation(keys);
  Stand stand{};
  bool sound = true;
  if (continuous) {
    stand.from_s_m = stand.s_m = Station(keys, "from_s_m", length_m, 0.0);
    stand.to_s_m = Station(keys, "to_s_m", length_m, length_m);
    sound = stand.to_s_m > stand.from_s_m;
    if (!sound) item.Problem("to_s_m", "config.wrong_order", "'to_s_m' must lie behind 'from_s_m'");
    stand.repeated = true;
  } else {
    stand = ReadStand(keys, length_m);
    sound = !stand.repeated || (stand.to_s_m >= stand.from_s_m && stand.every_m > 0.0);
    if (sound && stand.repeated && stand.every_m >= kNearest_m &&
        (stand.to_s_m - stand.from_s_m) / stand.every_m > kMaxInRow)
      return item.Problem("every_m", "config.out_of_range", "more than 100 000 objects; fewer were expected");
  }
  const Beside beside(keys, spec, continuous ? -0.5 : 4.0, true);
  object.s_m = stand.s_m;
  object.t_m = beside.At(stand.s_m);
  if (sound && stand.repeated) object.repeats = RepeatsOf(stand, continuous, beside, object);
  // Posts stand on lanes on purpose, as the gates of a test do.
  if (sound && object.subtype != "post" && object.z_offset_m < kOverhead_m) {
    const bool building = object.type == "building";
    std::vector<double> stations;
    if (continuous) {
      for (double s = stand.from_s_m; s <= stand.to_s_m; s += kLook_m) stations.push_back(s);
    } else {
      stations = StationsOf(stand);
    }
    WarnOnLanes(item, fmt::format("the {}", object.subtype), spec, stations, beside,
                building ? 0.5 * std::min(object.length_m, object.width_m) : 0.0, warnings);
  }
  spec.objects.push_back(std::move(object));
}

void ReadStructures(const DeclaredMap& road, const char* key, bool bridge, double length_m, network::RoadSpec& spec) {
  const DeclaredList list = road.Items(key);
  for (std::size_t i = 0; i < list.size(); ++i) {
    const DeclaredMap keys = list.At(i);
    const Map& item = keys.map();
    network::Structure structure;
    structure.bridge = bridge;
    structure.id = fmt::format("{}-{}{}", spec.id, bridge ? "bridge" : "tunnel", i);
    structure.name = keys.Text("name");
    structure.type = bridge ? "concrete" : "standard";
    structure.s_m = Station(keys, "from_s_m", length_m);
    structure.length_m = Station(keys, "to_s_m", length_m) - structure.s_m;
    if (!(structure.length_m > 0.0))
      item.Problem("to_s_m", "config.wrong_order", "'to_s_m' must lie behind 'from_s_m'");
    for (const network::Structure& other : spec.structures) {
      const double from = std::max(structure.s_m, other.s_m),
                   to = std::min(structure.s_m + structure.length_m, other.s_m + other.length_m);
      if (other.bridge != bridge && from < to)
        item.Problem(
            "from_s_m", "config.duplicate_name",
            fmt::format("from s = {} to {} m there is a {} already", from, to, other.bridge ? "bridge" : "tunnel"));
    }
    spec.structures.push_back(std::move(structure));
  }
}

void ReadSurfaces(const DeclaredMap& road, double length_m, network::RoadSpec& spec) {
  const DeclaredList list = road.Items("surfaces");
  for (std::size_t i = 0; i < list.size(); ++i) {
    const DeclaredMap keys = list.At(i);
    const Map& item = keys.map();
    const double from = Station(keys, "from_s_m", length_m, 0.0), to = Station(keys, "to_s_m", length_m, length_m);
    if (!(to > from)) item.Problem("to_s_m", "config.wrong_order", "'to_s_m' must lie behind 'from_s_m'");
    if (item.Has("crg") == item.Has("iso_8608")) {
      item.Problem(item.Has("crg") ? "crg" : "", "config.conflicting_keys",
                   "a surface is either measured ('crg': a file) or made ('iso_8608': a class from A to H)");
    }
    if (item.Has("crg")) {
      network::CrgSurface crg;
      const std::filesystem::path file = keys.MapWith("crg").Path("crg");
      if (!file.empty())
        crg.file = std::filesystem::absolute(file).string();  // not to be looked for from the world's folder once more
      if (const std::string missing = base::NoSuchFile(file); !file.empty() && !missing.empty())
        item.Problem("crg", fmt::format("'{}': {}", file.filename().string(), missing));
      crg.orientation = keys.Word("orientation");
      crg.mode = "attached";
      crg.purpose = "elevation";
      crg.s_start_m = from, crg.s_end_m = to;
      crg.s_offset_m = keys.Number("s_offset_m");
      crg.t_offset_m = keys.Number("t_offset_m");
      crg.z_offset_m = keys.Number("z_offset_m");
      crg.z_scale = keys.Number("z_scale");
      spec.crg.push_back(std::move(crg));
    } else if (item.Has("iso_8608")) {
      const std::string letter = keys.Word("iso_8608", "A");
      network::Unevenness uneven;
      uneven.s_start_m = from, uneven.s_end_m = to;
      uneven.density_m3 = 16e-6 * std::pow(4.0, letter.empty() ? 0 : letter[0] - 'A');
      uneven.seed = static_cast<std::uint64_t>(
          keys.MapWith("seed").Integer("seed", 0, std::numeric_limits<std::int64_t>::max(), 0));
      spec.unevenness.push_back(uneven);
    }
  }
}

}  // namespace

const std::vector<SignKind>& SignKinds() {
  static const std::vector<SignKind> kinds = {
      {"stop", "206", "-1", 0.9, 0.9, false},
      {"give_way", "205", "-1", 0.78, 0.9, false},
      {"priority_road", "306", "-1", 0.6, 0.6, false},
      {"end_of_priority_road", "307", "-1", 0.6, 0.6, false},
      {"priority", "301", "-1", 0.78, 0.9, false},
      {"priority_to_the_right", "102", "-1", 0.78, 0.9, false},
      {"danger", "101", "-1", 0.78, 0.9, false},
      {"bend_left", "103", "10", 0.78, 0.9, false},
      {"bend_right", "103", "20", 0.78, 0.9, false},
      {"bends_left_first", "105", "10", 0.78, 0.9, false},
      {"bends_right_first", "105", "20", 0.78, 0.9, false},
      {"downhill", "108", "-1", 0.78, 0.9, true},
      {"uphill", "110", "-1", 0.78, 0.9, true},
      {"uneven_road", "112", "-1", 0.78, 0.9, false},
      {"slippery_road", "114", "-1", 0.78, 0.9, false},
      {"roundabout", "215", "-1", 0.6, 0.6, false},
      {"no_entry", "267", "-1", 0.6, 0.6, false},
      {"speed_limit", "274", "-1", 0.6, 0.6, true},
      {"end_of_speed_limit", "278", "-1", 0.6, 0.6, true},
      {"no_overtaking", "276", "-1", 0.6, 0.6, false},
      {"end_of_no_overtaking", "280", "-1", 0.6, 0.6, false},
      {"end_of_restrictions", "282", "-1", 0.6, 0.6, false},
      {"town", "310", "-1", 0.65, 1.0, false},
      {"end_of_town", "311", "-1", 0.65, 1.0, false},
      {"motorway", "330", "-1", 0.9, 0.9, false},
      {"end_of_motorway", "334", "-1", 0.9, 0.9, false},
      {"crossing", "350", "-1", 0.6, 0.6, false},
      {"chevron", "625", "-1", 0.5, 0.5, false},
  };
  return kinds;
}

const SignKind* FindSign(std::string_view name) {
  for (const SignKind& kind : SignKinds()) {
    if (name == kind.name) return &kind;
  }
  return nullptr;
}

network::Signal MakeSign(const SignKind& kind, std::optional<double> value) {
  network::Signal signal;
  signal.name = kind.name;
  signal.country = "DE";
  signal.type = kind.type;
  signal.subtype = kind.subtype;
  signal.height_m = kind.height_m;
  signal.width_m = kind.width_m;
  signal.value = value;
  if (value) signal.unit = signal.type == "274" || signal.type == "278" ? "km/h" : "%";
  return signal;
}

void ReadFurniture(const DeclaredMap& road, const Context& context, double length_m, network::RoadSpec& spec,
                   std::vector<std::string>& warnings) {
  const DeclaredList signs = road.Items("signs");
  for (std::size_t i = 0; i < signs.size(); ++i) ReadSign(signs.At(i), context, length_m, spec, warnings);
  const DeclaredList objects = road.Items("objects");
  for (std::size_t i = 0; i < objects.size(); ++i) ReadObject(objects.At(i), length_m, spec, warnings);
  ReadStructures(road, "bridges", true, length_m, spec);
  ReadStructures(road, "tunnels", false, length_m, spec);
  ReadSurfaces(road, length_m, spec);
}

}  // namespace rodeira::design
