// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "common/core/config/schema.hpp"

namespace rodeira::measures {

// The keys of `rodeira: measures/1`.
const config::Schema& MeasuresSchema();

}  // namespace rodeira::measures
