// SPDX-License-Identifier: Apache-2.0
#include "common/runtime/launch/files_of.hpp"

#include <fmt/format.h>

#include <cctype>
#include <set>
#include <span>
#include <string_view>
#include <system_error>

#include "common/core/base/files.hpp"
#include "common/core/config/quoted.hpp"
#include "idl/idl_source.hpp"

namespace rodeira::launch {
namespace {

namespace fs = std::filesystem;
constexpr std::uintmax_t kMaxBytes = 64u << 20;
const std::string kAbsolute = "absolute";
constexpr std::size_t kMaxUp = 8;  // how often a name may go up from the launch file's folder

// Where the launch file lies among files that were laid out: deep enough for names that go up.
fs::path HomeIn(const fs::path& root) {
  fs::path home = root;
  for (std::size_t i = 0; i < kMaxUp; ++i) home /= "d";
  return home;
}

bool IsPartOfAPath(char c) {
  return std::isalnum(static_cast<unsigned char>(c)) != 0 ||
         std::string_view("/._-~+").find(c) != std::string_view::npos;
}

// Each whole path that is `path` becomes `name`.
void Rename(std::string& text, const std::string& path, const std::string& name) {
  for (std::size_t at = text.find(path); at != std::string::npos; at = text.find(path, at)) {
    const std::size_t end = at + path.size();
    const bool is_whole =
        (at == 0 || !IsPartOfAPath(text[at - 1])) && (end == text.size() || !IsPartOfAPath(text[end]));
    if (is_whole) text.replace(at, path.size(), name);
    at += is_whole ? name.size() : path.size();
  }
}

// The launch file, with files that it names by their whole path named where they are laid out: what lies on the disk
// may be another one by now.
base::Bytes Led(const std::vector<NamedFile>& files) {
  const base::Bytes& bytes = files.front().bytes;
  std::string text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  for (const NamedFile& file : files) {
    if (file.name.starts_with(kAbsolute + "/")) Rename(text, file.name.substr(kAbsolute.size()), file.name);
  }
  const auto as_bytes = std::as_bytes(std::span(text));
  return {as_bytes.begin(), as_bytes.end()};
}

class Collector {
 public:
  explicit Collector(const Launch& launch) : home_(fs::absolute(launch.path()).parent_path().lexically_normal()) {
    for (const LaunchNode& node : launch.nodes()) {
      if (node.is_external()) outputs_.insert({node.kind->program, node.kind->library});  // programs are not embedded
      if (node.kind->name != "recorder") continue;
      if (const auto file = node.config->Peek({"config", "file"}))
        outputs_.insert(fs::absolute(launch.path().parent_path() / *file).lexically_normal());
    }
  }

  base::Status Add(const fs::path& path, const config::File& file) {
    if (auto status = Take(path, false); !status) return status;
    return Follow(path, file, false);
  }
  std::vector<NamedFile> files() && { return std::move(files_); }

 private:
  // `absolute`: the file was named by its whole path, or by another that was.
  base::Status Take(const fs::path& path, bool absolute) {
    std::string name = absolute ? kAbsolute + path.generic_string() : path.lexically_relative(home_).generic_string();
    if (!seen_.insert(name).second) return {};
    auto bytes = base::ReadBytes(path);
    if (!bytes) return bytes.error();
    files_.push_back({std::move(name), std::move(bytes).value()});
    return {};
  }
  bool Seen(const fs::path& path, bool absolute) const {
    return seen_.contains(absolute ? kAbsolute + path.generic_string()
                                   : path.lexically_relative(home_).generic_string());
  }
  base::Status Follow(const fs::path& path, const config::File& file, bool from_absolute) {
    for (const std::string& scalar : file.Scalars()) {
      if (scalar.size() > 1000 || !fs::path(scalar).has_extension())
        continue;  // a plain word is a name, even where a file is called so
      const bool absolute = from_absolute || fs::path(scalar).is_absolute();
      const fs::path named = fs::absolute(path.parent_path() / scalar).lexically_normal();
      std::error_code problem;
      if (Seen(named, absolute) || outputs_.contains(named) || !fs::is_regular_file(named, problem) ||
          fs::file_size(named, problem) > kMaxBytes)
        continue;
      if (auto status = Take(named, absolute); !status) return status;
      if (named.extension() == ".idl") {
        if (auto status = FollowIdl(named, absolute); !status) return status;
        continue;
      }
      if (named.extension() != ".yaml" && named.extension() != ".yml") {
        // A raster's projection and a picture's place stand beside it.
        for (const char* extension :
             {".prj", ".wld", ".jgw", ".jpgw", ".pgw", ".pngw", ".bpw", ".bmpw", ".tfw", ".tifw"}) {
          const fs::path beside = fs::path(named).replace_extension(extension);
          if (!fs::is_regular_file(beside, problem)) continue;
          if (auto status = Take(beside, absolute); !status) return status;
        }
        continue;
      }
      const auto inner = config::File::Load(named);
      if (!inner) continue;  // its reader says what is wrong
      if (auto status = Follow(named, inner.value(), absolute); !status) return status;
    }
    return {};
  }

  // Files that an IDL file includes; Rodeira's own are not beside it.
  base::Status FollowIdl(const fs::path& path, bool absolute) {
    const auto text = base::ReadText(path);
    if (!text) return text.error();
    for (const std::string& name : idl::IncludesOf(text.value())) {
      const fs::path included = (path.parent_path() / name).lexically_normal();
      std::error_code problem;
      if (Seen(included, absolute) || !fs::is_regular_file(included, problem)) continue;
      if (auto status = Take(included, absolute); !status) return status;
      if (auto status = FollowIdl(included, absolute); !status) return status;
    }
    return {};
  }

  fs::path home_;
  std::set<fs::path> outputs_;
  std::set<std::string> seen_;  // names
  std::vector<NamedFile> files_;
};

}  // namespace

base::Result<std::vector<NamedFile>> FilesOf(const Launch& launch) {
  Collector collector(launch);
  if (auto status = collector.Add(fs::absolute(launch.path()).lexically_normal(), launch.file()); !status)
    return status.error();
  return std::move(collector).files();
}

base::Result<fs::path> LayOut(const std::vector<NamedFile>& files, const fs::path& folder) {
  if (files.empty()) return base::WrongInput("recording.file_missing", "there is no launch file");
  const fs::path root = folder.lexically_normal();
  const fs::path home = HomeIn(root);
  const base::Bytes launch_file = Led(files);
  for (const NamedFile& file : files) {
    const fs::path name(file.name);
    const fs::path target = (home / name).lexically_normal();
    const fs::path within = target.lexically_relative(root);
    if (file.name.empty() || name.is_absolute() || within.empty() || *within.begin() == "..") {
      return base::WrongInput("recording.wrong_file_name",
                              fmt::format("the name '{}' leads out of the recorded files", file.name));
    }
    std::error_code problem;
    fs::create_directories(target.parent_path(), problem);
    if (problem)
      return base::Failed("file.cannot_make_folder", fmt::format("the folder cannot be made: {}", problem.message()),
                          target.parent_path().string());
    if (auto status = base::WriteWhole(target, &file == &files.front() ? launch_file : file.bytes); !status)
      return status.error();
  }
  return (home / files.front().name).lexically_normal();
}

std::string LaidOut(const std::string& value, const fs::path& launch_file) {
  const fs::path path(config::Unquoted(value).value_or(value));
  if (!path.is_absolute()) return value;
  const fs::path copy = launch_file.parent_path() / (kAbsolute + path.generic_string());
  std::error_code problem;
  return fs::is_regular_file(copy, problem) ? config::Quoted(copy.string()) : value;
}

std::string WithNames(std::string text, const fs::path& folder) {
  const fs::path root = folder.lexically_normal();
  std::string up;
  for (fs::path level = HomeIn(root);; level = level.parent_path(), up += "../") {
    const std::string start = level.string() + "/";
    for (std::size_t at = text.find(start); at != std::string::npos; at = text.find(start, at + up.size()))
      text.replace(at, start.size(), up);
    if (level == root) return text;
  }
}

}  // namespace rodeira::launch
