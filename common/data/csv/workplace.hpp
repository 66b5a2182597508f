// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <utility>

#include "common/core/base/result.hpp"

namespace rodeira::csv {

// A folder beside `target`, in which the tables are written. It or one of its files becomes `target` at the end;
// without that, all of it is removed.
class Workplace {
 public:
  explicit Workplace(std::filesystem::path target) : target_(std::move(target)) {}
  Workplace(const Workplace&) = delete;
  Workplace& operator=(const Workplace&) = delete;
  ~Workplace();

  // Wrong input where the target exists; failed where the folder cannot be made.
  base::Status Begin();
  // Puts the folder, or its file of that name, in the target's place.
  base::Status Finish(const std::string& name = {});
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path target_;
  std::filesystem::path path_;
};

}  // namespace rodeira::csv
