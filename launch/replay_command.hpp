#pragma once

#include <optional>
#include <string>

namespace rodeira::front {

struct ReplayOptions {
  std::string file;
  bool verify = false;
  std::optional<double> from_s;
  bool quiet = false;
};

// `rodeira replay`: exit status 0, 1 where a verification found a difference, 2 for wrong input.
int Replay(const ReplayOptions& options);

}  // namespace rodeira::front
