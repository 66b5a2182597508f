// SPDX-License-Identifier: Apache-2.0
#include "nodes/view/headset/headset.hpp"

namespace rodeira::nodes {

base::Result<std::unique_ptr<Headset>> Headset::Open(Quality) {
  return base::WrongInput("view.no_openxr",
                          "this Rodeira was built without OpenXR (package libopenxr-dev, CMake's RODEIRA_OPENXR)");
}

}  // namespace rodeira::nodes
