# SPDX-License-Identifier: Apache-2.0
"""Decoded values of many messages: arrays, texts, and sequences of different lengths."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any, Union

import numpy as np

_MAX_TEXT_ARRAY_BYTES = 64 << 20  # more than that as an array of one width becomes an array of objects


class Ragged:
    """A sequence of each sample: sample i has `values[offsets[i]:offsets[i + 1]]`.

    `offsets` has one element more than there are samples. `values` is an array, a dict of columns for structures with
    texts, or another Ragged for sequences of sequences.
    """

    def __init__(self, offsets: np.ndarray, values: Any) -> None:
        self.offsets = offsets
        self.values = values

    def __len__(self) -> int:
        return len(self.offsets) - 1

    def __getitem__(self, sample: int) -> Any:
        sample = range(len(self))[sample]
        return _slice(self.values, int(self.offsets[sample]), int(self.offsets[sample + 1]))

    def __iter__(self) -> Iterator[Any]:
        return (self[sample] for sample in range(len(self)))

    @property
    def lengths(self) -> np.ndarray:
        """How many elements each sample has."""
        return np.diff(self.offsets)

    @property
    def samples(self) -> np.ndarray:
        """The sample that each element belongs to."""
        return np.repeat(np.arange(len(self)), self.lengths)

    def __repr__(self) -> str:
        return f"Ragged({len(self)} samples, {int(self.offsets[-1])} elements)"


class Texts:
    """Texts as offsets and UTF-8 bytes."""

    def __init__(self, offsets: np.ndarray, data: np.ndarray) -> None:
        self.offsets = offsets
        self.data = data

    def __len__(self) -> int:
        return len(self.offsets) - 1

    def array(self) -> np.ndarray:
        """An array of texts (dtype U); of objects where one width for all would need too much memory."""
        count, lengths = len(self), np.diff(self.offsets)
        width = int(lengths.max()) if count else 0
        if width == 0:
            return np.full(count, "", dtype="U1")
        last = self.data[np.maximum(self.offsets[1:] - 1, 0)]
        ends_on_zero = bool(((last == 0) & (lengths > 0)).any())  # which a fixed width would lose
        if ends_on_zero or 4 * count * width > _MAX_TEXT_ARRAY_BYTES:
            raw, ends = self.data.tobytes(), self.offsets.tolist()
            texts = [raw[a:b].decode("utf-8", "backslashreplace") for a, b in zip(ends, ends[1:])]
            return np.array([*texts, None], dtype=object)[:-1]
        cells = np.zeros((count, width), dtype=np.uint8)
        cells[np.arange(width) < lengths[:, None]] = self.data
        distinct, which = np.unique(cells.view(f"S{width}").ravel(), return_inverse=True)
        return np.array([text.decode("utf-8", "backslashreplace") for text in distinct.tolist()])[which]


Node = Union[np.ndarray, Texts, Ragged, dict, list]


def spread(starts: np.ndarray, lengths: np.ndarray, step: int = 1) -> tuple[np.ndarray, np.ndarray]:
    """Offsets of the runs, and the places start, start + step, … of every element of every run."""
    offsets = np.concatenate([np.zeros(1, dtype=np.int64), np.cumsum(lengths)])
    places = np.repeat(starts - step * offsets[:-1], lengths) + step * np.arange(offsets[-1])
    return offsets, places


def take(node: Node, rows: np.ndarray) -> Node:
    """The node's rows in that order."""
    if isinstance(node, dict):
        return {name: take(inner, rows) for name, inner in node.items()}
    if isinstance(node, list):
        return [take(inner, rows) for inner in node]
    if isinstance(node, (Texts, Ragged)):
        offsets, places = spread(node.offsets[rows], np.diff(node.offsets)[rows])
        if isinstance(node, Texts):
            return Texts(offsets, node.data[places])
        return Ragged(offsets, take(node.values, places))
    return node[rows]


def concatenate(nodes: list[Any]) -> Node:
    """The rows of all nodes, which are of one type."""
    first = nodes[0]
    if len(nodes) == 1:
        return first
    if isinstance(first, dict):
        return {name: concatenate([node[name] for node in nodes]) for name in first}
    if isinstance(first, list):
        return [concatenate([node[i] for node in nodes]) for i in range(len(first))]
    if isinstance(first, (Texts, Ragged)):
        begins = np.cumsum([0, *(node.offsets[-1] for node in nodes)])
        offsets = np.concatenate([*(node.offsets[:-1] + begin for node, begin in zip(nodes, begins)), begins[-1:]])
        if isinstance(first, Texts):
            return Texts(offsets, np.concatenate([node.data for node in nodes]))
        return Ragged(offsets, concatenate([node.values for node in nodes]))
    out = np.empty((sum(len(node) for node in nodes), *first.shape[1:]), dtype=first.dtype)
    return np.concatenate(nodes, out=out)  # keeps the dtype's offsets


def finished(node: Node) -> Any:
    """The node for the user: texts become arrays."""
    if isinstance(node, Texts):
        return node.array()
    if isinstance(node, Ragged):
        return Ragged(node.offsets, finished(node.values))
    if isinstance(node, dict):
        return {name: finished(inner) for name, inner in node.items()}
    if isinstance(node, list):
        return [finished(inner) for inner in node]
    return node


def _slice(values: Any, begin: int, end: int) -> Any:
    if isinstance(values, dict):
        return {name: _slice(inner, begin, end) for name, inner in values.items()}
    if isinstance(values, list):
        return [_slice(inner, begin, end) for inner in values]
    if isinstance(values, Ragged):
        offsets = values.offsets[begin:end + 1]
        return Ragged(offsets - offsets[0], _slice(values.values, int(offsets[0]), int(offsets[-1])))
    return values[begin:end]
