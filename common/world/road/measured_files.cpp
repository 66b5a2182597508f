// SPDX-License-Identifier: Apache-2.0
#include "common/world/road/measured_files.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <span>
#include <string_view>
#include <vector>

#include "common/core/base/files.hpp"
#include "common/world/opendrive/import.hpp"
#include "common/world/surface/crg_header.hpp"

namespace rodeira::road {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kLongestName = 72;  // of a line of a .crg's header

// A name that neither a .crg's header nor XML reads in another way.
std::string PlainFileName(std::string name) {
  const auto odd = [](char c) {
    return !((c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '.' || c == '-' ||
             c == '_');
  };
  std::replace_if(name.begin(), name.end(), odd, '_');
  return name;
}

std::string Unused(const fs::path& like, const std::set<std::string>& used) {
  const std::string stem = PlainFileName(like.stem().string()), extension = PlainFileName(like.extension().string());
  std::string name = stem + extension;
  for (int i = 2; used.contains(name); ++i) name = fmt::format("{}_{}{}", stem, i, extension);
  return name;
}

// The header of a .crg without numbers, naming another file.
std::string Naming(std::string_view text, std::string_view other) {
  std::string out;
  bool names = false;
  while (!text.empty()) {
    const std::string_view line = text.substr(0, std::min(text.find('\n'), text.size() - 1) + 1);
    text.remove_prefix(line.size());
    if (line.starts_with('$')) names = false;
    if (!names || line.starts_with('*')) out += line;
    std::string section(line.substr(0, line.find_first_of(" !\t\r\n")));
    std::transform(section.begin(), section.end(), section.begin(),
                   [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c; });
    if (section != "$road_crg_file") continue;
    names = true;
    if (!out.ends_with('\n')) out += '\n';
    for (std::size_t at = 0; at < other.size(); at += kLongestName)
      out += fmt::format("{}\n", other.substr(at, kLongestName));
    other = {};  // once
  }
  return out;
}

// One that names another file has that beside it, under a name that nothing else in the folder has.
base::Status Copy(const fs::path& from, const fs::path& to, std::set<std::string>& used) {
  const auto bytes = base::ReadBytes(from);
  if (!bytes) return bytes.error();
  const auto header = surface::ReadCrgHeader(bytes.value(), from.string());
  if (!header) return header.error();
  std::error_code problem;
  fs::create_directories(to.parent_path(), problem);
  if (header.value().data_offset != 0) return base::WriteWhole(to, bytes.value());
  const fs::path other = from.parent_path() / header.value().other_file;
  const auto numbers = base::ReadBytes(other);
  if (!numbers) return numbers.error();
  const std::string name = Unused(other.filename(), used);
  used.insert(name);
  if (auto written = base::WriteWhole(to.parent_path() / name, numbers.value()); !written) return written;
  const std::string_view text(reinterpret_cast<const char*>(bytes.value().data()), bytes.value().size());
  return base::WriteWhole(to, std::string_view(Naming(text, name)));
}

}  // namespace

MeasuredFiles::MeasuredFiles(const fs::path& exported)
    : parent_(exported.parent_path()), folder_(PlainFileName(exported.stem().string()) + "_surfaces") {}

std::string MeasuredFiles::NameOf(const std::string& file) {
  const std::string path = fs::absolute(file).lexically_normal().string();
  auto& name = names_[path];
  if (name.empty()) {
    std::set<std::string> used;
    for (const auto& [other, theirs] : names_) used.insert(theirs);
    name = Unused(fs::path(path).filename(), used);
  }
  return (folder_ / name).string();
}

base::Status MeasuredFiles::Write() const {
  std::set<std::string> used;
  for (const auto& [path, name] : names_) used.insert(name);
  for (const auto& [path, name] : names_) {
    if (auto copied = Copy(path, parent_ / folder_ / name, used); !copied) return copied;
  }
  return {};
}

base::Result<std::vector<std::string>> CopyMeasured(const fs::path& open_drive, const fs::path& copy,
                                                    std::vector<fs::path>* copied) {
  const auto import = opendrive::Load(open_drive);
  if (!import) return import.error();
  std::vector<std::string> warnings;
  if (import.value().network == nullptr) return warnings;
  std::set<std::string> files;
  for (const network::Road& road : import.value().network->roads()) {
    for (const network::CrgSurface& crg : road.spec().crg) files.insert(crg.file);
  }
  std::set<std::string> used;
  for (const std::string& file : files) used.insert(fs::path(file).filename().string());
  for (const std::string& file : files) {
    const fs::path named = fs::path(file).lexically_normal();
    if (named.is_absolute()) continue;
    if (named.string().starts_with("..")) {
      warnings.push_back(fmt::format("{}: '{}' is not found from here: its path leaves the folder of {}", copy.string(),
                                     file, open_drive.string()));
      continue;
    }
    const fs::path to = copy.parent_path() / named, from = open_drive.parent_path() / named;
    std::error_code problem;
    const std::set<std::string> before = used;
    if (!fs::equivalent(from, to, problem)) {
      if (auto written = Copy(from, to, used); !written) return written.error();
    }
    if (copied == nullptr) continue;
    copied->push_back(named);
    for (const std::string& name : used) {
      if (!before.contains(name)) copied->push_back(named.parent_path() / name);  // its numbers
    }
  }
  return warnings;
}

}  // namespace rodeira::road
