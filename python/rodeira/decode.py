# SPDX-License-Identifier: Apache-2.0
"""CDR (version 1) to arrays: one step a member of the type for all messages at once, no loop over messages."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np

from .idl_types import Array, Plain, Sequence, Struct, Text, Type
from .layout import Layouts
from .mcap import gather
from .nodes import Node, Ragged, Texts, concatenate, spread, take

ENCAPSULATION = 4
PADDING = 3  # of a transport, behind the last value


class BadMessage(Exception):
    """A message that is not of its type."""

    def __init__(self, message: int, sentence: str) -> None:
        super().__init__(sentence)
        self.message = message  # its number within the block
        self.sentence = sentence


@dataclass(frozen=True)
class Bodies:
    """The messages that are decoded; an element of a sequence has the place of its message."""
    data: bytes | memoryview
    base: np.ndarray     # where alignment counts from
    end: np.ndarray
    message: np.ndarray  # number of the message
    order: str

    def take(self, rows: np.ndarray) -> "Bodies":
        return Bodies(self.data, self.base[rows], self.end[rows], self.message[rows], self.order)


class Decoder:
    """Decodes messages of one type; used by one thread."""

    def __init__(self, kind: Struct, layouts: Layouts) -> None:
        self.kind = kind
        self.layouts = layouts
        self._path: list[str] = []

    def decode(self, data: bytes | memoryview, start: np.ndarray, end: np.ndarray) -> Node:
        """All values of the messages in `data` from `start` (encapsulation) to `end`. Raises BadMessage."""
        which = np.arange(len(start))
        little = self._is_little_endian(data, start, end)
        if little.all() or not little.any():
            order = "<" if little.all() else ">"
            return self._all(Bodies(data, start + ENCAPSULATION, end, which, order))
        parts = [self._all(Bodies(data, start + ENCAPSULATION, end, which, order).take(rows))
                 for order, rows in (("<", which[little]), (">", which[~little]))]
        return take(concatenate(parts), np.argsort(np.concatenate([which[little], which[~little]]), kind="stable"))

    def _is_little_endian(self, data: bytes | memoryview, start: np.ndarray, end: np.ndarray) -> np.ndarray:
        short = end - start < ENCAPSULATION
        if short.any():
            worst = int(np.argmax(short))
            raise BadMessage(worst, f"the message has {end[worst] - start[worst]} bytes; the four of its encapsulation "
                                    "were expected")
        kind = gather(data, start, ">u2")
        if (kind > 1).any():
            worst = int(np.argmax(kind > 1))
            raise BadMessage(worst, f"the encapsulation is {kind[worst] >> 8:02x} {kind[worst] & 255:02x}; 00 00 or "
                                    "00 01 (CDR version 1) was expected")
        return kind == 1

    def _all(self, bodies: Bodies) -> Node:
        node, at = self._value(self.kind, bodies, bodies.base)
        left = bodies.end - at
        self._check(left <= PADDING, bodies, at, lambda i: f"{left[i]} bytes are left behind the last value")
        return node

    def _check(self, good: np.ndarray, bodies: Bodies, at: np.ndarray, sentence: Callable[[int], str]) -> None:
        if not good.all():
            worst = int(np.argmin(good))
            path = f" ('{'.'.join(self._path)}')" if self._path else ""
            byte = int(at[worst] - bodies.base[worst]) + ENCAPSULATION
            raise BadMessage(int(bodies.message[worst]), f"byte {byte}{path}: {sentence(worst)}")

    def _check_room(self, bodies: Bodies, at: np.ndarray, size: np.ndarray | int) -> None:
        self._check(at + size <= bodies.end, bodies, at, lambda i: (
            f"the message ends after {bodies.end[i] - at[i]} bytes; at least "
            f"{size if isinstance(size, int) else size[i]} more were expected"))

    # Each gives the values and the places behind them.
    def _value(self, kind: Type, bodies: Bodies, at: np.ndarray) -> tuple[Node, np.ndarray]:
        if self.layouts.is_fixed(kind):
            return self._fixed(kind, bodies, at)
        if isinstance(kind, Text):
            return self._text(kind, bodies, at)
        if isinstance(kind, Sequence):
            return self._sequence(kind, bodies, at)
        if isinstance(kind, Array):
            return self._array(kind, bodies, at)
        assert isinstance(kind, Struct)
        members: dict[str, Node] = {}
        for member in kind.members:
            self._path.append(member.name)
            members[member.name], at = self._value(member.type, bodies, at)
            self._path.pop()
        return members, at

    def _aligned(self, size: int, bodies: Bodies, at: np.ndarray) -> np.ndarray:
        return at + (bodies.base - at) % size

    def _fixed(self, kind: Type, bodies: Bodies, at: np.ndarray) -> tuple[Node, np.ndarray]:
        at = self._aligned(self.layouts.alignment(kind), bodies, at)
        wanted = self.layouts.dtype(kind)
        residue = (at - bodies.base) & 7
        residues = np.unique(residue).tolist()
        if len(residues) == 1:
            found, after = self._fixed_at(kind, residues[0], bodies, at)
            if found.dtype == wanted.base:
                return found, after
        out = np.empty((len(at), *wanted.shape), dtype=wanted.base)
        after = np.empty_like(at)
        for one in residues:
            rows = residue == one
            out[rows], after[rows] = self._fixed_at(kind, one, bodies.take(rows), at[rows])
        return out, after

    def _fixed_at(self, kind: Type, residue: int, bodies: Bodies, at: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        dtype = self.layouts.dtype(kind, residue, bodies.order)
        self._check_room(bodies, at, dtype.itemsize)
        found = gather(bodies.data, at, dtype)
        for path in self.layouts.truth_paths(kind):
            truth = found
            for name in path:
                truth = truth[name]
            number = np.asarray(truth).view(np.uint8).reshape(len(at), -1).max(axis=1, initial=0)
            self._check_truth(number, bodies, at)
        return found, at + dtype.itemsize

    def _check_truth(self, number: np.ndarray, bodies: Bodies, at: np.ndarray) -> None:
        self._check(number <= 1, bodies, at, lambda i: f"a boolean of {number[i]} was found; 0 or 1 was expected")

    def _count(self, bodies: Bodies, at: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        at = self._aligned(4, bodies, at)
        self._check_room(bodies, at, 4)
        return gather(bodies.data, at, bodies.order + "u4").astype(np.int64), at + 4

    def _text(self, kind: Text, bodies: Bodies, at: np.ndarray) -> tuple[Texts, np.ndarray]:
        """The length counts a terminating zero. As Fast-CDR reads: without one, all bytes are text."""
        length, at, after = self._text_place(bodies, at)
        if len(length):
            last = gather(bodies.data, np.maximum(after - 1, 0), "u1")
            length = length - ((length > 0) & (last == 0))
        self._check((length <= kind.bound) | (kind.bound == 0), bodies, at, lambda i: (
            f"a text of {length[i]} bytes was found; at most {kind.bound} were expected"))
        offsets, places = spread(at, length)
        return Texts(offsets, gather(bodies.data, places, "u1")), after

    def _text_place(self, bodies: Bodies, at: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        length, at = self._count(bodies, at)
        self._check_room(bodies, at, length)
        return length, at, at + length

    def _array(self, kind: Array, bodies: Bodies, at: np.ndarray) -> tuple[Node, np.ndarray]:
        elements: list[Any] = []
        self._check_room(bodies, at, self.layouts.least_bytes(kind))
        for _ in range(kind.length):
            element, at = self._value(kind.element, bodies, at)
            elements.append(element)
        if all(isinstance(element, np.ndarray) for element in elements):
            return np.stack(elements, axis=1), at
        return elements, at

    def _sequence(self, kind: Sequence, bodies: Bodies, at: np.ndarray) -> tuple[Node, np.ndarray]:
        length, at = self._length(kind, bodies, at)
        if isinstance(kind.element, Plain):
            size = kind.element.size
            at = np.where(length > 0, self._aligned(size, bodies, at), at)
            after = at + size * length
            self._check_room(bodies, at, size * length)
            offsets, places = spread(at, length, size)
        else:
            offsets, places, after = self._elements(kind.element, bodies, at, length)
        rows = np.repeat(np.arange(len(at)), length)
        values, _ = self._value(kind.element, bodies.take(rows), places)
        return Ragged(offsets, values), after

    def _length(self, kind: Sequence, bodies: Bodies, at: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        length, at = self._count(bodies, at)
        self._check((length <= kind.bound) | (kind.bound == 0), bodies, at, lambda i: (
            f"a sequence of {length[i]} elements was found; at most {kind.bound} were expected"))
        left = bodies.end - at
        self._check(length * self.layouts.least_bytes(kind.element) <= left, bodies, at, lambda i: (
            f"a sequence of {length[i]} elements was found, but only {left[i]} bytes are left"))
        return length, at

    def _elements(self, kind: Type, bodies: Bodies, at: np.ndarray,
                  length: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Offsets of the sequences, the place of each element, and the places behind the sequences."""
        offsets, number = spread(np.zeros_like(at), length)
        if self.layouts.is_fixed(kind):
            residue = (at - bodies.base) & 7
            longest = int(length.max()) if len(length) else 0
            ends = np.zeros((8, longest + 1), dtype=np.int64)
            for one in np.unique(residue).tolist():
                ends[one] = self.layouts.element_offsets(kind, one, longest)
            return offsets, np.repeat(at, length) + ends[np.repeat(residue, length), number], at + ends[residue, length]
        places = np.empty(int(offsets[-1]), dtype=np.int64)
        after = at.copy()
        rows, round_ = np.flatnonzero(length > 0), 0
        while len(rows):  # the first element of all sequences, then the second …
            places[offsets[rows] + round_] = after[rows]
            after[rows] = self._after(kind, bodies.take(rows), after[rows])
            round_ += 1
            rows = rows[length[rows] > round_]
        return offsets, places, after

    def _after(self, kind: Type, bodies: Bodies, at: np.ndarray) -> np.ndarray:
        """The places behind the values, which are not decoded."""
        if self.layouts.is_fixed(kind):
            sizes = np.zeros(8, dtype=np.int64)
            at = self._aligned(self.layouts.alignment(kind), bodies, at)
            residue = (at - bodies.base) & 7
            for one in np.unique(residue).tolist():
                sizes[one] = self.layouts.dtype(kind, one).itemsize
            self._check_room(bodies, at, sizes[residue])
            return at + sizes[residue]
        if isinstance(kind, Text):
            return self._text_place(bodies, at)[2]
        if isinstance(kind, Array):
            for _ in range(kind.length):
                at = self._after(kind.element, bodies, at)
            return at
        if isinstance(kind, Struct):
            for member in kind.members:
                at = self._after(member.type, bodies, at)
            return at
        assert isinstance(kind, Sequence)
        length, at = self._length(kind, bodies, at)
        if isinstance(kind.element, Plain):
            at = np.where(length > 0, self._aligned(kind.element.size, bodies, at), at)
            return at + kind.element.size * length
        return self._elements(kind.element, bodies, at, length)[2]
