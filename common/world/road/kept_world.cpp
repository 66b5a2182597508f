// SPDX-License-Identifier: Apache-2.0
#include "common/world/road/kept_world.hpp"

#include <algorithm>
#include <mutex>
#include <utility>
#include <vector>

namespace rodeira::road {
namespace {

std::mutex& Lock() {
  static std::mutex lock;
  return lock;
}

std::vector<const KeptWorld*>& All() {
  static std::vector<const KeptWorld*> all;
  return all;
}

}  // namespace

KeptWorld::KeptWorld(std::filesystem::path file, std::shared_ptr<const World> world)
    : file_(std::move(file)), world_(std::move(world)) {
  const std::lock_guard lock(Lock());
  All().push_back(this);
}

KeptWorld::~KeptWorld() {
  const std::lock_guard lock(Lock());
  std::erase(All(), this);
}

std::shared_ptr<const World> KeptWorld::Find(const std::filesystem::path& file) {
  const std::lock_guard lock(Lock());
  for (const KeptWorld* kept : All()) {
    if (kept->file_ == file) return kept->world_;
  }
  return nullptr;
}

}  // namespace rodeira::road
