// SPDX-License-Identifier: Apache-2.0
#include "common/core/base/file_kind.hpp"

#include <fmt/format.h>

#include <array>

namespace rodeira::base {
namespace {

struct Kind {
  std::string_view name;
  std::string_view what;
  std::string_view use;  // "{}": the file
};

constexpr std::array<Kind, 20> kKinds{{
    {"recording", "a recording",
     "watch it: rodeira replay {} --view; go on from it: rodeira replay {} --from SECONDS --branch KEY=VALUE --record "
     "NEW.mcap"},
    {"launch", "a launch file", "run it: rodeira run {}"},
    {"world", "a world", "rodeira world info {}; run in it: rodeira run LAUNCH.yaml --set world={}"},
    {"vehicle", "a vehicle",
     "rodeira vehicle test {}; drive it: rodeira run LAUNCH.yaml --set "
     "nodes.NODE.config.vehicle={}"},
    {"scenario", "a scenario", "a launch file names it: nodes.NODE.config.scenario"},
    {"driver", "a file of a driver", "a launch file names it: nodes.NODE.config.driver"},
    {"keyboard", "a keyboard file", "a launch file names it: nodes.NODE.config.keyboard"},
    {"wheel", "a wheel file", "a launch file names it: nodes.NODE.config.wheel"},
    {"node", "the manifest of a node", "a launch file names it: nodes.NODE.manifest"},
    {"lab", "a laboratory file", "rodeira run LAUNCH.yaml --lab {}"},
    {"traffic", "settings of traffic", "rodeira traffic run WORLD --settings {}"},
    {"measures", "a measures file", "rodeira measures RECORDING.mcap --spec {}"},
    {"mechanism", "a mechanism", "rodeira mechanism run {}"},
    {"motors", "the heights beside a traffic map", "rodeira map check MAP.motors"},
    {"opendrive", "an OpenDRIVE file", "rodeira world info {}"},
    {"map", "a traffic map", "rodeira map check {}"},
    {"crg", "an OpenCRG file", "rodeira surface check {}"},
    {"tir", "a tyre property file", "rodeira vehicle tyre {}"},
    {"fmu", "an FMU or another archive", "a vehicle file names it: fmu"},
    {"png", "a picture", "a world names it: terrain.texture.file"},
}};

constexpr std::size_t kSearched = 4096;  // bytes in which a mark has to stand

// The word behind `rodeira:` at the beginning of a line, up to its '/'; empty: there is none.
std::string_view KindInLine(std::string_view text) {
  constexpr std::string_view kKey = "rodeira:";
  std::size_t at = text.starts_with(kKey) ? 0 : text.find("\nrodeira:");
  if (at == std::string_view::npos) return {};
  at = text.find_first_not_of(" \t\"'", text.find(':', at) + 1);
  if (at == std::string_view::npos) return {};
  const std::size_t end = text.find_first_of("/ \r\n", at);
  return end != std::string_view::npos && text[end] == '/' ? text.substr(at, end - at) : std::string_view();
}

std::string_view FormatOf(std::string_view begin, const std::filesystem::path& path) {
  using namespace std::string_view_literals;
  const std::string_view text = begin.substr(0, kSearched);
  if (text.starts_with("\x89MCAP"sv)) return "recording";
  if (text.starts_with("\x89PNG"sv) || text.starts_with("\xff\xd8\xff"sv)) return "png";
  if (text.starts_with("PK\x03\x04"sv)) return "fmu";
  if (text.find("<OpenDRIVE"sv) != std::string_view::npos) return "opendrive";
  if (text.find("[MDI_HEADER]"sv) != std::string_view::npos) return "tir";
  if (text.find("$ROAD_CRG"sv) != std::string_view::npos || text.starts_with("$CT"sv)) return "crg";
  return path.extension() == ".motors" ? "map" : "";
}

}  // namespace

std::string AboutKind(std::string_view kind, const std::filesystem::path& path) {
  for (const Kind& one : kKinds) {
    if (one.name != kind) continue;
    std::string use(one.use);
    for (std::size_t at = use.find("{}"); at != std::string::npos; at = use.find("{}", at)) {
      use.replace(at, 2, path.string());
      at += path.string().size();
    }
    return fmt::format("{}; {}", one.what, use);
  }
  return {};
}

std::string AboutOtherFormat(std::string_view begin, const std::filesystem::path& path) {
  return AboutKind(FormatOf(begin, path), path);
}

std::string AboutFile(std::string_view begin, const std::filesystem::path& path) {
  const std::string format = AboutOtherFormat(begin, path);
  return format.empty() ? AboutKind(KindInLine(begin.substr(0, kSearched)), path) : format;
}

}  // namespace rodeira::base
