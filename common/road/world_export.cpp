#include "common/road/world_export.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <vector>

namespace rodeira::road {
namespace {

std::string Escaped(std::string_view text) {
  std::string escaped;
  for (const char c : text) {
    if (c == '&') escaped += "&amp;";
    else if (c == '<') escaped += "&lt;";
    else if (c == '>') escaped += "&gt;";
    else if (c == '"') escaped += "&quot;";
    else escaped += c;
  }
  return escaped;
}

std::string Cubic(const char* element, const char* from, double at, double a, double b, double c) {
  return fmt::format("<{} {}=\"{}\" a=\"{}\" b=\"{}\" c=\"{}\" d=\"0\"/>\n", element, from, at, a, b, c);
}

std::string PlanView(const Road& road) {
  std::string text = "<planView>\n";
  double s = 0.0;
  for (const geometry::PlanPiece& piece : road.plan().pieces()) {
    const geometry::PlanPoint at = road.plan().Evaluate(s);
    const double k0 = piece.curvature_start_1pm, k1 = piece.curvature_end_1pm;
    const std::string kind = k0 != k1    ? fmt::format("<spiral curvStart=\"{}\" curvEnd=\"{}\"/>", k0, k1)
                             : k0 != 0.0 ? fmt::format("<arc curvature=\"{}\"/>", k0)
                                         : "<line/>";
    text += fmt::format("<geometry s=\"{}\" x=\"{}\" y=\"{}\" hdg=\"{}\" length=\"{}\">{}</geometry>\n", s, at.p_W.x(),
                        at.p_W.y(), at.heading_rad, piece.length_m, kind);
    s += piece.length_m;
  }
  return text + "</planView>\n";
}

// Grades and parabolas are cubics without a cubic term.
std::string Elevation(const Road& road) {
  std::set<double> begins{0.0};
  const auto& points = road.profile().points();
  for (std::size_t i = 1; i + 1 < points.size(); ++i) {
    for (const double side : {-0.5, 0.5}) {
      const double s = points[i].s_m + side * points[i].parabola_m;
      if (s > 0.0 && s < road.length_m()) begins.insert(s);
    }
  }
  std::string text = "<elevationProfile>\n";
  for (const double s : begins) {
    const geometry::ProfilePoint at = road.profile().Evaluate(s);
    text += Cubic("elevation", "s", s, at.z_m, at.grade, 0.5 * at.curvature_1pm);
  }
  return text + "</elevationProfile>\n";
}

std::string Lateral(const Road& road) {
  std::string text = "<lateralProfile>\n";
  for (const Band& band : road.section().bands()) {
    text +=
        fmt::format("<shape s=\"0\" t=\"{}\" a=\"{}\" b=\"{}\" c=\"0\" d=\"0\"/>\n", band.from_t_m, band.from_z_m, band.slope);
  }
  return text + "</lateralProfile>\n";
}

// The marks whose nearest lane edge is at edge_t, as records along s: one a stretch on which the same marks are painted.
std::string Marks(const Road& road, double edge_t_m, const std::vector<double>& edges) {
  std::vector<const Mark*> marks;
  std::set<double> begins;
  for (const Mark& mark : road.marks()) {
    const auto nearest = std::min_element(edges.begin(), edges.end(),
                                          [&](double a, double b) { return std::fabs(a - mark.t_m) < std::fabs(b - mark.t_m); });
    if (*nearest != edge_t_m) continue;
    marks.push_back(&mark);
    begins.insert(mark.from_s_m);
    if (mark.to_s_m < road.length_m()) begins.insert(mark.to_s_m);
  }
  std::sort(marks.begin(), marks.end(), [](const Mark* a, const Mark* b) { return a->t_m > b->t_m; });  // from the left
  std::string text;
  if (begins.empty() || *begins.begin() > 0.0) text += "<roadMark sOffset=\"0\" type=\"none\"/>\n";
  for (const double s : begins) {
    std::string type, lines;
    const Mark* first = nullptr;
    for (const Mark* mark : marks) {
      if (mark->from_s_m > s || mark->to_s_m <= s) continue;
      if (first == nullptr) first = mark;
      type += (type.empty() ? "" : " ") + std::string(mark->dashed() ? "broken" : "solid");
      const double period = mark->stroke_m + mark->gap_m;
      const double phase = mark->dashed() ? std::fmod(s - mark->from_s_m, period) : 0.0;
      lines += fmt::format("<line length=\"{}\" space=\"{}\" tOffset=\"{}\" sOffset=\"{}\" width=\"{}\"/>",
                           mark->dashed() ? mark->stroke_m : 0.0, mark->dashed() ? mark->gap_m : 0.0, mark->t_m - edge_t_m,
                           phase > 0.0 ? period - phase : 0.0, mark->width_m);
    }
    if (first == nullptr) {
      text += fmt::format("<roadMark sOffset=\"{}\" type=\"none\"/>\n", s);
      continue;
    }
    const bool known = type == "solid" || type == "broken" || std::count(type.begin(), type.end(), ' ') == 1;
    text += fmt::format(
        "<roadMark sOffset=\"{}\" type=\"{}\" weight=\"standard\" color=\"{}\" width=\"{}\"><type name=\"{}\" "
        "width=\"{}\">{}</type></roadMark>\n",
        s, known ? type : "custom", first->colour == MarkColour::kYellow ? "yellow" : "white", first->width_m, type,
        first->width_m, lines);
  }
  return text;
}

struct Strip {
  const char* type;
  double width_m;
  terrain::Surface surface;
  const Lane* lane;
};

// From inside outward: the lanes, the shoulder, the verge.
std::vector<Strip> Strips(const Section& section, bool left) {
  std::vector<Strip> strips;
  for (int id = left ? 1 : -1; const Lane* lane = section.FindLane(id); id += left ? 1 : -1) {
    strips.push_back({"driving", lane->width_m, section.spec().surface, lane});
  }
  const Shoulder& shoulder = left ? section.spec().left : section.spec().right;
  if (shoulder.width_m > 0.0) strips.push_back({"shoulder", shoulder.width_m, shoulder.surface, nullptr});
  const Verge& verge = section.spec().verge;
  if (verge.width_m > 0.0) strips.push_back({"none", verge.width_m, verge.surface, nullptr});
  return strips;
}

std::string Side(const World& world, const Road& road, bool left, bool left_hand, const std::vector<double>& edges) {
  const std::vector<Strip> strips = Strips(road.section(), left);
  std::vector<std::string> lanes;
  double t = 0.0;
  for (std::size_t i = 0; i < strips.size(); ++i) {
    const Strip& strip = strips[i];
    const int id = static_cast<int>(i + 1) * (left ? 1 : -1);
    t += left ? strip.width_m : -strip.width_m;
    const int usual = left == left_hand ? 1 : -1;
    const bool reversed = strip.lane != nullptr && strip.lane->direction != usual;
    std::string text = fmt::format("<lane id=\"{}\" type=\"{}\" level=\"false\"{}>\n", id, strip.type,
                                   reversed ? " direction=\"reversed\"" : "");
    text += Cubic("width", "sOffset", 0.0, strip.width_m, 0.0, 0.0);
    text += Marks(road, t, edges);
    text += fmt::format("<material sOffset=\"0\" surface=\"{}\" friction=\"{}\"/>\n", terrain::SurfaceName(strip.surface),
                        world.Friction(strip.surface));
    if (strip.lane != nullptr)
      text += fmt::format("<speed sOffset=\"0\" max=\"{}\" unit=\"m/s\"/>\n", strip.lane->speed_limit_mps);
    lanes.push_back(text + "</lane>\n");
  }
  if (lanes.empty()) return "";
  if (left) std::reverse(lanes.begin(), lanes.end());
  std::string text = left ? "<left>\n" : "<right>\n";
  for (const std::string& lane : lanes) text += lane;
  return text + (left ? "</left>\n" : "</right>\n");
}

std::string RoadText(const World& world, const Road& road) {
  const bool left_hand = std::all_of(road.lanes().begin(), road.lanes().end(),
                                     [](const Lane& lane) { return lane.direction == (lane.id > 0 ? 1 : -1); });
  std::vector<double> edges{0.0};
  for (const bool left : {true, false}) {
    double t = 0.0;
    for (const Strip& strip : Strips(road.section(), left)) edges.push_back(t += left ? strip.width_m : -strip.width_m);
  }
  std::string text = fmt::format("<road name=\"{0}\" id=\"{0}\" length=\"{1}\" junction=\"-1\" rule=\"{2}\">\n",
                                 Escaped(road.id()), road.length_m(), left_hand ? "LHT" : "RHT");
  text += "<link/>\n" + PlanView(road) + Elevation(road) + Lateral(road);
  text += "<lanes>\n<laneSection s=\"0\">\n" + Side(world, road, true, left_hand, edges);
  text += "<center>\n<lane id=\"0\" type=\"none\" level=\"false\">\n" + Marks(road, 0.0, edges) + "</lane>\n</center>\n";
  return text + Side(world, road, false, left_hand, edges) + "</laneSection>\n</lanes>\n</road>\n";
}

}  // namespace

base::Result<std::string> ExportOpenDrive(const World& world) {
  if (world.open_drive()) return base::WrongInput("this world is an OpenDRIVE file already");
  if (world.roads().empty()) return base::WrongInput("this world has no road; OpenDRIVE needs one");
  std::string text = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<OpenDRIVE>\n";
  text += fmt::format("<header revMajor=\"1\" revMinor=\"7\" name=\"{}\" version=\"1.00\" vendor=\"Rodeira\">\n",
                      Escaped(world.name()));
  if (world.grid() != nullptr && !world.grid()->projection_wkt().empty()) {
    text += fmt::format("<geoReference>{}</geoReference>\n", Escaped(world.grid()->projection_wkt()));
  }
  text += "</header>\n";
  for (const Road& road : world.roads()) text += RoadText(world, road);
  return text + "</OpenDRIVE>\n";
}

}  // namespace rodeira::road
