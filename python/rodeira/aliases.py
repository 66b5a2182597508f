# SPDX-License-Identifier: Apache-2.0
"""Today's names of what older recordings name otherwise; the same table as idl/aliases.cpp."""

from __future__ import annotations

from .idl_types import Array, Member, Plain, Sequence, Struct, Type

TOPICS = {"rodeira/wall": "rodeira/wall_time"}
TYPES = {"rodeira::msg::Header": "rodeira::msg::SampleHeader", "rodeira::msg::Collision": "rodeira::msg::Contact"}
MEMBERS = {  # by today's name of the type
    ("rodeira::msg::Collisions", "collisions"): "contacts",
    ("rodeira::msg::Contact", "impulse_x_ns"): "impulse_x_newton_s",
    ("rodeira::msg::Contact", "impulse_y_ns"): "impulse_y_newton_s",
    ("rodeira::msg::Contact", "impulse_z_ns"): "impulse_z_newton_s",
    ("rodeira::msg::Contact", "depth_m"): "penetration_m",
    ("rodeira::msg::Contact", "closing_mps"): "closing_speed_mps",
    ("rodeira::msg::Contact", "partner"): "partner_kind",
    ("rodeira::msg::VehicleState", "fuel_kg"): "fuel_used_kg",
}


def renamed(kind: Type) -> Type:
    """The type with today's names, also in the types that it uses; its encoding is the same."""
    if isinstance(kind, Struct):
        name = TYPES.get(kind.name, kind.name)
        return Struct(name, tuple(Member(MEMBERS.get((name, m.name), m.name), renamed(m.type), m.unit)
                                  for m in kind.members))
    if isinstance(kind, Array):
        return Array(renamed(kind.element), kind.length)
    if isinstance(kind, Sequence):
        return Sequence(renamed(kind.element), kind.bound)
    if isinstance(kind, Plain) and kind.enumerators:
        return Plain(kind.code, kind.size, kind.enumerators, TYPES.get(kind.name, kind.name))
    return kind
