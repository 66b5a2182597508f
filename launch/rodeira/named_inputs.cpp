// SPDX-License-Identifier: Apache-2.0
#include "launch/rodeira/named_inputs.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>

#include "common/core/config/config.hpp"
#include "common/core/config/quoted.hpp"

namespace rodeira::cli {
namespace {

namespace fs = std::filesystem;

// Nothing: the key's value is the file of no kind that has names.
std::optional<InputKind> KindOf(std::string_view key) {
  constexpr std::string_view kNodes = "nodes.", kVehicle = ".config.vehicle";
  if (key == "world") return InputKind::kWorld;
  if (key.starts_with(kNodes) && key.ends_with(kVehicle) && key.size() > kNodes.size() + kVehicle.size())
    return InputKind::kVehicle;
  return std::nullopt;
}

// Whether the node that a key `nodes.NODE.config.vehicle` names has a vehicle, as far as can be told.
bool MayHaveVehicle(std::string_view key, const launch::Overrides& overrides, const fs::path& launch_file) {
  constexpr std::string_view kNodes = "nodes.";
  const std::string node(key.substr(kNodes.size(), key.find('.', kNodes.size()) - kNodes.size()));
  std::string kind;
  if (const auto file = config::File::Load(launch_file))
    kind = file.value().root().Peek({"nodes", node, "kind"}).value_or("");
  for (const auto& [other, value] : overrides) {
    if (other == fmt::format("nodes.{}.kind", node)) kind = value;
  }
  return kind.empty() || kind == "vehicle" || kind == "input" || kind == "external";
}

// Words with a meaning of their own in YAML are no names: null, quoted texts, lists, mappings.
bool CanBeName(const std::string& value) {
  return !value.empty() && value != "null" && value.find_first_of("~\"'{}[],:#&*!|>%@` \n") == std::string::npos;
}

// Below the current directory: a relative path, which WithFilesFromHere resolves against the launch file's folder.
std::string FromHere(const std::string& file) {
  std::error_code problem;
  const fs::path relative = fs::path(file).lexically_relative(fs::current_path(problem));
  return relative.empty() || *relative.begin() == ".." ? file : relative.string();
}

}  // namespace

base::Result<launch::Overrides> WithNamedInputs(const launch::Overrides& overrides, const fs::path& launch_file,
                                                const char* option, const std::vector<InputFolder>& folders) {
  launch::Overrides renamed = overrides;
  std::error_code problem;
  for (auto& [key, value] : renamed) {
    const auto kind = KindOf(key);
    if (!kind || (*kind == InputKind::kVehicle && !MayHaveVehicle(key, overrides, launch_file))) continue;
    if (!CanBeName(value) || fs::is_regular_file(value, problem) ||
        fs::exists(launch_file.parent_path() / value, problem))
      continue;
    const auto file = ResolveInputFile(*kind, value, folders);
    if (!file) return file.error().WithContext(fmt::format("{} {}={}", option, key, value));
    if (file.value() == value) continue;
    const std::string path = FromHere(file.value());
    value = fs::path(path).is_absolute() ? config::Quoted(path) : path;
  }
  return renamed;
}

}  // namespace rodeira::cli
