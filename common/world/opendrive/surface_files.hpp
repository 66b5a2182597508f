// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <utility>

#include "common/core/base/result.hpp"
#include "common/world/surface/crg_file.hpp"

namespace rodeira::opendrive {

// The measured surfaces (OpenCRG) that an OpenDRIVE file names, each read once.
class SurfaceFiles {
 public:
  // folder: the OpenDRIVE file's.
  explicit SurfaceFiles(std::filesystem::path folder) : folder_(std::move(folder)) {}

  // By its name in the OpenDRIVE file. The result stays until this object ends.
  const base::Result<surface::CrgFile>& Read(const std::string& name);
  // "there is no such file ..."; empty: it is there.
  std::string WhyMissing(const std::string& name) const;

 private:
  std::filesystem::path folder_;
  std::map<std::string, base::Result<surface::CrgFile>> files_;  // by name
};

}  // namespace rodeira::opendrive
