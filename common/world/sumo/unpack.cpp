// SPDX-License-Identifier: Apache-2.0
#include "common/world/sumo/unpack.hpp"

#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <memory>
#include <string_view>
#include <system_error>
#include <vector>

#include "common/core/base/nearest_file.hpp"
#include "common/core/base/open_error.hpp"
#include "common/world/opendrive/archive.hpp"

namespace rodeira::sumo {
namespace {

constexpr std::uint64_t kMaxBytes = std::uint64_t(4) << 30;
constexpr std::size_t kHead = 1 << 18;  // in which the outermost element begins

bool EndsWith(std::string_view name, std::string_view end) {
  const auto lower = [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c; };
  return name.size() > end.size() &&
         std::equal(end.rbegin(), end.rend(), name.rbegin(), [&](char a, char b) { return a == lower(b); });
}

const char* RootOf(SourceKind kind) { return kind == SourceKind::kNet ? "net" : "osm"; }

// What stands in a file of XML before its outermost element is passed over. The element's name, or "!DOCTYPE"; empty
// where there is no element.
std::string OutermostElement(std::string_view text) {
  if (text.starts_with("\xef\xbb\xbf")) text.remove_prefix(3);
  while (true) {
    text.remove_prefix(std::min(text.find_first_not_of(" \t\r\n"), text.size()));
    if (!text.starts_with('<')) return {};
    const std::string_view end = text.starts_with("<!--") ? "-->" : text.starts_with("<?") ? "?>" : "";
    if (end.empty()) break;
    const std::size_t at = text.find(end);
    if (at == std::string_view::npos) return {};
    text.remove_prefix(at + end.size());
  }
  text.remove_prefix(1);
  return std::string(text.substr(0, text.find_first_of(" \t\r\n/>")));
}

base::Status CheckRoot(std::string_view head, SourceKind kind, const std::filesystem::path& file) {
  const std::string root = OutermostElement(head);
  if (root == RootOf(kind)) return {};
  const std::string found =
      root.empty() ? "there is no XML element" : fmt::format("the outermost element is <{}>", root.substr(0, 40));
  return base::WrongInput("sumo.not_a_network", fmt::format("{}; <{}> was expected", found, RootOf(kind)),
                          file.string());
}

struct Close {
  void operator()(gzFile file) const { ::gzclose(file); }
};

}  // namespace

base::Result<SourceKind> KindOf(const std::filesystem::path& file) {
  const std::string name = file.filename().string();
  for (const char* packed : {"", ".gz"}) {
    if (EndsWith(name, std::string(".osm") + packed)) return SourceKind::kOpenStreetMap;
    if (EndsWith(name, std::string(".net.xml") + packed)) return SourceKind::kNet;
  }
  if (EndsWith(name, ".osm.pbf"))
    return base::WrongInput(
        "sumo.unknown_kind",
        "netconvert does not read .osm.pbf; `osmium cat FILE.osm.pbf -o FILE.osm` makes a .osm of it", file.string());
  return base::WrongInput(
      "sumo.unknown_kind",
      "the name of a map of OpenStreetMap (.osm, .osm.gz) or a SUMO network (.net.xml, .net.xml.gz) was expected",
      file.string());
}

base::Status Unpack(const std::filesystem::path& file, SourceKind kind, const std::filesystem::path& copy) {
  std::error_code problem;
  const auto status = std::filesystem::status(file, problem);
  if (!std::filesystem::exists(status))
    return base::WrongInput("file.not_found", base::NoSuchFile(file), file.string());
  if (std::filesystem::is_directory(status))
    return base::WrongInput("file.is_folder", "this is a folder, a file was expected", file.string());
  const std::unique_ptr<gzFile_s, Close> in(::gzopen(file.c_str(), "rb"));  // reads what is not packed, too
  if (!in) return base::OpenError("the file cannot be opened", errno, file.string());
  std::ofstream out(copy, std::ios::binary);
  std::vector<char> buffer(kHead);
  const auto packed = std::filesystem::file_size(file, problem);
  if (problem) return base::WrongInput("file.cannot_read", problem.message(), file.string());
  std::uint64_t bytes = 0;
  while (true) {
    const int size = ::gzread(in.get(), buffer.data(), static_cast<unsigned>(buffer.size()));
    int wrong = Z_OK;
    const char* message = ::gzerror(in.get(), &wrong);
    if (size < 0 || (wrong != Z_OK && wrong != Z_STREAM_END))
      return base::WrongInput("file.cannot_read", fmt::format("the file cannot be unpacked: {}", message),
                              file.string());
    if (size == 0) break;
    if (bytes == 0) {
      if (auto root = CheckRoot({buffer.data(), static_cast<std::size_t>(size)}, kind, file); !root) return root;
    }
    bytes += static_cast<std::uint64_t>(size);
    if (bytes > kMaxBytes)
      return base::WrongInput("file.too_large", fmt::format("the file has more than {} bytes unpacked", kMaxBytes),
                              file.string());
    if (opendrive::IsBomb(bytes, packed))
      return base::WrongInput("file.too_large",
                              fmt::format("the file unpacks to more than {} times its {} bytes; this is no map but a "
                                          "bomb",
                                          opendrive::kMaxPackedRatio, packed),
                              file.string());
    out.write(buffer.data(), size);
    if (!out)
      return base::Failed("file.cannot_write", fmt::format("cannot be written: {}", std::strerror(errno)),
                          copy.string());
  }
  if (bytes == 0) return base::WrongInput("file.empty", "the file is empty", file.string());
  out.close();
  if (!out)
    return base::Failed("file.cannot_write", fmt::format("cannot be written: {}", std::strerror(errno)), copy.string());
  return {};
}

}  // namespace rodeira::sumo
