// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "tests/property/mutate.hpp"

namespace rodeira::property {

// One change that leaves a YAML text well-formed: a part taken out, said twice, put in the place of another or swapped
// with it; a key under the name of another; a value from elsewhere in the file, at an edge, or of another kind. What is
// no YAML stays as it is.
void MutateStructure(std::string& yaml, Draw& draw);

}  // namespace rodeira::property
