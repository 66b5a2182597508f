// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

namespace rodeira::report {

// The text within HTML, between tags or within an attribute's quotes: markup in it is shown and not obeyed. Control
// characters become spaces.
std::string Html(std::string_view text);

}  // namespace rodeira::report
