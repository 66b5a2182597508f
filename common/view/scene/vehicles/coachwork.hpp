// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "common/view/scene/vehicles/car_mesh.hpp"

namespace rodeira::scene {

// Vans, lorries and buses, of flat sheets and large panes. Every part is a closed surface.
CarMeshes BuildVan(const CarShape& shape, Colour paint);
CarMeshes BuildLorry(const CarShape& shape, Colour paint);
CarMeshes BuildBus(const CarShape& shape, Colour paint);

// The wheels of any vehicle.
void AddWheel(const CarShape& shape, CarMeshes& car);

}  // namespace rodeira::scene
