// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "common/world/network/furniture.hpp"

// Signs of other catalogues than the German one: by number in the United States (MUTCD, "R1-1"), in the United Kingdom
// (TSRGD, "601.1") and in China (GB 5768, "禁38"), and by the names of RoadRunner's models ("Sign_SpeedLimit_25", with
// the type -1).
namespace rodeira::network {

// What the numbers of a catalogue begin with, and the kind that they are.
struct CatalogueRow {
  std::string_view country, code, kind;
};
// All rows of the United States (US), the United Kingdom (GB) and China (CN); more particular ones first.
std::vector<CatalogueRow> CataloguesAbroad();

// Of the kinds of SignKindNames(); nothing: it is none of these. Capitals and small letters are the same.
std::optional<std::string_view> SignKindAbroad(const Signal& signal);
// The number at the end of a name of RoadRunner's; empty: none.
std::string NumberInName(const Signal& signal);

}  // namespace rodeira::network
