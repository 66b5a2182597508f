// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace rodeira::base {

// A text as it stands in an XML file, in an element or between double quotes.
inline std::string XmlText(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if (c == '<')
      out += "&lt;";
    else if (c == '&')
      out += "&amp;";
    else if (c == '"')
      out += "&quot;";
    else
      out += c;
  }
  return out;
}

}  // namespace rodeira::base
