// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "common/core/config/schema.hpp"

namespace rodeira::design {

// The keys of a material, of a painted line, of a cross-section, and of a template, which is one without `template`.
const std::vector<config::Key>& MaterialKeys();
const std::vector<config::Key>& LineKeys();
const std::vector<config::Key>& SectionKeys();
const std::vector<config::Key>& TemplateKeys();

}  // namespace rodeira::design
