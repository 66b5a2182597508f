#include "launch/recording_text.hpp"

#include <fmt/format.h>

namespace rodeira::front {

std::string Size(std::uint64_t bytes) {
  const auto size = static_cast<double>(bytes);
  if (bytes < 1000) return fmt::format("{} B", bytes);
  if (bytes < 1'000'000) return fmt::format("{:.1f} kB", size * 1e-3);
  if (bytes < 1'000'000'000) return fmt::format("{:.1f} MB", size * 1e-6);
  return fmt::format("{:.2f} GB", size * 1e-9);
}

}  // namespace rodeira::front
