# SPDX-License-Identifier: Apache-2.0
"""Columns of a type by path, 'wheels[2].load_n': their names, units and values."""

from __future__ import annotations

import re
from typing import Any

import numpy as np

from .errors import Error, did_you_mean
from .idl_types import OCTET, Array, Member, Plain, Sequence, Struct, Type
from .nodes import Node, Ragged

MAX_COLUMNS = 10_000  # of a topic
Path = tuple["str | int", ...]
_STEP = re.compile(r"(?:^|\.)([A-Za-z_]\w*)|\[(\d+)\]", re.ASCII)
_UNITS = (("_newton_s", "N s"), ("_radps2", "rad/s^2"), ("_radps", "rad/s"), ("_rad", "rad"), ("_deg", "deg"),
          ("_mps3", "m/s^3"), ("_mps2", "m/s^2"), ("_mps", "m/s"), ("_kmh", "km/h"), ("_mmph", "mm/h"),
          ("_kgps", "kg/s"), ("_kg", "kg"), ("_nm", "N m"), ("_ns", "ns"), ("_us", "us"), ("_ms", "ms"),
          ("_hz", "Hz"), ("_pa", "Pa"), ("_n", "N"), ("_m", "m"), ("_s", "s"))


def parse(path: str) -> Path | None:
    """The steps of a path: names and indexes; nothing if it is not a path."""
    steps: list[str | int] = []
    at = 0
    while at < len(path):
        match = _STEP.match(path, at)
        if match is None or (at == 0) != (match.group().startswith(("[", ".")) is False):
            return None
        steps.append(match.group(1) if match.group(1) is not None else int(match.group(2)))
        at = match.end()
    return tuple(steps) if steps else None


def unit_of_name(name: str) -> str:
    """'m/s' for 'speed_mps'; empty if the name has no unit. A frame's letter may stand within: 'velocity_w_mps'."""
    return next((unit for suffix, unit in _UNITS if name.endswith(suffix)), "")


def columns_of(kind: Struct) -> dict[str, str]:
    """Name and unit of each column, in the order of the members. An element of an array of numbers is a column."""
    found: dict[str, str] = {}
    _add_columns(kind, "", "", found)
    return found


def _add_columns(kind: Type, path: str, unit: str, found: dict[str, str]) -> None:
    if isinstance(kind, Sequence):
        if isinstance(kind.element, Struct):
            _add_columns(kind.element, path, unit, found)
        else:
            found[path] = unit
    elif isinstance(kind, Array) and kind.element != OCTET:
        for i in range(kind.length):
            _add_columns(kind.element, f"{path}[{i}]", unit, found)
    elif isinstance(kind, Struct):
        for member in kind.members:
            inner = f"{path}.{member.name}" if path else member.name
            _add_columns(member.type, inner, member.unit or unit_of_name(member.name) or unit, found)
    else:
        found[path] = unit


def resolve(kind: Struct, path: str, place: str) -> Path:
    """The steps of a column, or of a group of columns, of the type. Raises Error with the nearest name."""
    steps = parse(path)
    if steps is not None and _leads(kind, steps):
        return steps
    names = list(columns_of(kind))
    names += [name.split(".")[0].split("[")[0] for name in names] + [re.sub(r"\[\d+\]", "", name) for name in names]
    raise Error(f"{place}: unknown column '{path}'{did_you_mean(path, dict.fromkeys(names))}")


def _leads(kind: Type, steps: Path) -> bool:
    for position, step in enumerate(steps):
        if isinstance(step, int):
            if not isinstance(kind, Array) or step >= kind.length:
                return False
            kind = kind.element
            continue
        while isinstance(kind, (Array, Sequence)):  # a column of all elements
            kind = kind.element
            if any(isinstance(later, int) for later in steps[position + 1:]) and isinstance(kind, Array):
                return False
        member = member_of(kind, step)
        if member is None:
            return False
        kind = member.type
    return True


def member_of(kind: Type, name: str) -> Member | None:
    return next((m for m in kind.members if m.name == name), None) if isinstance(kind, Struct) else None


def pick(node: Node, steps: Path) -> Node:
    """The values of a path that `resolve` has found. Those of an array's elements get an axis more."""
    for position, step in enumerate(steps):
        if isinstance(node, Ragged):
            return Ragged(node.offsets, pick(node.values, steps[position:]))
        if isinstance(node, list):
            if isinstance(step, int):
                node = node[step]
                continue
            inner: list[Any] = [pick(one, steps[position:]) for one in node]
            return np.stack(inner, axis=1) if all(isinstance(one, np.ndarray) for one in inner) else inner
        if isinstance(node, dict):
            node = node[str(step)]
        else:
            assert isinstance(node, np.ndarray)
            node = node[:, step] if isinstance(step, int) else node[step]
    return node


