#pragma once

#include <cstdint>
#include <string>

namespace rodeira::front {

// "871 B", "12.3 kB", "4.5 MB", "1.2 GB".
std::string Size(std::uint64_t bytes);

}  // namespace rodeira::front
