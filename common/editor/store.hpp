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
// together are no hindrance here.
base::Result<Opened> Open(const std::filesystem::path& map_file);

// Both files, each whole; where one of them cannot be written (a full disk) both stay as they were. Companion bytes
// that were loaded and not edited are written as they are; where there is nothing to say, and nothing was loaded, there
// is no companion afterwards. What was written of the companion comes back.
base::Result<LoadedCompanion> Save(const Document& document, const LoadedCompanion& loaded,
                                   const std::filesystem::path& map_file);

// Unsaved work, kept in a folder of the user's, so that it survives the editor. One keeper a running editor.
class Keeper {
 public:
  // `folder`: where all editors keep theirs; it is made. Failed where that cannot be.
  static base::Result<Keeper> Make(const std::filesystem::path& folder);
  Keeper(Keeper&& other) noexcept;
  Keeper& operator=(Keeper&&) = delete;
  ~Keeper();  // what it kept stays

  // The document as it is now; the picture is written only where `picture_state` is another one than before. `of` is
  // the file that it belongs to, which may be none.
  base::Status Keep(const Document& document, const std::filesystem::path& of, std::uint64_t picture_state);
  // Everything is saved, or given up: nothing is kept any more.
  void Forget();

  // What an editor that lives no more has kept, the oldest first.
  struct Left {
    std::filesystem::path folder;
    std::filesystem::path of;  // empty: it had no file yet
  };
  std::vector<Left> Found() const;
  // Wrong input where what lies there cannot be read.
  static base::Result<Opened> Restore(const Left& left);
  // What was kept is deleted.
  static void Discard(const Left& left);

 private:
  Keeper(std::filesystem::path all, std::filesystem::path own, int lock)
      : all_(std::move(all)), own_(std::move(own)), lock_(lock) {}

  std::filesystem::path all_, own_;
  int lock_ = -1;  // the open lock file of our own folder
  std::optional<std::uint64_t> picture_state_;
};

}  // namespace rodeira::editor
