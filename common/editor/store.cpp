// SPDX-License-Identifier: Apache-2.0
#include "common/editor/store.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <system_error>

#include "common/core/base/files.hpp"
#include "common/core/base/put_in_place.hpp"
#include "common/world/traffic_map/companion_text.hpp"

namespace rodeira::editor {
namespace {

constexpr std::size_t kMaxCompanionBytes = 16u << 20;

}  // namespace

std::filesystem::path CompanionPath(const std::filesystem::path& map_file) { return map_file.string() + ".yaml"; }

base::Result<Opened> Open(const std::filesystem::path& map_file) {
  auto file = traffic_map::LoadMap(map_file);
  if (!file) return file.error();
  Opened opened;
  opened.document.map = std::move(file).value();
  const std::filesystem::path beside = CompanionPath(map_file);
  std::error_code problem;
  if (!std::filesystem::exists(beside, problem)) return opened;
  auto text = base::ReadText(beside, kMaxCompanionBytes);
  if (!text) return text.error();
  const auto heights = traffic_map::ParseHeights(text.value(), beside);
  if (!heights) return heights.error();
  opened.document.companion = heights.value();
  opened.companion = {heights.value(), std::move(text).value()};
  return opened;
}

base::Result<LoadedCompanion> Save(const Document& document, const LoadedCompanion& loaded,
                                   const std::filesystem::path& map_file) {
  const std::filesystem::path beside = CompanionPath(map_file);
  const std::string tail = fmt::format(".{}.new", ::getpid());
  const std::filesystem::path new_map = map_file.string() + tail, new_beside = beside.string() + tail;
  std::error_code ignored;
  const auto clean = [&] { std::filesystem::remove(new_map, ignored), std::filesystem::remove(new_beside, ignored); };
  const auto fail = [&](const base::Error& error) {
    clean();
    return error.WithContext(map_file.string());
  };
  const std::string text = traffic_map::CompanionText(document.companion, loaded.value, loaded.text);
  if (!text.empty()) {
    // Nothing is written that could not be read again.
    const auto again = traffic_map::ParseHeights(text, beside);
    if (!again)
      return fail(base::Failed(again.error().id, "the companion file would not be readable: " + again.error().message));
    if (auto status = base::WriteWhole(new_beside, text); !status) return fail(status.error());
  }
  if (auto status = traffic_map::SaveMap(document.map, new_map); !status) return fail(status.error());
  if (!text.empty()) {
    if (auto status = base::PutInPlace(new_beside, beside); !status) return fail(status.error());
  }
  if (auto status = base::PutInPlace(new_map, map_file); !status) return fail(status.error());
  if (text.empty()) std::filesystem::remove(beside, ignored);  // another map's
  return LoadedCompanion{document.companion, text};
}

}  // namespace rodeira::editor
