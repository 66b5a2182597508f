// SPDX-License-Identifier: Apache-2.0
#include "common/world/road/world_export.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <functional>
#include <set>
#include <vector>

#include "common/core/base/files.hpp"
#include "common/world/road/export_ids.hpp"
#include "common/world/road/export_lanes.hpp"
#include "common/world/road/export_text.hpp"
#include "common/world/road/measured_files.hpp"
#include "common/world/terrain/geographic.hpp"

namespace rodeira::road {
namespace {

using network::End;

std::string Cubics(const char* element, const geometry::CubicTable& table) {
  std::string text;
  for (const geometry::Cubic& cubic : table.records()) text += CubicText(element, "s", cubic.from, cubic);
  return text;
}

std::string PlanView(const network::Road& road) {
  std::string text = "<planView>\n";
  for (const geometry::PlanElement& element : road.axis().elements()) {
    const double k0 = element.curvature_start_1pm, k1 = element.curvature_end_1pm;
    std::string kind = "<line/>";
    if (element.kind == geometry::PlanElement::Kind::kCubic) {
      // Normalised: p from 0 to 1.
      const double p = element.p_end;
      const auto& u = element.u;
      const auto& v = element.v;
      kind = fmt::format(
          "<paramPoly3 pRange=\"normalized\" aU=\"{}\" bU=\"{}\" cU=\"{}\" dU=\"{}\" aV=\"{}\" bV=\"{}\" cV=\"{}\" "
          "dV=\"{}\"/>",
          u[0], u[1] * p, u[2] * p * p, u[3] * p * p * p, v[0], v[1] * p, v[2] * p * p, v[3] * p * p * p);
    } else if (k0 != k1) {
      kind = fmt::format("<spiral curvStart=\"{}\" curvEnd=\"{}\"/>", k0, k1);
    } else if (k0 != 0.0) {
      kind = fmt::format("<arc curvature=\"{}\"/>", k0);
    }
    text += fmt::format("<geometry s=\"{}\" x=\"{}\" y=\"{}\" hdg=\"{}\" length=\"{}\">{}</geometry>\n", element.s_m,
                        element.start_W.x(), element.start_W.y(), element.heading_rad, element.length_m, kind);
  }
  return text + "</planView>\n";
}

std::string Coefficients(const char* element, const geometry::CubicTable& table) {
  if (table.empty()) return "";
  return fmt::format("<{0}>\n{1}</{0}>\n", element, Cubics("coefficients", table));
}

std::string Strips(const std::vector<network::SurfaceStrip>& strips, int sign) {
  std::string text;
  for (std::size_t i = 0; i < strips.size(); ++i) {
    const network::SurfaceStrip& strip = strips[i];
    text += fmt::format("<strip id=\"{}\" mode=\"{}\">\n", sign * static_cast<int>(i + 1),
                        strip.relative ? "relative" : "independent");
    if (strip.has_width) text += Coefficients("width", strip.width);
    const char* const kNames[] = {"constant", "linear", "quadratic", "cubic"};
    for (std::size_t n = 0; n < 4; ++n) text += Coefficients(kNames[n], strip.coefficients[n]);
    text += "</strip>\n";
  }
  return text;
}

std::string LateralText(const network::RoadSpec& spec) {
  std::string text = "<lateralProfile>\n" + Cubics("superelevation", spec.superelevation);
  for (const network::Shape& shape : spec.lateral.shapes) {
    for (const geometry::Cubic& c : shape.height.records()) {
      text += fmt::format("<shape s=\"{}\" t=\"{}\" a=\"{}\" b=\"{}\" c=\"{}\" d=\"{}\"/>\n", shape.s_m, c.from, c.a,
                          c.b, c.c, c.d);
    }
  }
  const network::CrossSectionSurface& surface = spec.lateral.surface;
  if (!surface.left.empty() || !surface.right.empty()) {
    text += "<crossSectionSurface>\n" + Coefficients("tOffset", surface.t_offset) + "<surfaceStrips>\n";
    text += Strips(surface.left, 1) + Strips(surface.right, -1) + "</surfaceStrips>\n</crossSectionSurface>\n";
  }
  return text + "</lateralProfile>\n";
}

std::string LinkText(const char* name, const std::optional<network::RoadLink>& link) {
  if (!link) return "";
  if (link->junction) return fmt::format("<{} elementType=\"junction\" elementId=\"{}\"/>", name, Escaped(link->id));
  return fmt::format("<{} elementType=\"road\" elementId=\"{}\" contactPoint=\"{}\"/>", name, Escaped(link->id),
                     link->contact == End::kStart ? "start" : "end");
}

std::string Types(const network::RoadSpec& spec) {
  std::string text;
  for (const network::RoadType& type : spec.types) {
    text += fmt::format("<type s=\"{}\" type=\"{}\">", type.s_m, type.type);
    if (type.speed_mps && std::isfinite(*type.speed_mps))
      text += fmt::format("<speed max=\"{}\" unit=\"m/s\"/>", *type.speed_mps);
    text += "</type>\n";
  }
  return text;
}

// The lanes that something is for; nothing: all of them.
std::string ValidityText(const std::vector<network::LaneValidity>& lanes) {
  std::string text;
  for (const network::LaneValidity& lane : lanes)
    text += fmt::format("<validity fromLane=\"{}\" toLane=\"{}\"/>", lane.from_lane, lane.to_lane);
  return text;
}

std::string OutlinesText(const std::vector<network::Outline>& outlines) {
  if (outlines.empty()) return "";
  std::string text = "<outlines>";
  for (std::size_t i = 0; i < outlines.size(); ++i) {
    text += fmt::format("<outline id=\"{}\" closed=\"{}\">", i, outlines[i].closed);
    for (const network::Corner& corner : outlines[i].corners) {
      text += corner.local ? fmt::format("<cornerLocal u=\"{}\" v=\"{}\" z=\"{}\" height=\"{}\"/>", corner.first_m,
                                         corner.second_m, corner.dz_m, corner.height_m)
                           : fmt::format("<cornerRoad s=\"{}\" t=\"{}\" dz=\"{}\" height=\"{}\"/>", corner.first_m,
                                         corner.second_m, corner.dz_m, corner.height_m);
    }
    text += "</outline>";
  }
  return text + "</outlines>";
}

std::string ObjectText(const network::Object& object) {
  std::string text = fmt::format(
      "<object id=\"{}\" name=\"{}\" type=\"{}\" subtype=\"{}\" s=\"{}\" t=\"{}\" zOffset=\"{}\" hdg=\"{}\" "
      "pitch=\"{}\" roll=\"{}\" orientation=\"{}\" dynamic=\"{}\" ",
      Escaped(object.id), Escaped(object.name), object.type, object.subtype, object.s_m, object.t_m, object.z_offset_m,
      object.hdg_rad, object.pitch_rad, object.roll_rad, object.orientation, object.dynamic ? "yes" : "no");
  // What is round has a radius in the place of a length and a width.
  if (object.radius_m > 0.0) text += fmt::format("radius=\"{}\" ", object.radius_m);
  if (object.radius_m == 0.0 || object.length_m != 0.0 || object.width_m != 0.0)
    text += fmt::format("length=\"{}\" width=\"{}\" ", object.length_m, object.width_m);
  if (object.valid_length_m > 0.0) text += fmt::format("validLength=\"{}\" ", object.valid_length_m);
  text += fmt::format("height=\"{}\">", object.height_m);
  for (const network::Repeat& r : object.repeats) {
    text += fmt::format(
        "<repeat s=\"{}\" length=\"{}\" distance=\"{}\" tStart=\"{}\" tEnd=\"{}\" zOffsetStart=\"{}\" "
        "zOffsetEnd=\"{}\" "
        "heightStart=\"{}\" heightEnd=\"{}\" widthStart=\"{}\" widthEnd=\"{}\"/>",
        r.s_m, r.length_m, r.distance_m, r.t_start_m, r.t_end_m, r.z_start_m, r.z_end_m, r.height_start_m,
        r.height_end_m, r.width_start_m, r.width_end_m);
  }
  text += OutlinesText(object.outlines);
  const network::ObjectMaterial& material = object.material;
  if (material.friction)
    text += fmt::format("<material surface=\"{}\" friction=\"{}\"/>", Escaped(material.surface), *material.friction);
  return text + ValidityText(object.validity) + "</object>\n";
}

std::string SignalText(const network::Signal& signal) {
  std::string text = fmt::format(
      "<signal id=\"{}\" name=\"{}\" s=\"{}\" t=\"{}\" zOffset=\"{}\" orientation=\"{}\" dynamic=\"{}\" country=\"{}\" "
      "type=\"{}\" subtype=\"{}\" hOffset=\"{}\" pitch=\"{}\" roll=\"{}\" height=\"{}\" width=\"{}\"",
      Escaped(signal.id), Escaped(signal.name), signal.s_m, signal.t_m, signal.z_offset_m, signal.orientation,
      signal.dynamic ? "yes" : "no", signal.country, signal.type, signal.subtype, signal.h_offset_rad, signal.pitch_rad,
      signal.roll_rad, signal.height_m, signal.width_m);
  if (signal.value) text += fmt::format(" value=\"{}\" unit=\"{}\"", *signal.value, signal.unit);
  if (!signal.text.empty()) text += fmt::format(" text=\"{}\"", Escaped(signal.text));
  text += ">" + ValidityText(signal.validity);
  for (const std::string& id : signal.depends_on) text += fmt::format("<dependency id=\"{}\"/>", Escaped(id));
  return text + "</signal>\n";
}

std::string Furniture(const network::RoadSpec& spec) {
  std::string objects, signals;
  for (const network::Object& object : spec.objects) objects += ObjectText(object);
  for (const network::ObjectReference& other : spec.object_references) {
    objects += fmt::format("<objectReference id=\"{}\" s=\"{}\" t=\"{}\" orientation=\"{}\"/>\n", Escaped(other.id),
                           other.s_m, other.t_m, other.orientation);
  }
  for (const network::Structure& structure : spec.structures) {
    objects += fmt::format("<{} id=\"{}\" name=\"{}\" type=\"{}\" s=\"{}\" length=\"{}\"/>\n",
                           structure.bridge ? "bridge" : "tunnel", Escaped(structure.id), Escaped(structure.name),
                           structure.type, structure.s_m, structure.length_m);
  }
  for (const network::Signal& signal : spec.signals) signals += SignalText(signal);
  for (const network::SignalReference& other : spec.signal_references) {
    signals += fmt::format("<signalReference id=\"{}\" s=\"{}\" t=\"{}\" orientation=\"{}\">{}</signalReference>\n",
                           Escaped(other.id), other.s_m, other.t_m, other.orientation, ValidityText(other.validity));
  }
  std::string text;
  if (!objects.empty()) text += "<objects>\n" + objects + "</objects>\n";
  if (!signals.empty()) text += "<signals>\n" + signals + "</signals>\n";
  return text;
}

// What a file of a measured surface is called in the exported one.
using NameOf = std::function<std::string(const std::string& file)>;

// In a junction a surface may go on beyond its way's ends; OpenDRIVE has no s there, so how far stands in the data of
// users.
std::string MeasuredText(const network::CrgSurface& crg, double length_m, const NameOf& name_of) {
  const bool along = crg.mode != "genuine";  // that one's place is sStart + sOffset
  const double before_m = along ? std::max(0.0, -crg.s_start_m) : 0.0, behind_m = std::max(0.0, crg.s_end_m - length_m);
  std::string text = fmt::format(
      "<CRG file=\"{}\" sStart=\"{}\" sEnd=\"{}\" orientation=\"{}\" mode=\"{}\" purpose=\"{}\" sOffset=\"{}\" "
      "tOffset=\"{}\"",
      Escaped(name_of(crg.file)), crg.s_start_m + before_m, crg.s_end_m - behind_m, crg.orientation, crg.mode,
      crg.purpose, crg.s_offset_m + before_m, crg.t_offset_m);
  if (along)
    text += fmt::format(" zOffset=\"{}\" zScale=\"{}\"", crg.z_offset_m, crg.z_scale);
  else
    text += fmt::format(" zOffset=\"{}\" zScale=\"{}\" hOffset=\"{}\"", crg.z_offset_m, crg.z_scale, crg.h_offset_rad);
  if (before_m == 0.0 && behind_m == 0.0) return text + "/>\n";
  return text + fmt::format("><userData code=\"rodeira:goes_on\" value=\"{} {}\"/></CRG>\n", before_m, behind_m);
}

// OpenDRIVE has no element for generated roughness.
std::string Surface(const network::RoadSpec& spec, double length_m, const NameOf& name_of) {
  if (spec.crg.empty() && spec.unevenness.empty()) return "";
  std::string text = "<surface>\n";
  for (const network::CrgSurface& crg : spec.crg) text += MeasuredText(crg, length_m, name_of);
  for (const network::Unevenness& made : spec.unevenness) {
    text += fmt::format("<userData code=\"rodeira:iso_8608\" value=\"{} {} {} {} {}\"/>\n", made.s_start_m,
                        made.s_end_m, made.s_offset_m, made.density_m3, made.seed);
  }
  return text + "</surface>\n";
}

std::string RoadText(const network::Road& road, const NameOf& name_of) {
  const network::RoadSpec& spec = road.spec();
  std::string text = fmt::format("<road name=\"{}\" id=\"{}\" length=\"{}\" junction=\"{}\" rule=\"{}\">\n",
                                 Escaped(spec.name), Escaped(spec.id), road.length_m(),
                                 spec.junction.empty() ? "-1" : Escaped(spec.junction), spec.left_hand ? "LHT" : "RHT");
  text += fmt::format("<link>{}{}</link>\n", LinkText("predecessor", spec.predecessor),
                      LinkText("successor", spec.successor));
  text += Types(spec) + PlanView(road) + "<elevationProfile>\n" + Cubics("elevation", spec.elevation) +
          "</elevationProfile>\n";
  return text + LateralText(spec) + LanesText(road) + Furniture(spec) + Surface(spec, road.length_m(), name_of) +
         "</road>\n";
}

std::string JunctionText(const network::Junction& junction) {
  std::string text =
      fmt::format("<junction id=\"{}\" name=\"{}\" type=\"default\">\n", Escaped(junction.id), Escaped(junction.name));
  for (const network::JunctionConnection& connection : junction.connections) {
    text += fmt::format("<connection id=\"{}\" incomingRoad=\"{}\" connectingRoad=\"{}\" contactPoint=\"{}\">",
                        connection.id, Escaped(connection.incoming_road), Escaped(connection.connecting_road),
                        connection.contact == End::kStart ? "start" : "end");
    for (const network::JunctionLaneLink& link : connection.lane_links)
      text += fmt::format("<laneLink from=\"{}\" to=\"{}\"/>", link.from, link.to);
    text += "</connection>\n";
  }
  for (const network::JunctionPriority& priority : junction.priorities) {
    text += fmt::format("<priority high=\"{}\" low=\"{}\"/>\n", Escaped(priority.high), Escaped(priority.low));
  }
  for (std::size_t i = 0; i < junction.controllers.size(); ++i)
    text += fmt::format("<controller id=\"{}\" sequence=\"{}\"/>\n", Escaped(junction.controllers[i]), i);
  return text + "</junction>\n";
}

// OpenDRIVE has no times of lights: they stand in the data of users.
std::string ControllerText(const network::Controller& controller) {
  std::string text =
      fmt::format("<controller id=\"{}\" name=\"{}\">\n", Escaped(controller.id), Escaped(controller.name));
  for (const network::ControllerEntry& entry : controller.controls)
    text += fmt::format("<control signalId=\"{}\" type=\"{}\"/>\n", Escaped(entry.signal_id), Escaped(entry.type));
  if (controller.times) {
    const network::LightTimes& t = *controller.times;
    text += fmt::format("<userData code=\"rodeira:times\" value=\"{} {} {} {} {}", t.cycle_s, t.green_from_s, t.green_s,
                        t.amber_s, t.red_amber_s);
    for (const network::LightGreen& green : t.more)
      text += fmt::format(" {} {} {} {}", green.from_s, green.green_s, green.amber_s, green.red_amber_s);
    text += "\"/>\n";
  }
  return text + "</controller>\n";
}

base::Result<std::string> Export(const World& world, const NameOf& name_of) {
  if (world.open_drive()) return base::WrongInput("world.cannot_export", "this world is an OpenDRIVE file already");
  if (world.network() == nullptr || world.network()->roads().empty())
    return base::WrongInput("world.cannot_export", "this world has no road; OpenDRIVE needs one");
  const network::Network& network = *world.network();
  // Sections of strips came with OpenDRIVE 1.8.
  const bool strips = std::any_of(network.roads().begin(), network.roads().end(), [](const network::Road& road) {
    return !road.spec().lateral.surface.left.empty() || !road.spec().lateral.surface.right.empty();
  });
  std::string text = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<OpenDRIVE>\n";
  text += fmt::format("<header revMajor=\"1\" revMinor=\"{}\" name=\"{}\" version=\"1.00\" vendor=\"Rodeira\">\n",
                      strips ? 8 : 7, Escaped(world.name()));
  // What other programs read; WKT where PROJ has no string for it.
  if (!network.geo_reference().empty()) {
    const auto string = terrain::ProjString(network.geo_reference());
    if (!string) return string.error();
    text += fmt::format("<geoReference>{}</geoReference>\n", Escaped(string.value().value_or(network.geo_reference())));
  }
  text += "</header>\n";
  const ExportParts parts = WithPlainIds(network);
  for (const network::Road& road : parts.roads) text += RoadText(road, name_of);
  for (const network::Controller& controller : parts.controllers) text += ControllerText(controller);
  for (const network::Junction& junction : parts.junctions) text += JunctionText(junction);
  return text + "</OpenDRIVE>\n";
}

}  // namespace

std::string Escaped(std::string_view text) {
  std::string escaped;
  for (const char c : text) {
    if (c == '&')
      escaped += "&amp;";
    else if (c == '<')
      escaped += "&lt;";
    else if (c == '>')
      escaped += "&gt;";
    else if (c == '"')
      escaped += "&quot;";
    else
      escaped += c;
  }
  return escaped;
}

std::string CubicText(const char* element, const char* from_name, double from, const geometry::Cubic& cubic) {
  return fmt::format("<{} {}=\"{}\" a=\"{}\" b=\"{}\" c=\"{}\" d=\"{}\"/>\n", element, from_name, from, cubic.a,
                     cubic.b, cubic.c, cubic.d);
}

base::Result<std::string> ExportOpenDrive(const World& world) {
  return Export(world, [](const std::string& file) { return std::filesystem::absolute(file).string(); });
}

base::Status WriteOpenDrive(const World& world, const std::filesystem::path& file) {
  MeasuredFiles measured(file);
  const auto text = Export(world, [&measured](const std::string& path) { return measured.NameOf(path); });
  if (!text) return text.error();
  if (auto written = measured.Write(); !written) return written;
  return base::WriteWhole(file, text.value());
}

}  // namespace rodeira::road
