// SPDX-License-Identifier: Apache-2.0
#include "common/core/base/append_format.hpp"

#include <iterator>

namespace rodeira::base {

void AppendFormatted(std::string& out, fmt::string_view text, fmt::format_args arguments) {
  fmt::vformat_to(std::back_inserter(out), text, arguments);
}

}  // namespace rodeira::base
