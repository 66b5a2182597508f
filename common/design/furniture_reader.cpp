#include "common/design/furniture_reader.hpp"

#include <filesystem>
#include <fmt/format.h>

#include <cmath>

#include "common/base/nearest_file.hpp"
#include "common/base/suggest.hpp"
#include "common/design/object_reader.hpp"
#include "common/design/section_reader.hpp"
#include "common/design/tables.hpp"
#include "common/geometry/angle.hpp"

namespace rodeira::design {
namespace {

using config::List;
using config::Map;

// Where something stands: once, or from a station to another every so often.
struct Stand {
  double s_m, from_s_m, every_m, to_s_m;
  bool repeated;
};

Stand ReadStand(const Map& item, double length_m) {
  Stand stand{0.0, 0.0, 0.0, 0.0, item.Has("every_m")};
  if (!stand.repeated) {
    stand.s_m = item.Number("s_m", {0.0, length_m});
    return stand;
  }
  if (item.Has("s_m")) item.Problem("s_m", "what is repeated has 'from_s_m', 'every_m' and 'to_s_m' instead of 's_m'");
  stand.every_m = item.Number("every_m", {0.1, 1e6});
  stand.from_s_m = stand.s_m = item.Number("from_s_m", {0.0, length_m}, 0.0);
  stand.to_s_m = item.Number("to_s_m", {0.0, length_m}, length_m);
  if (stand.to_s_m < stand.from_s_m) item.Problem("to_s_m", "'to_s_m' must not lie before 'from_s_m'");
  return stand;
}

// t of a place: as it is, or beyond the outermost lane's edge on a side.
double ReadAcross(const Map& item, const network::RoadSpec& spec, double s_m, double usual_m, bool right_side) {
  if (item.Has("t_m")) return item.Number("t_m", {-1000.0, 1000.0});
  const bool right = item.Choice("side", {"left", "right"}, right_side ? "right" : "left") == "right";
  const double beside = item.Number("beside_m", {-100.0, 1000.0}, usual_m);
  const auto& section = spec.sections[0];
  const int lane = right ? -static_cast<int>(section.right.size()) : static_cast<int>(section.left.size());
  return EdgeOf(spec, lane).Value(s_m) + (right ? -beside : beside);
}

double ReadRotation(const Map& item) { return item.Number("rotation_deg", {-360.0, 360.0}, 0.0) * geometry::kPi / 180.0; }

void ReadSign(const Map& item, const Context& context, double length_m, network::RoadSpec& spec) {
  std::vector<std::string> names;
  for (const SignKind& kind : SignKinds()) names.emplace_back(kind.name);
  const std::string name = item.Text("type");
  const SignKind* kind = FindSign(name);
  if (kind == nullptr) {
    if (item.Has("type")) item.Problem("type", fmt::format("there is no sign '{}'{}", name, base::DidYouMean(name, names)));
    kind = &SignKinds().front();
  }
  std::optional<double> value;
  if (kind->with_value || item.Has("value")) value = item.Number("value", {0.0, 1000.0});
  if (!kind->with_value && value) item.Problem("value", fmt::format("the sign '{}' shows no value", name));
  const Stand stand = ReadStand(item, length_m);
  const std::string facing = item.Choice("for", {"along", "against", "both"}, "along");
  const bool right_side = (facing != "against") != context.left_hand;
  const double rotation = ReadRotation(item), height = item.Number("z_m", {-50.0, 50.0}, 2.0);
  const double size = item.Number("height_m", {0.1, 10.0}, kind->height_m);
  const std::string text = item.Text("text", "");
  const double count = stand.repeated ? std::floor((stand.to_s_m - stand.from_s_m) / stand.every_m + 1e-9) : 0.0;
  if (count > 1e5) return item.Problem("every_m", "more than 100 000 signs; fewer were expected");
  for (double i = 0.0; i <= count; i += 1.0) {
    network::Signal signal = MakeSign(*kind, value);
    signal.id = fmt::format("{}-sign{}", spec.id, spec.signals.size());
    signal.s_m = stand.s_m + i * stand.every_m;
    signal.t_m = ReadAcross(item, spec, signal.s_m, -0.3, right_side);
    signal.z_offset_m = height;
    signal.orientation = facing == "along" ? "+" : facing == "against" ? "-" : "none";
    signal.h_offset_rad = rotation;
    signal.width_m *= size / kind->height_m;
    signal.height_m = size;
    signal.text = text;
    spec.signals.push_back(std::move(signal));
  }
}

void ReadObject(const Map& item, double length_m, network::RoadSpec& spec) {
  auto [object, continuous] = ReadObjectItself(item, fmt::format("{}-object{}", spec.id, spec.objects.size()));
  object.hdg_rad = ReadRotation(item);
  Stand stand{};
  if (continuous) {
    stand.from_s_m = stand.s_m = item.Number("from_s_m", {0.0, length_m}, 0.0);
    stand.to_s_m = item.Number("to_s_m", {0.0, length_m}, length_m);
    if (!(stand.to_s_m > stand.from_s_m)) item.Problem("to_s_m", "'to_s_m' must lie behind 'from_s_m'");
    stand.repeated = true;
  } else {
    stand = ReadStand(item, length_m);
  }
  object.s_m = stand.s_m;
  object.t_m = ReadAcross(item, spec, stand.s_m, continuous ? -0.5 : 4.0, true);
  if (stand.repeated) {
    network::Repeat repeat;
    repeat.s_m = stand.from_s_m, repeat.length_m = stand.to_s_m - stand.from_s_m, repeat.distance_m = stand.every_m;
    repeat.t_start_m = object.t_m, repeat.t_end_m = ReadAcross(item, spec, stand.to_s_m, continuous ? -0.5 : 4.0, true);
    repeat.z_start_m = repeat.z_end_m = object.z_offset_m;
    repeat.height_start_m = repeat.height_end_m = object.height_m;
    repeat.width_start_m = repeat.width_end_m = object.width_m;
    object.repeats.push_back(repeat);
  }
  spec.objects.push_back(std::move(object));
}

void ReadStructures(const Map& road, const char* key, bool bridge, double length_m, network::RoadSpec& spec) {
  const List list = road.OptionalItems(key);
  for (std::size_t i = 0; i < list.size(); ++i) {
    const Map item = list.At(i);
    network::Structure structure;
    structure.bridge = bridge;
    structure.id = fmt::format("{}-{}{}", spec.id, bridge ? "bridge" : "tunnel", i);
    structure.name = item.Text("name", "");
    structure.type = bridge ? "concrete" : "standard";
    structure.s_m = item.Number("from_s_m", {0.0, length_m});
    structure.length_m = item.Number("to_s_m", {0.0, length_m}) - structure.s_m;
    if (!(structure.length_m > 0.0)) item.Problem("to_s_m", "'to_s_m' must lie behind 'from_s_m'");
    spec.structures.push_back(std::move(structure));
  }
}

void ReadSurfaces(const Map& road, double length_m, network::RoadSpec& spec) {
  const List list = road.OptionalItems("surfaces");
  for (std::size_t i = 0; i < list.size(); ++i) {
    const Map item = list.At(i);
    const double from = item.Number("from_s_m", {0.0, length_m}, 0.0), to = item.Number("to_s_m", {0.0, length_m}, length_m);
    if (!(to > from)) item.Problem("to_s_m", "'to_s_m' must lie behind 'from_s_m'");
    if (item.Has("crg") == item.Has("iso_8608")) {
      item.Problem(item.Has("crg") ? "crg" : "", "a surface is either measured ('crg': a file) or made ('iso_8608': a class from A to H)");
    }
    if (item.Has("crg")) {
      network::CrgSurface crg;
      const std::filesystem::path file = item.Path("crg");
      if (!file.empty()) crg.file = std::filesystem::absolute(file).string();  // not to be looked for from the world's folder once more
      if (const std::string missing = base::NoSuchFile(file); !file.empty() && !missing.empty()) item.Problem("crg", fmt::format("'{}': {}", file.filename().string(), missing));
      crg.orientation = item.Choice("orientation", {"same", "opposite"}, "same");
      crg.mode = "attached";
      crg.purpose = "elevation";
      crg.s_start_m = from, crg.s_end_m = to;
      crg.s_offset_m = item.Number("s_offset_m", {-1e6, 1e6}, 0.0);
      crg.t_offset_m = item.Number("t_offset_m", {-100.0, 100.0}, 0.0);
      crg.z_offset_m = item.Number("z_offset_m", {-10.0, 10.0}, 0.0);
      crg.z_scale = item.Number("z_scale", {-100.0, 100.0}, 1.0);
      spec.crg.push_back(std::move(crg));
    } else if (item.Has("iso_8608")) {
      const std::string letter = item.Choice("iso_8608", {"A", "B", "C", "D", "E", "F", "G", "H"});
      network::Unevenness uneven;
      uneven.s_start_m = from, uneven.s_end_m = to;
      uneven.density_m3 = 16e-6 * std::pow(4.0, letter.empty() ? 0 : letter[0] - 'A');
      uneven.seed = static_cast<std::uint64_t>(item.Integer("seed", 0, std::numeric_limits<std::int64_t>::max(), 0));
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

void ReadFurniture(const Map& road, const Context& context, double length_m, network::RoadSpec& spec) {
  const List signs = road.OptionalItems("signs");
  for (std::size_t i = 0; i < signs.size(); ++i) ReadSign(signs.At(i), context, length_m, spec);
  const List objects = road.OptionalItems("objects");
  for (std::size_t i = 0; i < objects.size(); ++i) ReadObject(objects.At(i), length_m, spec);
  ReadStructures(road, "bridges", true, length_m, spec);
  ReadStructures(road, "tunnels", false, length_m, spec);
  ReadSurfaces(road, length_m, spec);
}

}  // namespace rodeira::design
