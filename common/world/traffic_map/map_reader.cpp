// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include "common/core/base/files.hpp"
#include "common/world/traffic_map/map_file.hpp"
#include "common/world/traffic_map/map_line.hpp"

namespace rodeira::traffic_map {
namespace {

std::string At(const std::string& name, std::size_t number) { return fmt::format("{}:{}", name, number); }

template <class Value>
base::Status Take(std::string_view text, std::size_t number, Line<Value>& line) {
  auto value = ReadLine<Value>(WithoutLineEnd(text));
  if (!value) return value.error();
  line = {value.value(), std::string(text), number};
  return {};
}

template <class Value>
base::Status Append(std::string_view text, std::size_t number, std::vector<Line<Value>>& lines) {
  return Take(text, number, lines.emplace_back());
}

base::Status TakeLine(std::string_view text, std::size_t number, MapFile& map) {
  const std::string_view letter = WithoutLineEnd(text.substr(0, text.find(',')));
  if (letter == "p") return Append(text, number, map.curves);
  if (letter == "l") return Append(text, number, map.lanes);
  if (letter == "c") return Append(text, number, map.connections);
  if (letter == "s") {
    if (map.scale.number != 0)
      return base::WrongInput("map.wrong_line",
                              fmt::format("a second line 's'; the first is line {}", map.scale.number));
    return Take(text, number, map.scale);
  }
  if (letter == "i")
    return base::WrongInput("map.wrong_line",
                            "a line that begins with 'i' and goes on; 'i' alone was expected, then LF and the picture");
  return base::WrongInput(
      "map.wrong_line",
      fmt::format("the line begins with '{}'; expected are p (curve), l (lane), c (connection), s (scale) "
                  "or i (picture), in small letters",
                  letter.substr(0, 40)));
}

}  // namespace

base::Result<MapFile> ParseMap(std::string_view bytes, const std::string& name) {
  MapFile map;
  std::size_t at = 0;
  for (std::size_t number = 1;; ++number) {
    if (number > kMaxLines)
      return base::WrongInput("map.too_large", fmt::format("more than {} lines stand before the picture", kMaxLines),
                              name);
    const std::size_t length = bytes.substr(at, kLongestLine + 1).find('\n');
    if (length == std::string_view::npos) {
      if (bytes.size() - at > kLongestLine)
        return base::WrongInput("map.too_large", fmt::format("the line has more than {} bytes", kLongestLine),
                                At(name, number));
      return base::WrongInput(
          "map.missing_line",
          fmt::format("the file ends at byte {} without a line 'i', behind which the picture stands", bytes.size()),
          name);
    }
    const std::string_view text = bytes.substr(at, length + 1);
    at += text.size();
    if (text == "i\n") break;
    if (auto status = TakeLine(text, number, map); !status) return status.error().WithContext(At(name, number));
  }
  if (map.scale.number == 0)
    return base::WrongInput("map.missing_line", "there is no line 's' with the picture's scale", name);
  map.picture = bytes.substr(at);
  return map;
}

base::Result<MapFile> LoadMap(const std::filesystem::path& path) {
  const auto bytes = base::ReadText(path, kMaxBytes);
  if (!bytes) return bytes.error();
  return ParseMap(bytes.value(), path.string());
}

}  // namespace rodeira::traffic_map
