// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace rodeira::cli {

// `rodeira schema [KIND] [--json | --markdown]`
struct SchemaOptions {
  std::string kind;  // empty: the kinds are listed
  bool json = false;
  bool markdown = false;
};

// Prints the keys of a kind of file: key, default, range and meaning. Status 2 for an unknown kind.
int PrintSchema(const SchemaOptions& options);

}  // namespace rodeira::cli
