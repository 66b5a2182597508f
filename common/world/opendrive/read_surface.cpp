// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <string_view>
#include <vector>

#include "common/core/base/suggest.hpp"
#include "common/world/opendrive/read.hpp"

namespace rodeira::opendrive {
namespace {

// What OpenDRIVE has no element for, in the data of users.
constexpr std::string_view kMade = "rodeira:iso_8608";  // s, end of s, offset of s (m), density (m3), seed
constexpr std::string_view kGoesOn =
    "rodeira:goes_on";  // how far before s = 0 and behind the road's end it goes on (m)
constexpr double kFarthest_m = 1e6, kRoughest_m3 = 1.0;
constexpr double kNear_m = 0.01;  // numbers in files are rounded

template <class Value>
bool Take(std::string_view& text, Value& value) {
  text.remove_prefix(std::min(text.find_first_not_of(' '), text.size()));
  const auto [end, problem] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (problem != std::errc()) return false;
  text.remove_prefix(static_cast<std::size_t>(end - text.data()));
  return true;
}

void ReadMade(const Node& data, network::RoadSpec& spec) {
  const std::string said = data.Text("value", "");
  std::string_view text = said;
  network::Unevenness made;
  bool right = Take(text, made.s_start_m) && Take(text, made.s_end_m) && Take(text, made.s_offset_m) &&
               Take(text, made.density_m3) && Take(text, made.seed);
  right = right && text.find_first_not_of(' ') == std::string_view::npos;
  for (const double s : {made.s_start_m, made.s_end_m, made.s_offset_m}) right = right && std::fabs(s) <= kFarthest_m;
  right = right && made.s_end_m > made.s_start_m && made.density_m3 >= 0.0 && made.density_m3 <= kRoughest_m3;
  if (right) {
    spec.unevenness.push_back(made);
  } else {
    data.Wrong("rodeira.iso_8608", fmt::format("a made surface is '{}'; five numbers were expected: from s to s, "
                                               "offset of s (m), density at 0.1 cycles a metre (at most {} m3), seed",
                                               said, kRoughest_m3));
  }
}

void ReadGoesOn(const Node& data, network::CrgSurface& crg) {
  const std::string said = data.Text("value", "");
  std::string_view text = said;
  double before_m = 0.0, behind_m = 0.0;
  bool right = Take(text, before_m) && Take(text, behind_m) && text.find_first_not_of(' ') == std::string_view::npos;
  for (const double beyond_m : {before_m, behind_m}) right = right && beyond_m >= 0.0 && beyond_m <= kFarthest_m;
  if (!right)
    return data.Wrong("rodeira.goes_on", fmt::format("a measured surface goes on '{}'; two numbers were expected: "
                                                     "metres before the road's beginning and behind its end",
                                                     said));
  crg.s_start_m -= before_m;
  crg.s_offset_m -= before_m;
  crg.s_end_m += behind_m;
}

// A surface that reaches beyond its road is cut at the road's ends. Its own u stays where it is on the road.
Repair CutStretch(const Node& node, const network::CrgSurface& crg, double length_m) {
  const double begin_m = std::max(crg.s_start_m, 0.0), end_m = std::min(crg.s_end_m, length_m);
  if (!(end_m - begin_m > kNear_m)) return TakeOut(node);
  Repair repair{RepairKind::kSurfaceCut, "it is cut at the road's end", {}};
  if (begin_m != crg.s_start_m) {
    repair.edits.push_back(node.Set("sStart", fmt::format("{}", begin_m)));
    repair.edits.push_back(node.Set("sOffset", fmt::format("{}", crg.s_offset_m + begin_m - crg.s_start_m)));
  }
  if (end_m != crg.s_end_m) repair.edits.push_back(node.Set("sEnd", fmt::format("{}", end_m)));
  return repair;
}

// That the stretch lies on the road. A line of its own (genuine) has its own length.
void CheckStretch(const Node& node, const network::CrgSurface& crg, double length_m) {
  if (crg.mode == "genuine" ||
      (crg.s_start_m >= -kNear_m && crg.s_end_m > crg.s_start_m && crg.s_end_m <= length_m + kNear_m))
    return;
  node.Wrong(
      "road.surface.crg.s",
      fmt::format(
          "the measured surface '{}' lies from s = {} to {}; two places on the road, which is {} m long, were expected",
          crg.file, crg.s_start_m, crg.s_end_m, length_m),
      CutStretch(node, crg, length_m));
}

// That the surface can be laid: false where its file is missing or damaged.
bool CheckFile(const Node& node, const network::CrgSurface& crg) {
  SurfaceFiles* files = node.source().surface_files();
  if (files == nullptr) return true;
  if (crg.file.empty()) return false;  // which is told
  const Within within(node.source());
  node.source().where.s_m = crg.s_start_m;
  if (const std::string why = files->WhyMissing(crg.file); !why.empty()) {
    node.Wrong("rodeira.surface.file", fmt::format("the measured surface '{}' is left out: {}", crg.file, why),
               TakeOut(node));
    return false;
  }
  const auto& file = files->Read(crg.file);
  if (file) return true;
  node.Wrong("rodeira.surface.damaged",
             fmt::format("the measured surface '{}' is left out: {}", crg.file, file.error().Text()), TakeOut(node));
  return false;
}

// A misspelt word is read as the nearest that there is. Where none is near, the surface is left out.
void CheckWord(const Node& node, const network::CrgSurface& crg, const char* attribute, const std::string& found,
               const std::vector<std::string>& known) {
  if (std::find(known.begin(), known.end(), found) != known.end()) return;
  std::string lower = found;
  std::transform(lower.begin(), lower.end(), lower.begin(),
                 [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
  const std::string meant = base::NearestName(lower, known);
  const Within within(node.source());
  node.source().where.s_m = crg.s_start_m;
  node.Wrong(
      fmt::format("road.surface.crg.{}", attribute),
      fmt::format("'{}' is no {} of the measured surface '{}'{}", found, attribute, crg.file,
                  base::DidYouMean(lower, known)),
      meant.empty()
          ? TakeOut(node)
          : Repair{RepairKind::kValueReplaced, fmt::format("it is read as '{}'", meant), {node.Set(attribute, meant)}});
}

}  // namespace

void ReadSurface(const Node& road, network::RoadSpec& spec) {
  const Node surface = road.Child("surface");
  const double length_m = spec.length_m;
  for (const Node& node : surface.Children("CRG")) {
    network::CrgSurface crg;
    crg.file = node.Text("file");
    crg.orientation = node.Text("orientation", "same");
    crg.mode = node.Text("mode", "attached");
    crg.purpose = node.Text("purpose", "elevation");
    crg.s_start_m = node.Number("sStart");
    crg.s_end_m = node.Number("sEnd");
    crg.s_offset_m = node.Number("sOffset", 0.0);
    crg.t_offset_m = node.Number("tOffset", 0.0);
    crg.z_offset_m = node.Number("zOffset", 0.0);
    crg.z_scale = node.Number("zScale", 1.0);
    crg.h_offset_rad = node.Number("hOffset", 0.0);
    if (!CheckFile(node, crg)) continue;
    CheckWord(node, crg, "mode", crg.mode, {"attached", "attached0", "genuine", "global"});
    CheckWord(node, crg, "orientation", crg.orientation, {"same", "opposite"});
    CheckWord(node, crg, "purpose", crg.purpose, {"elevation", "friction"});
    CheckStretch(node, crg, length_m);
    for (const Node& data : node.Children("userData")) {
      if (data.Text("code", "") == kGoesOn) ReadGoesOn(data, crg);
    }
    spec.crg.push_back(crg);
  }
  for (const Node& data : surface.Children("userData")) {
    if (data.Text("code", "") == kMade) ReadMade(data, spec);
  }
}

}  // namespace rodeira::opendrive
