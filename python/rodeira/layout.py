# SPDX-License-Identifier: Apache-2.0
"""Where the values of a type lie in CDR (version 1): NumPy dtypes of what has a fixed size.

In CDR a number lies at a multiple of its size, counted from the start of the message. The padding within a structure
therefore depends on where it begins: a `residue` is that place modulo 8.
"""

from __future__ import annotations

import numpy as np

from .idl_types import Array, Plain, Sequence, Struct, Text, Type

MAX_FIXED_BYTES = 64 << 20  # no larger message is written


class Layouts:
    """Keeps what it found out about each type of one schema."""

    def __init__(self) -> None:
        self._keep: dict[int, Type] = {}  # an id stays that of its type
        self._fixed: dict[int, bool] = {}
        self._least: dict[int, int] = {}
        self._truth: dict[int, list[tuple[str, ...]]] = {}
        self._dtypes: dict[tuple[int, int, str], np.dtype] = {}

    def alignment(self, kind: Type) -> int:
        """Of the first value of the type."""
        while not isinstance(kind, Plain):
            if isinstance(kind, Struct):
                kind = kind.members[0].type
            elif isinstance(kind, Array):
                kind = kind.element
            else:
                return 4  # the length of a text or sequence
        return kind.size

    def least_bytes(self, kind: Type) -> int:
        """No encoded value of the type is shorter."""
        if isinstance(kind, Plain):
            return kind.size
        if isinstance(kind, (Text, Sequence)):
            return 4
        if id(kind) not in self._least:
            self._keep[id(kind)] = kind
            if isinstance(kind, Array):
                self._least[id(kind)] = kind.length * self.least_bytes(kind.element)
            else:
                self._least[id(kind)] = sum(self.least_bytes(member.type) for member in kind.members)
        return self._least[id(kind)]

    def is_fixed(self, kind: Type) -> bool:
        """True for a type without texts and sequences, with arrays of one stride: it has a dtype."""
        if isinstance(kind, Plain):
            return True
        if isinstance(kind, (Text, Sequence)):
            return False
        if id(kind) not in self._fixed:
            self._keep[id(kind)] = kind
            self._fixed[id(kind)] = self._find_fixed(kind)
        return self._fixed[id(kind)]

    def _find_fixed(self, kind: Array | Struct) -> bool:
        if self.least_bytes(kind) > MAX_FIXED_BYTES:
            return False
        if isinstance(kind, Struct):
            return all(self.is_fixed(member.type) for member in kind.members)
        if isinstance(kind.element, Plain):
            return True
        step = self.alignment(kind)
        return self.is_fixed(kind.element) and all(
            self._has_one_stride(kind, residue) for residue in range(0, 8, step))

    def _has_one_stride(self, kind: Array, residue: int) -> bool:
        first = self.dtype(kind.element, residue)
        for _ in range(min(kind.length, 9)):  # residues repeat after 8 elements at the latest
            if residue % self.alignment(kind) or self.dtype(kind.element, residue) != first:
                return False
            residue = (residue + first.itemsize) % 8
        return True

    def dtype(self, kind: Type, residue: int = 0, order: str = "<") -> np.dtype:
        """Of a fixed type that begins at `residue`, a multiple of its alignment. Its size is what the value takes."""
        if isinstance(kind, Plain):
            return np.dtype(order + kind.code)
        key = (id(kind), residue, order)
        if key not in self._dtypes:
            self._keep[id(kind)] = kind
            if isinstance(kind, Array):
                self._dtypes[key] = np.dtype((self.dtype(kind.element, residue, order), (kind.length,)))
            else:
                assert isinstance(kind, Struct)
                self._dtypes[key] = self._of_struct(kind, residue, order)
        return self._dtypes[key]

    def _of_struct(self, kind: Struct, residue: int, order: str) -> np.dtype:
        formats, offsets, at = [], [], 0
        for member in kind.members:
            at += -(residue + at) % self.alignment(member.type)
            formats.append(self.dtype(member.type, (residue + at) % 8, order))
            offsets.append(at)
            at += formats[-1].itemsize
        names = [member.name for member in kind.members]
        return np.dtype({"names": names, "formats": formats, "offsets": offsets, "itemsize": at})

    def element_offsets(self, kind: Type, residue: int, count: int) -> np.ndarray:
        """Of the elements of a sequence from the byte behind its length: where 0 … `count` of them end."""
        steps: list[int] = []
        seen: dict[int, int] = {}
        while residue not in seen and len(steps) < count:
            seen[residue] = len(steps)
            pad = -residue % self.alignment(kind)
            steps.append(pad + self.dtype(kind, (residue + pad) % 8).itemsize)
            residue = (residue + steps[-1]) % 8
        sizes = np.array(steps, dtype=np.int64)
        if len(steps) < count:
            period = sizes[seen[residue]:]
            sizes = np.concatenate([sizes, np.resize(period, count - len(sizes))])
        return np.concatenate([np.zeros(1, dtype=np.int64), np.cumsum(sizes)])

    def truth_paths(self, kind: Type) -> list[tuple[str, ...]]:
        """The names that lead to the truth values of a fixed type; () for a truth value itself."""
        if isinstance(kind, Plain):
            return [()] if kind.code == "b1" else []
        if isinstance(kind, Array):
            return self.truth_paths(kind.element)
        if id(kind) not in self._truth:
            self._keep[id(kind)] = kind
            assert isinstance(kind, Struct)
            self._truth[id(kind)] = [(member.name, *path) for member in kind.members
                                     for path in self.truth_paths(member.type)]
        return self._truth[id(kind)]
