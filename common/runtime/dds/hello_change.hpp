// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <vector>

#include "common/core/base/hash.hpp"
#include "idl/topic_types.hpp"

namespace rodeira::dds {

// What the programs of tests say instead of the truth in every later OwnHello of their process, so that they are
// refused. Nothing in Rodeira sets it, and no environment variable or option does.
struct HelloChange {
  std::function<void(std::vector<idl::TopicText>&)> type;
  base::Digest mathematics = 0;  // 0: the truth
};
// Set it before the first node is opened; it is not guarded by a lock.
HelloChange& ChangeOfHellos();

}  // namespace rodeira::dds
