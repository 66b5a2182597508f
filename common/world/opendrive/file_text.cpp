// SPDX-License-Identifier: Apache-2.0
#include "common/world/opendrive/file_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <set>
#include <utility>

#include "common/core/base/files.hpp"
#include "common/core/base/nearest_file.hpp"
#include "common/world/opendrive/archive.hpp"
#include "common/world/opendrive/encoding.hpp"

namespace rodeira::opendrive {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMaxBytes = std::size_t{1} << 30;  // of a file, and of a text with all that it includes
constexpr std::size_t kMaxDepth = 16;
constexpr std::size_t kMaxIncludes = 10'000;
constexpr int kMaxPacked = 2;                               // an archive of gzipped files
constexpr std::size_t kUnreadBytes = std::size_t{1} << 24;  // what a file of an archive counts that cannot be unpacked

// Where a file and those that it includes come from: a folder, or an archive.
struct Place {
  fs::path name;  // of the file; inside the archive, where there is one
  std::shared_ptr<const Archive> archive;
};

struct Found {
  std::string text;
  Place place;
};

bool EndsOn(const std::string& name, std::initializer_list<std::string_view> endings) {
  std::string lower(name);
  std::transform(lower.begin(), lower.end(), lower.begin(),
                 [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c; });
  return std::any_of(endings.begin(), endings.end(), [&](std::string_view ending) { return lower.ends_with(ending); });
}

// As it is named, with '/' between folders.
std::string Named(const std::string& file) {
  std::string named = file;
  std::replace(named.begin(), named.end(), '\\', '/');
  return named;
}

bool Parse(pugi::xml_document& document, const std::string& text) {
  const auto parsed =
      document.load_buffer(text.data(), text.size(), pugi::parse_default | pugi::parse_fragment, pugi::encoding_utf8);
  return static_cast<bool>(parsed);
}

// All elements <include file="…">, in the order of the text.
std::vector<pugi::xml_node> IncludesIn(const pugi::xml_document& document) {
  struct Walker final : pugi::xml_tree_walker {
    bool for_each(pugi::xml_node& node) override {
      if (std::string_view(node.name()) == "include" && node.attribute("file")) includes.push_back(node);
      return true;
    }
    std::vector<pugi::xml_node> includes;
  } walker;
  const_cast<pugi::xml_document&>(document).traverse(walker);
  return std::move(walker.includes);
}

// An element of four bytes becomes a node of 70: a text within the bounds of a file must not fill the memory.
base::Status HasSaneCounts(const std::string& text, const fs::path& path) {
  constexpr std::size_t kMaxElements = std::size_t{1} << 24, kMaxAttributes = std::size_t{1} << 26;
  std::size_t elements = 0;
  for (std::size_t at = text.find('<'); at != std::string::npos; at = text.find('<', at + 1))
    elements += at + 1 < text.size() && text[at + 1] != '/';
  const auto attributes = static_cast<std::size_t>(std::count(text.begin(), text.end(), '='));
  if (elements <= kMaxElements && attributes <= kMaxAttributes) return {};
  return base::WrongInput(
      "file.too_large",
      elements > kMaxElements
          ? fmt::format("it has {} elements; at most {} were expected of a road network", elements, kMaxElements)
          : fmt::format("it has {} attributes; at most {} were expected of a road network", attributes, kMaxAttributes),
      path.string());
}

// A file of an archive as text; nothing where it cannot be read.
std::optional<std::string> TextOf(const Archive& archive, const std::string& name, const fs::path& path) {
  auto bytes = archive.Read(name);
  for (int layer = 0; bytes && IsGzip(bytes.value()) && layer < kMaxPacked; ++layer)
    bytes = Gunzip(bytes.value(), path);
  if (!bytes) return std::nullopt;
  auto text = ToUtf8(std::move(bytes).value(), path);
  return text && HasSaneCounts(text.value(), path) ? std::optional(std::move(text).value()) : std::nullopt;
}

// Of several files of an archive those that no other file includes. All of them where what is read of the archive is
// too long; the first where each is included, so that the reading says by which.
std::vector<std::string> RootsOf(const Archive& archive, const std::vector<std::string>& files, const fs::path& path) {
  std::set<std::string> included;
  std::vector<std::string> open = files;
  std::size_t bytes = 0;
  for (std::size_t i = 0; i < open.size(); ++i) {
    const std::string name = open[i];
    const std::optional<std::string> text = TextOf(archive, name, path);
    if ((bytes += text ? text->size() : kUnreadBytes) > kMaxUnpackedBytes) return files;
    pugi::xml_document document;
    if (!text || text->find("<include") == std::string::npos || !Parse(document, *text)) continue;
    for (const pugi::xml_node& include : IncludesIn(document)) {
      const fs::path file = fs::path(name).parent_path() / Named(include.attribute("file").value());
      const std::string found = file.lexically_normal().generic_string();
      if (found == name || !archive.Has(found) || !included.insert(found).second) continue;
      if (std::find(files.begin(), files.end(), found) == files.end()) open.push_back(found);
    }
  }
  std::vector<std::string> roots = files;
  std::erase_if(roots, [&](const std::string& name) { return included.contains(name); });
  return roots.empty() ? std::vector{files.front()} : roots;
}

// The one OpenDRIVE file of an archive: by its ending; where none ends so, the one .xml. Of several the one that
// includes the others.
base::Result<std::string> RoadFileOf(const Archive& archive, const fs::path& path) {
  std::vector<std::string> roads, others;
  for (const std::string& name : archive.names()) {
    if (EndsOn(name, {".xodr", ".xodrz", ".xodr.gz"})) roads.push_back(name);
    if (EndsOn(name, {".xml"})) others.push_back(name);
  }
  if (roads.empty()) roads = std::move(others);
  if (roads.size() > 1) roads = RootsOf(archive, roads, path);
  if (roads.size() == 1) return roads.front();
  if (roads.empty())
    return base::WrongInput("opendrive.wrong_archive",
                            fmt::format("none of the archive's {} files is an OpenDRIVE file; one .xodr was expected",
                                        archive.names().size()),
                            path.string());
  return base::WrongInput(
      "opendrive.wrong_archive",
      fmt::format("the archive holds {} OpenDRIVE files ('{}', '{}'{}), of which none includes another; one was "
                  "expected: unpack it and name one",
                  roads.size(), roads[0], roads[1], roads.size() > 2 ? ", …" : ""),
      path.string());
}

base::Result<Found> Unpack(std::string bytes, Place place, const fs::path& path) {
  for (int layer = 0; IsGzip(bytes) || IsZip(bytes); ++layer) {
    if (layer == kMaxPacked)
      return base::WrongInput("opendrive.wrong_archive",
                              fmt::format("the file is packed more than {} times", kMaxPacked), path.string());
    if (IsGzip(bytes)) {
      auto unpacked = Gunzip(bytes, path);
      if (!unpacked) return unpacked.error();
      bytes = std::move(unpacked).value();
      continue;
    }
    auto archive = Archive::Open(std::move(bytes), path);
    if (!archive) return archive.error();
    const auto name = RoadFileOf(*archive.value(), path);
    if (!name) return name.error();
    auto unpacked = archive.value()->Read(name.value());
    if (!unpacked) return unpacked.error();
    bytes = std::move(unpacked).value();
    place = {name.value(), std::move(archive).value()};
  }
  auto text = ToUtf8(std::move(bytes), path);
  if (!text) return text.error();
  if (const auto status = LooksLikeXml(text.value(), path); !status) return status.error();
  if (const auto status = HasSaneCounts(text.value(), path); !status) return status.error();
  return Found{std::move(text).value(), std::move(place)};
}

bool LeavesArchive(const std::string& file, const Place& by) {
  if (by.archive == nullptr) return false;
  const fs::path path = (by.name.parent_path() / Named(file)).lexically_normal();
  return path.is_absolute() || (path.begin() != path.end() && *path.begin() == "..");
}

// The file that `by` includes by this name; in an error's message why there is none.
base::Result<Found> Open(const std::string& file, const Place& by) {
  const std::string named = Named(file);
  if (fs::path(named).is_absolute() || (named.size() > 1 && named[1] == ':'))
    return base::WrongInput("opendrive.include_not_found",
                            "its path is absolute; one relative to this file was expected");
  const fs::path path = (by.name.parent_path() / named).lexically_normal();
  if (by.archive != nullptr) {
    if (!by.archive->Has(path.generic_string()))
      return base::WrongInput("opendrive.wrong_archive", "the archive holds no such file");
    auto bytes = by.archive->Read(path.generic_string());
    if (!bytes) return bytes.error();
    return Unpack(std::move(bytes).value(), {path, by.archive}, path);
  }
  std::error_code problem;
  if (!fs::is_regular_file(path, problem)) {
    return base::WrongInput("opendrive.include_not_found", fs::exists(path, problem)
                                                               ? std::string("it is no plain file")
                                                               : "there is no such file" + base::NearestFile(path));
  }
  auto bytes = base::ReadText(path, kMaxBytes);
  if (!bytes) return bytes.error();
  return Unpack(std::move(bytes).value(), {path, nullptr}, path);
}

// The elements of an included text. Those of an outermost element are taken where it only stands for the place: it has
// the name of the element that includes it, or is <OpenDRIVE>; then without a second <header>.
std::string Content(const std::string& text, const pugi::xml_document& document, std::string_view parent) {
  const auto begin_of = [](const pugi::xml_node& node) { return static_cast<std::size_t>(node.offset_debug()) - 1; };
  const pugi::xml_node outermost = document.document_element();
  const bool is_shell = outermost && !outermost.next_sibling() &&
                        (outermost.name() == parent || std::string_view(outermost.name()) == "OpenDRIVE" ||
                         std::string_view(outermost.name()) == "include");
  std::string content;
  for (const pugi::xml_node node : is_shell ? outermost.children() : document.children()) {
    if (node.type() != pugi::node_element || (is_shell && std::string_view(node.name()) == "header")) continue;
    content += text.substr(begin_of(node), ElementEnd(text, begin_of(node)) - begin_of(node));
    content += '\n';
  }
  return content;
}

// What files include is put in their place, innermost first. A file that is included again is not read again.
class Includes {
 public:
  explicit Includes(const fs::path& path) : path_(path) {}

  // The edits that put the included files into a text, ascending.
  base::Result<std::vector<Edit>> EditsOf(const Found& in) {
    std::vector<Edit> edits;
    if (in.text.find("<include") == std::string::npos) return edits;
    pugi::xml_document document;
    if (!Parse(document, in.text)) return edits;  // what is wrong is told by the reading
    open_.push_back(in.place);
    for (const pugi::xml_node& include : IncludesIn(document)) {
      const std::string file = include.attribute("file").value();
      auto content = ContentOf(file, in.place, include.parent().name());
      if (!content) return content.error();
      if (!content.value()) continue;
      const auto begin = static_cast<std::size_t>(include.offset_debug()) - 1;
      edits.push_back({begin, ElementEnd(in.text, begin), *std::move(content).value()});
    }
    open_.pop_back();
    return edits;
  }

  const std::map<std::string, std::string>& unread() const { return unread_; }

 private:
  // Nothing where the file cannot be read, which is kept in unread_; wrong input where it would come to no end.
  base::Result<std::optional<std::string>> ContentOf(const std::string& file, const Place& by,
                                                     const std::string& parent) {
    const auto refuse = [&](const std::string& message) {
      return base::WrongInput("opendrive.include_not_found", message, path_.string());
    };
    if (LeavesArchive(file, by))
      return refuse(
          fmt::format("the path of '{}', which <include> of '{}' names, leaves the archive; one inside it was "
                      "expected",
                      file, by.name.filename().string()));
    if (++count_ > kMaxIncludes) return refuse(fmt::format("more than {} files are included", kMaxIncludes));
    const std::string key =
        (by.archive ? "in an archive: " : "") + (by.name.parent_path() / Named(file)).lexically_normal().string();
    auto known = opened_.find(key);
    if (known == opened_.end()) {
      known = opened_.emplace(key, Open(file, by)).first;
      const bool in_archive =
          by.archive != nullptr &&
          by.archive->Has((by.name.parent_path() / Named(file)).lexically_normal().generic_string());
      opened_bytes_ += known->second ? known->second.value().text.size() : in_archive ? kUnreadBytes : 0;
      if (opened_bytes_ > kMaxBytes) return refuse(TooLong());
    }
    const base::Result<Found>& found = known->second;
    if (!found) {
      unread_.emplace(file, found.error().message);
      return std::optional<std::string>();
    }
    const auto same = [&](const Place& open) {
      std::error_code problem;
      return open.archive != nullptr ? open.name == found.value().place.name
                                     : fs::equivalent(open.name, found.value().place.name, problem);
    };
    if (std::any_of(open_.begin(), open_.end(), same))
      return refuse(fmt::format("'{}' includes itself, by <include file=\"{}\"> of '{}'",
                                found.value().place.name.filename().string(), file, by.name.filename().string()));
    if (open_.size() >= kMaxDepth) return refuse(fmt::format("files include one another {} deep", kMaxDepth));
    auto edits = EditsOf(found.value());
    if (!edits) return edits.error();
    const std::string text = Apply(found.value().text, edits.value());
    if ((bytes_ += text.size()) > kMaxBytes) return refuse(TooLong());
    if (const auto status = HasSaneCounts(text, found.value().place.name); !status) return status.error();
    pugi::xml_document document;
    if (!Parse(document, text)) {
      unread_.emplace(file, "it is no XML");
      return std::optional<std::string>();
    }
    return std::optional(Content(text, document, parent));
  }

  static std::string TooLong() { return fmt::format("what is included is longer than {} MiB", kMaxBytes >> 20); }

  const fs::path& path_;
  std::map<std::string, base::Result<Found>> opened_;
  std::vector<Place> open_;  // those that include one another, outermost first
  std::map<std::string, std::string> unread_;
  std::size_t count_ = 0, bytes_ = 0, opened_bytes_ = 0;
};

}  // namespace

base::Result<FileText> ReadFileText(const fs::path& path) {
  auto bytes = base::ReadText(path, kMaxBytes);
  if (!bytes) return bytes.error();
  auto found = Unpack(std::move(bytes).value(), {path, nullptr}, path);
  if (!found) return found.error();
  Includes includes(path);
  const auto edits = includes.EditsOf(found.value());
  if (!edits) return edits.error();
  FileText file{std::move(found).value().text, {}};
  file.edited.line_starts = LineStarts(file.text);
  file.edited.unread = includes.unread();
  file.edited.surface_files = std::make_shared<SurfaceFiles>(path.parent_path());
  if (edits.value().empty()) return file;
  file.text = Apply(file.text, edits.value());
  if (const auto status = HasSaneCounts(file.text, path); !status) return status.error();
  file.edited.maps.emplace_back(edits.value());
  file.edited.includes = 1;
  return file;
}

}  // namespace rodeira::opendrive
