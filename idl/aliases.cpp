// SPDX-License-Identifier: Apache-2.0
#include "idl/aliases.hpp"

namespace rodeira::idl {

const decode::Aliases& Aliases() {
  static const decode::Aliases kAliases{.topics = {{"rodeira/wall", "rodeira/wall_time"}},
                                        .types = {{"rodeira::msg::Header", "rodeira::msg::SampleHeader"},
                                                  {"rodeira::msg::Collision", "rodeira::msg::Contact"}},
                                        .members = {{{"rodeira::msg::Collisions", "collisions"}, "contacts"},
                                                    {{"rodeira::msg::Contact", "impulse_x_ns"}, "impulse_x_newton_s"},
                                                    {{"rodeira::msg::Contact", "impulse_y_ns"}, "impulse_y_newton_s"},
                                                    {{"rodeira::msg::Contact", "impulse_z_ns"}, "impulse_z_newton_s"},
                                                    {{"rodeira::msg::Contact", "depth_m"}, "penetration_m"},
                                                    {{"rodeira::msg::Contact", "closing_mps"}, "closing_speed_mps"},
                                                    {{"rodeira::msg::Contact", "partner"}, "partner_kind"},
                                                    {{"rodeira::msg::VehicleState", "fuel_kg"}, "fuel_used_kg"}}};
  return kAliases;
}

}  // namespace rodeira::idl
