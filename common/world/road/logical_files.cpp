// SPDX-License-Identifier: Apache-2.0
#include "common/world/road/logical_files.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <sstream>
#include <string>

#include "common/core/base/files.hpp"
#include "common/core/config/config.hpp"
#include "common/world/opendrive/import.hpp"
#include "common/world/road/network_world.hpp"
#include "common/world/surface/crg_header.hpp"

namespace rodeira::road {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kLogicalKind = "rodeira: logical/1";
constexpr std::size_t kMaxBytes = std::size_t{1} << 30;

// Copies a file and all that belongs to it, by paths from one folder to those from the other.
class Copier {
 public:
  Copier(fs::path from, fs::path to) : from_(std::move(from)), to_(std::move(to)) {}

  // The names that stand in a file of YAML in `below`.
  base::Status NamesOf(const config::File& file, const fs::path& below) {
    for (const std::string& scalar : file.Scalars()) {
      const fs::path name(scalar);
      if (name.is_relative() && name.has_extension()) {
        if (auto copied = Copy((below / name).lexically_normal()); !copied) return copied;
      }
    }
    return {};
  }
  std::vector<fs::path> copied() const { return {done_.begin(), done_.end()}; }

 private:
  base::Status Copy(const fs::path& name) {
    std::error_code problem;
    if (name.begin()->string() == ".." || !fs::is_regular_file(from_ / name, problem) || !done_.insert(name).second)
      return {};
    if (auto written = CopyAlone(name); !written) return written;
    if (name.extension() == ".yaml") {
      const auto file = config::File::Load(from_ / name);
      return file ? NamesOf(file.value(), name.parent_path()) : base::Status(file.error());
    }
    if (name.extension() == ".crg") {
      const auto bytes = base::ReadBytes(from_ / name);
      if (!bytes) return bytes.error();
      const auto header = surface::ReadCrgHeader(bytes.value(), (from_ / name).string());
      if (!header || header.value().data_offset != 0) return {};
      const fs::path other(header.value().other_file);
      return other.is_absolute() ? base::Status() : Copy((name.parent_path() / other).lexically_normal());
    }
    for (const char* ending : {".prj", ".hdr", ".wld", ".jgw", ".pgw", ".tfw", ".bpw", ".mtl"}) {
      const fs::path companion = fs::path(name).replace_extension(ending);
      if (!fs::is_regular_file(from_ / companion, problem) || !done_.insert(companion).second) continue;
      if (auto written = CopyAlone(companion); !written) return written;
    }
    return {};
  }

  base::Status CopyAlone(const fs::path& name) const {
    std::error_code problem;
    if (fs::equivalent(from_ / name, to_ / name, problem)) return {};
    // A network is written as one text, so that what it includes is not missed.
    auto text = IsOpenDrive(name) ? opendrive::LoadText(from_ / name) : base::ReadText(from_ / name, kMaxBytes);
    if (!text) text = base::ReadText(from_ / name, kMaxBytes);
    if (!text) return text.error();
    if (const auto there = base::ReadText(to_ / name, kMaxBytes); there && there.value() == text.value()) return {};
    fs::create_directories((to_ / name).parent_path(), problem);
    return base::WriteWhole(to_ / name, text.value());
  }

  fs::path from_, to_;
  std::set<fs::path> done_;
};

}  // namespace

base::Result<std::vector<fs::path>> CopyNamed(const fs::path& world_file, const fs::path& folder) {
  const auto file = config::File::Load(world_file);
  if (!file) return file.error();
  Copier copier(fs::absolute(world_file).parent_path(), folder);
  if (auto copied = copier.NamesOf(file.value(), ""); !copied) return copied.error();
  return copier.copied();
}

base::Status BeginLogical(const fs::path& folder) {
  std::error_code problem;
  fs::create_directories(folder, problem);
  if (!fs::is_directory(folder, problem))
    return base::WrongInput("file.not_folder", "this is no folder, and none can be made", folder.string());
  if (fs::exists(folder / kLogicalManifest, problem)) return {};
  return base::WriteWhole(folder / kLogicalManifest, fmt::format("{}\n", kLogicalKind));
}

base::Status WriteLogical(const fs::path& folder, base::Digest content_hash, std::vector<fs::path> files) {
  std::sort(files.begin(), files.end());
  std::string text = fmt::format("{}\ncontent_hash: {}\n", kLogicalKind, base::Hex(content_hash));
  for (const fs::path& name : files) {
    const auto bytes = base::ReadBytes(folder / name);
    if (!bytes) return bytes.error();
    text += fmt::format("{} {}\n", base::Hex(base::Hash(bytes.value())), name.generic_string());
  }
  return base::WriteWhole(folder / kLogicalManifest, std::string_view(text));
}

std::string LogicalContentHash(const fs::path& folder) {
  constexpr std::string_view kKey = "\ncontent_hash: ";
  const auto text = base::ReadText(folder / kLogicalManifest);
  const std::size_t at = text ? text.value().find(kKey) : std::string::npos;
  if (at == std::string::npos) return "";
  const std::size_t begin = at + kKey.size();
  return text.value().substr(begin, text.value().find('\n', begin) - begin);
}

std::vector<base::Error> LogicalProblems(const fs::path& folder) {
  const auto text = base::ReadText(folder / kLogicalManifest);
  if (!text)
    return {base::WrongInput(
        "world.built_file_missing",
        fmt::format("there is no '{}'; a folder that `rodeira world build` wrote was expected", kLogicalManifest),
        folder.string())};
  std::vector<base::Error> problems;
  std::istringstream lines(text.value());
  std::string line;
  std::getline(lines, line);
  if (line != kLogicalKind)
    return {base::WrongInput("world.wrong_manifest",
                             fmt::format("the first line is '{}'; '{}' was expected", line, kLogicalKind),
                             (folder / kLogicalManifest).string())};
  if (!std::getline(lines, line))  // the content hash
    return {base::WrongInput("world.built_file_missing",
                             "the build of this folder did not end; `rodeira world build` writes it again",
                             folder.string())};
  while (std::getline(lines, line)) {
    const std::size_t gap = line.find(' ');
    const fs::path name(gap == std::string::npos ? "" : line.substr(gap + 1));
    if (name.empty() || name.is_absolute()) {
      problems.push_back(base::WrongInput("world.wrong_manifest",
                                          fmt::format("the line '{}' names no file with its hash", line),
                                          (folder / kLogicalManifest).string()));
      continue;
    }
    const auto bytes = base::ReadBytes(folder / name);
    if (!bytes)
      problems.push_back(base::WrongInput("world.built_file_missing", "this file of the built world is missing",
                                          (folder / name).string()));
    else if (base::Hex(base::Hash(bytes.value())) != line.substr(0, gap))
      problems.push_back(base::WrongInput("world.built_file_changed",
                                          "this file of the built world is not as it was written",
                                          (folder / name).string()));
  }
  return problems;
}

}  // namespace rodeira::road
