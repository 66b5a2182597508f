// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <string_view>
#include <vector>

#include "common/core/base/assert.hpp"
#include "idl/topic_types.hpp"

namespace rodeira::system_test {

// "TOPIC|OLD|NEW": the text of the topic's type has NEW where it had OLD.
inline void ChangeType(std::string_view change, std::vector<idl::TopicText>& topics) {
  const std::size_t first = change.find('|');
  const std::size_t second = change.find('|', first + 1);
  RODEIRA_ASSERT(second != std::string_view::npos);
  const std::string_view old = change.substr(first + 1, second - first - 1);
  for (idl::TopicText& text : topics) {
    const std::size_t at = text.idl.find(old);
    if (text.topic == change.substr(0, first) && at != std::string::npos)
      text.idl.replace(at, old.size(), change.substr(second + 1));
  }
}

}  // namespace rodeira::system_test
