// SPDX-License-Identifier: Apache-2.0
#include "common/core/base/huge_pages.hpp"

#include <sys/mman.h>

#include <cstdint>

namespace rodeira::base {
namespace {

constexpr std::uintptr_t kHugePage = 2 << 20;
constexpr int kCollapse =
    25;  // MADV_COLLAPSE (Linux 6.1), which Debian 12's headers do not have: at once, for pages in use already

}  // namespace

void PreferHugePages(const void* begin, std::size_t bytes) {
  const auto address = reinterpret_cast<std::uintptr_t>(begin);
  const std::uintptr_t first = (address + kHugePage - 1) / kHugePage * kHugePage,
                       last = (address + bytes) / kHugePage * kHugePage;
  if (last <= first) return;
  void* pages = reinterpret_cast<void*>(first);
  if (::madvise(pages, last - first, MADV_HUGEPAGE) == 0) (void)::madvise(pages, last - first, kCollapse);
}

}  // namespace rodeira::base
