// SPDX-License-Identifier: Apache-2.0
#include "launch/rodeira/input_files.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <system_error>

#include "common/core/base/files.hpp"
#include "common/core/base/installation.hpp"
#include "common/core/base/suggest.hpp"
#include "common/core/base/user_folders.hpp"

namespace rodeira::cli {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMaxTextBytes = 4u << 20;  // a larger file is not written by hand

struct KindTraits {
  const char* folder;
  const char* header;  // "world/" in the line `rodeira: world/2`
  const char* words;   // for messages
  std::vector<std::string> extensions;
};

const KindTraits& TraitsOf(InputKind kind) {
  static const KindTraits kLaunch{"launch", "launch/", "launch file", {".yaml"}};
  static const KindTraits kWorld{"configs/worlds", "world/", "world", {".yaml", ".xodr", ".xodrz"}};
  static const KindTraits kVehicle{"configs/vehicles", "vehicle/", "vehicle", {".yaml"}};
  switch (kind) {
    case InputKind::kLaunch:
      return kLaunch;
    case InputKind::kWorld:
      return kWorld;
    case InputKind::kVehicle:
      break;
  }
  return kVehicle;
}

std::vector<fs::path> EntriesOf(const fs::path& folder) {
  std::vector<fs::path> entries;
  std::error_code problem;
  for (fs::directory_iterator entry(folder, problem), end; !problem && entry != end; entry.increment(problem))
    entries.push_back(entry->path());
  std::sort(entries.begin(), entries.end());
  return entries;
}

std::vector<fs::path> FilesIn(const fs::path& folder, const KindTraits& traits) {
  std::vector<fs::path> files = EntriesOf(folder);
  std::error_code problem;
  std::erase_if(files, [&](const fs::path& file) {
    return std::ranges::find(traits.extensions, file.extension().string()) == traits.extensions.end() ||
           !fs::is_regular_file(file, problem);
  });
  return files;
}

// The rest of the first line that begins with `key`; empty if there is none.
std::string LineAfter(const fs::path& file, const std::string& key) {
  const auto text = base::ReadText(file, kMaxTextBytes);
  if (!text) return "";
  const std::string all = "\n" + text.value(), begin = "\n" + key;
  const std::size_t at = all.find(begin);
  return at == std::string::npos ? "" : all.substr(at + begin.size(), all.find('\n', at + 1) - at - begin.size());
}

bool IsOfKind(const fs::path& file, const KindTraits& traits) {
  if (file.extension() != ".yaml") return true;  // the extension says it
  return LineAfter(file, "rodeira:").find(std::string(" ") + traits.header) != std::string::npos;
}

// Files of one directory that are of the kind and not included by another one.
std::vector<fs::path> CompleteIn(const fs::path& folder, const KindTraits& traits) {
  std::vector<fs::path> files = FilesIn(folder, traits);
  std::erase_if(files, [&](const fs::path& file) { return !IsOfKind(file, traits); });
  std::string included;
  for (const fs::path& file : files) included += LineAfter(file, "include:");
  std::erase_if(files,
                [&](const fs::path& file) { return included.find(file.filename().string()) != std::string::npos; });
  return files;
}

std::vector<fs::path> FilesBelow(const fs::path& folder, const KindTraits& traits) {
  std::vector<fs::path> files = FilesIn(folder, traits);
  std::error_code problem;
  for (const fs::path& entry : EntriesOf(folder)) {
    if (!fs::is_directory(entry, problem)) continue;
    const std::vector<fs::path> more = CompleteIn(entry, traits);
    files.insert(files.end(), more.begin(), more.end());
  }
  return files;
}

std::string NameOf(const fs::path& file, const fs::path& folder) {
  fs::path name = file.lexically_relative(folder);
  if (name.extension() == ".yaml") name.replace_extension();
  return name.generic_string();
}

}  // namespace

std::vector<InputFolder> InputFolders() {
  std::vector<InputFolder> folders;
  std::set<fs::path> seen;
  std::error_code problem;
  const auto add = [&](const fs::path& path, const char* from) {
    const fs::path canonical = fs::weakly_canonical(path, problem);
    if (!path.empty() && fs::is_directory(path, problem) && seen.insert(canonical).second)
      folders.push_back({path, from});
  };
  const fs::path shared = base::SharedDataFolder();
  const fs::path here = fs::current_path(problem);
  if (fs::weakly_canonical(here, problem) != fs::weakly_canonical(shared, problem)) add(here, "here");
  add(base::UserDataFolder(), "yours");
  add(shared, "Rodeira");
  return folders;
}

std::vector<InputFile> FindInputFiles(InputKind kind, const std::vector<InputFolder>& folders) {
  const KindTraits& traits = TraitsOf(kind);
  std::vector<InputFile> files;
  for (const InputFolder& folder : folders) {
    const fs::path own = folder.path / traits.folder;
    for (const fs::path& path : FilesBelow(own, traits)) files.push_back({NameOf(path, own), path, folder.from});
    for (const fs::path& path : CompleteIn(folder.path, traits))
      files.push_back({NameOf(path, folder.path), path, folder.from});
  }
  return files;
}

base::Result<std::string> ResolveInputFile(InputKind kind, const std::string& text,
                                           const std::vector<InputFolder>& folders) {
  std::error_code problem;
  const fs::path named(text);
  if (text.empty() || named.is_absolute() || fs::exists(named, problem)) return text;
  const KindTraits& traits = TraitsOf(kind);
  for (const InputFolder& folder : folders) {
    for (const fs::path& own : {folder.path / traits.folder / named, folder.path / named}) {
      for (const std::string& extension : traits.extensions) {
        if (own.extension() == extension && fs::is_regular_file(own, problem)) return own.string();
        if (fs::is_regular_file(own.string() + extension, problem)) return own.string() + extension;
      }
    }
  }
  if (named.has_extension() || named.has_parent_path()) return text;
  std::vector<std::string> names;
  for (const InputFile& file : FindInputFiles(kind, folders)) names.push_back(file.name);
  return base::WrongInput(
      "file.not_found",
      fmt::format("no such file, and no {} has this name{}", traits.words, base::DidYouMean(text, names)), text);
}

std::string ListInputFiles(InputKind kind, const std::vector<InputFolder>& folders) {
  const std::vector<InputFile> files = FindInputFiles(kind, folders);
  if (files.empty()) return fmt::format("no {} was found\n", TraitsOf(kind).words);
  std::size_t name_width = 4, from_width = 4;
  for (const InputFile& file : files) {
    name_width = std::max(name_width, file.name.size());
    from_width = std::max(from_width, file.from.size());
  }
  std::string table = fmt::format("{:<{}}  {:<{}}  file\n", "name", name_width, "from", from_width);
  for (const InputFile& file : files)
    table += fmt::format("{:<{}}  {:<{}}  {}\n", file.name, name_width, file.from, from_width, file.path.string());
  return table;
}

}  // namespace rodeira::cli
