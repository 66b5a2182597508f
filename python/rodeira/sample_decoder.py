# SPDX-License-Identifier: Apache-2.0
"""One CDR message to values, in a few microseconds: for samples that are used one at a time (`rodeira.Env`). Whole
topics of recordings are decoded by `decode`."""

from __future__ import annotations

import struct
from typing import Any, NamedTuple

import numpy as np

from .decode import ENCAPSULATION
from .idl_types import Array, Plain, Sequence, Struct, Text, Type
from .layout import Layouts
from .mcap import gather


class _Places(NamedTuple):
    """Of a sequence's elements: rows and their bytes, by how they are laid out, and the size of all together."""
    groups: list[tuple[np.ndarray, np.ndarray, np.dtype]]
    size: int


class SampleDecoder:
    """Decodes little-endian messages that Rodeira has made; one that is cut short raises ValueError or struct.error.

    A structure without texts and sequences is a record, any other one a dict. A sequence of numbers or records is an
    array, any other one a list.
    """

    def __init__(self, kind: Struct, layouts: Layouts) -> None:
        self.kind = kind
        self._layouts = layouts
        self._places: dict[tuple[int, int, int], _Places] = {}

    def decode(self, payload: bytes) -> Any:
        return self._value(self.kind, memoryview(payload)[ENCAPSULATION:], 0)[0]

    # Each gives the value and the place behind it.
    def _value(self, kind: Type, data: memoryview, at: int) -> tuple[Any, int]:
        layouts = self._layouts
        if layouts.is_fixed(kind):
            at += -at % layouts.alignment(kind)
            dtype = layouts.dtype(kind, at & 7)
            return np.frombuffer(data, dtype, 1, at)[0], at + dtype.itemsize
        if isinstance(kind, Struct):
            members: dict[str, Any] = {}
            for member in kind.members:
                members[member.name], at = self._value(member.type, data, at)
            return members, at
        if isinstance(kind, Array):
            return self._list(kind.element, kind.length, data, at)
        at += -at % 4
        count = struct.unpack_from("<I", data, at)[0]
        if isinstance(kind, Text):
            return str(bytes(data[at + 4:at + 4 + count]).rstrip(b"\0"), "utf-8", "backslashreplace"), at + 4 + count
        assert isinstance(kind, Sequence)
        if not layouts.is_fixed(kind.element):
            return self._list(kind.element, count, data, at + 4)
        return self._array(kind.element, count, data, at + 4)

    def _list(self, kind: Type, count: int, data: memoryview, at: int) -> tuple[list[Any], int]:
        values = []
        for _ in range(count):
            value, at = self._value(kind, data, at)
            values.append(value)
        return values, at

    def _array(self, kind: Type, count: int, data: memoryview, at: int) -> tuple[np.ndarray, int]:
        dtype = self._layouts.dtype(kind)
        if count == 0:
            return np.empty(0, dtype), at
        if isinstance(kind, Plain):
            at += -at % kind.size
            return np.frombuffer(data, dtype, count, at), at + count * kind.size
        key = (id(kind), at & 7, count)
        if key not in self._places:
            self._places[key] = self._find_places(kind, at & 7, count)
        places = self._places[key]
        values = np.empty((count, *dtype.shape), dtype.base)
        for rows, offsets, layout in places.groups:
            values[rows] = gather(data, at + offsets, layout)
        return values, at + places.size

    def _find_places(self, kind: Type, residue: int, count: int) -> _Places:
        ends = self._layouts.element_offsets(kind, residue, count)
        begins = ends[:-1] + -(residue + ends[:-1]) % self._layouts.alignment(kind)
        residues = (residue + begins) & 7
        groups = []
        for one in np.unique(residues).tolist():
            rows = np.flatnonzero(residues == one)
            groups.append((rows, begins[rows], self._layouts.dtype(kind, one)))
        return _Places(groups, int(ends[-1]))
