// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "common/core/base/result.hpp"
#include "common/editor/document.hpp"

namespace rodeira::editor {

// FILE.motors.yaml beside FILE.motors.
std::filesystem::path CompanionPath(const std::filesystem::path& map_file);

// Both files of a map.
struct Opened {
  Document document;
  LoadedCompanion companion;
};
// A map and its companion. Wrong input as traffic_map::LoadMap and traffic_map::LoadHeightsOf; numbers that do not fit
// together are accepted here.
base::Result<Opened> Open(const std::filesystem::path& map_file);

// Writes both files atomically; where one of them cannot be written (a full disk) both stay as they were. Companion
// bytes that were loaded and not edited are written unchanged. An empty companion that was not loaded is not written.
// Returns the companion as written.
base::Result<LoadedCompanion> Save(const Document& document, const LoadedCompanion& loaded,
                                   const std::filesystem::path& map_file);

// Autosave: unsaved work, kept in a folder of the user, survives a crash. One keeper per running editor.
class Keeper {
 public:
  // `folder`: the autosave folder of all editors; it is created. Failed where it cannot be created.
  static base::Result<Keeper> Make(const std::filesystem::path& folder);
  Keeper(Keeper&& other) noexcept;
  Keeper& operator=(Keeper&&) = delete;
  ~Keeper();  // does not delete kept work

  // Keeps the document as it is now; the picture is written only when `picture_state` has changed. `of` is the map
  // file; empty if the document has none.
  base::Status Keep(const Document& document, const std::filesystem::path& of, std::uint64_t picture_state);
  // Deletes this editor's kept work, once it is saved or discarded.
  void Forget();

  // Work kept by editors that have ended without saving, the oldest first.
  struct Left {
    std::filesystem::path folder;
    std::filesystem::path of;  // empty: it had no file yet
  };
  std::vector<Left> Found() const;
  // Reads kept work. Wrong input where it cannot be read.
  static base::Result<Opened> Restore(const Left& left);
  // Deletes kept work.
  static void Discard(const Left& left);

 private:
  Keeper(std::filesystem::path all, std::filesystem::path own, int lock)
      : all_(std::move(all)), own_(std::move(own)), lock_(lock) {}

  std::filesystem::path all_, own_;
  int lock_ = -1;  // the open lock file of our own folder
  std::optional<std::uint64_t> picture_state_;
};

}  // namespace rodeira::editor
