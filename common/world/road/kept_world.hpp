// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <memory>

#include "common/world/road/world.hpp"

namespace rodeira::road {

// While it lives, World::Load of `file` gives `world`, and reads no file: for nodes of one process that are made again
// and again. The path counts as it is written. Any thread.
class KeptWorld {
 public:
  KeptWorld(std::filesystem::path file, std::shared_ptr<const World> world);
  ~KeptWorld();
  KeptWorld(const KeptWorld&) = delete;
  KeptWorld& operator=(const KeptWorld&) = delete;

  // Null where none is kept.
  static std::shared_ptr<const World> Find(const std::filesystem::path& file);

 private:
  std::filesystem::path file_;
  std::shared_ptr<const World> world_;
};

}  // namespace rodeira::road
