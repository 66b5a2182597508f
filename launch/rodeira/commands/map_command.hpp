// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace rodeira::cli {

// `rodeira map check FILE.motors`, `rodeira map convert FILE.motors -o OUT.svg|OUT.xodr|OUT.yaml`
struct MapOptions {
  std::string command;  // check or convert
  std::string file;
  std::string out;
};

// Status 2 where the map has errors; warnings alone are told and hinder nothing.
int MapCommand(const MapOptions& options);

}  // namespace rodeira::cli
