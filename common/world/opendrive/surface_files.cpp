// SPDX-License-Identifier: Apache-2.0
#include "common/world/opendrive/surface_files.hpp"

#include "common/core/base/files.hpp"

namespace rodeira::opendrive {

const base::Result<surface::CrgFile>& SurfaceFiles::Read(const std::string& name) {
  const auto found = files_.find(name);
  return found != files_.end() ? found->second : files_.emplace(name, surface::LoadCrg(folder_ / name)).first->second;
}

std::string SurfaceFiles::WhyMissing(const std::string& name) const { return base::NoSuchFile(folder_ / name); }

}  // namespace rodeira::opendrive
