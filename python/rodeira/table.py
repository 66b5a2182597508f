# SPDX-License-Identifier: Apache-2.0
"""The table of a topic, as `rodeira export --csv` writes it (docs/reference/tables.md)."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from .columns import unit_of_name
from .errors import Error
from .idl_types import OCTET, Array, Plain, Sequence, Struct, Type
from .nodes import Node, Ragged

if TYPE_CHECKING:
    import pandas

    from .topic import Topic


def row_sequences(kind: Type, path: tuple[str, ...] = ()) -> list[tuple[str, ...]]:
    """The sequences of structures that lie in no other sequence; exactly one makes the rows."""
    if isinstance(kind, Struct):
        return [found for member in kind.members for found in row_sequences(member.type, (*path, member.name))]
    if isinstance(kind, Sequence) and isinstance(kind.element, Struct):
        return [path]
    if isinstance(kind, Array) and row_sequences(kind.element):
        return [path, ()]  # each element of the array has one
    return []


class _Builder:
    def __init__(self, topic: "Topic") -> None:
        self.columns: dict[str, Any] = {}
        self.rows: np.ndarray | None = None  # the sample of each row; nothing: one row a sample
        self.sequence: tuple[str, ...] = ()
        found = row_sequences(topic.type)
        if len(found) == 1:
            self.sequence = found[0]
        self.topic = topic

    def add(self, kind: Type, node: Node, path: str, names: tuple[str, ...], in_rows: bool) -> None:
        if isinstance(kind, Struct):
            for member in kind.members:
                filler = kind.name.startswith("rodeira::msg::") and member.name == "end" and (
                    isinstance(member.type, Plain) and member.type.code == "u4")
                if filler or (not path and self.topic.has_header and member is kind.members[0]):
                    continue
                assert isinstance(node, (dict, np.ndarray))
                self.add(member.type, node[member.name], f"{path}.{member.name}" if path else member.name,
                         (*names, member.name), in_rows)
        elif isinstance(kind, Array) and kind.element != OCTET:
            for i in range(kind.length):
                inner = node[:, i] if isinstance(node, np.ndarray) else node[i]  # type: ignore[index]
                self.add(kind.element, inner, f"{path}[{i}]", (*names, str(i)), in_rows)
        elif isinstance(kind, Sequence) and not in_rows and self.sequence and names == self.sequence:
            assert isinstance(node, Ragged)
            self.rows = node.samples
            self.add(kind.element, node.values, path, names, True)
        else:
            self._put(kind, node, path, in_rows)

    def _put(self, kind: Type, node: Node, path: str, in_rows: bool) -> None:
        values: Any = node
        if isinstance(kind, (Array, Sequence)):  # one object a cell
            cells = np.empty(len(values), dtype=object)
            for i, cell in enumerate(values):
                cells[i] = cell.tobytes() if kind.element == OCTET else cell
            values = cells
        self.columns[path or "value"] = (values, in_rows)

    def finish(self) -> dict[str, Any]:
        table: dict[str, Any] = {"time_s": self._a_row(self.topic.time_s)}
        if self.topic.has_header:
            table["step"] = self._a_row(self.topic["header.step"])
        table["source"] = self._a_row(self.topic.source)
        for name, (values, in_rows) in self.columns.items():
            table[name] = np.ascontiguousarray(values) if in_rows else self._a_row(values)
        if self.topic.has_header:
            table["state_digest"] = self._a_row(self.topic["header.state_digest"])
        return table

    def _a_row(self, values: np.ndarray) -> np.ndarray:
        return np.ascontiguousarray(values if self.rows is None else values[self.rows])


def table_of(topic: "Topic") -> dict[str, Any]:
    """Columns by name; all have the same number of rows."""
    builder = _Builder(topic)
    builder.add(topic.type, topic.values(), "", (), False)
    return builder.finish()


def frame_of(topic: "Topic", recording: str) -> "pandas.DataFrame":
    try:
        import pandas
    except ImportError:
        raise Error("frames need the Python package pandas (Debian: python3-pandas); topic.table() works without") \
            from None
    frame = pandas.DataFrame(table_of(topic))
    known = topic.units
    units = {name: known.get(name, unit_of_name(name)) for name in frame.columns}
    units.update({name: "" for name in ("step", "source", "state_digest") if name in units})
    frame.attrs.update(units=units, topic=topic.full_name, recording=recording)
    return frame
