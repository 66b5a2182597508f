// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace rodeira {

// The folder of the sources and of the build that a test or benchmark belongs to: said in one object file, so that what
// is compiled in one folder serves, through a compiler cache, in all others.
const std::string& SourceDir();
const std::string& BinaryDir();

}  // namespace rodeira
