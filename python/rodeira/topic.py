# SPDX-License-Identifier: Apache-2.0
"""A topic of a recording: its times and its columns as arrays."""

from __future__ import annotations

import os
import warnings
from collections.abc import Iterable
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from .columns import Path, columns_of, pick, resolve
from .decode import ENCAPSULATION, PADDING, BadMessage, Decoder
from .errors import Error, RecordingWarning
from .idl_types import Struct
from .layout import Layouts
from .mcap import MESSAGE_HEAD, Block, McapFile, gather
from .mcap_records import HEAD_BYTES, Channel
from .nodes import Node, concatenate, finished, take

if TYPE_CHECKING:
    import pandas

LARGE_BYTES = 512 << 20  # a topic with more is read by columns, and not as a whole for the first of them
_HEADER = ("step", "time_ns", "source", "incarnation", "state_digest")


@dataclass
class _Batch:
    """Messages of one block, or of all; `values` by path, () for all values."""
    log_time_ns: np.ndarray
    channel: np.ndarray
    values: dict[Path, Node]


class Topic:
    """Reads nothing before it is asked for times or values, and keeps what it has read. `topic["speed_mps"]` reads all
    columns at once; of a topic with more than LARGE_BYTES only this one. `topic.read([...])` reads several columns in
    one pass and keeps nothing."""

    def __init__(self, file: McapFile, name: str, full_name: str, kind: Struct, channels: list[Channel]) -> None:
        self.name = name
        self.full_name = full_name
        self.type = kind
        self.channels = tuple(channels)
        self._file = file
        self._layouts = Layouts()
        self._units = columns_of(kind)
        self._all: _Batch | None = None
        self._columns: dict[Path, _Batch] = {}  # of a large topic
        first = kind.members[0].type
        self.has_header = (isinstance(first, Struct) and first.name == "rodeira::msg::SampleHeader" and
                           tuple(member.name for member in first.members) == _HEADER)

    # What there is.
    @property
    def columns(self) -> tuple[str, ...]:
        """Names of the columns, as in the tables of `rodeira export`: 'wheels[2].load_n', 'agents.id'."""
        return tuple(self._units)

    @property
    def units(self) -> dict[str, str]:
        """Unit of each column; '' for a number without one, and where the type names none."""
        return dict(self._units)

    @property
    def sources(self) -> tuple[str, ...]:
        """The nodes that published it."""
        return tuple(dict.fromkeys(channel.source for channel in self.channels))

    def __len__(self) -> int:
        return len(self._messages().log_time_ns)

    def __repr__(self) -> str:
        return f"<rodeira.Topic '{self.name}' of {', '.join(self.sources)}: {len(self._units)} columns>"

    def __contains__(self, column: object) -> bool:
        return column in self._units

    # Values.
    def __getitem__(self, column: str) -> Any:
        """The values of a column, one a sample, sorted by time.

        Numbers are an array. Columns of a sequence ('agents.id') are a Ragged: offsets and values. 'wheels.load_n' has
        an axis more for the four wheels. A structure ('position_w_m') is a structured array.
        """
        return finished(self._value(self._resolve(column)))

    def read(self, columns: Iterable[str]) -> dict[str, Any]:
        """The named columns in one pass over the file, of which nothing else is kept. `time_s` and `source` give the
        samples' times and nodes, if the type has no column of that name."""
        special = {"time_s": lambda batch: self._time_ns(batch) / 1e9, "source": self._source}
        wanted = list(columns)
        paths = {column: self._resolve(column) for column in wanted if column in self._units or column not in special}
        header: tuple[Path, ...] = (("header", "time_ns"),) if self.has_header else ()
        batch = self._load((*paths.values(), *header))
        return {column: finished(batch.values[paths[column]]) if column in paths else special[column](batch)
                for column in wanted}

    def array(self) -> np.ndarray:
        """All samples as one structured array. Raises Error for a topic with texts or sequences."""
        values = self._loaded().values[()]
        if not isinstance(values, np.ndarray):
            raise Error(f"{self._file.path}: {self.name}: has texts or sequences, so that it is not one array; "
                        "topic[COLUMN] and topic.table() were expected")
        return values

    def values(self) -> Any:
        """All values: a structured array, or a dict by member for a type with texts or sequences."""
        return finished(self._loaded().values[()])

    @property
    def time_ns(self) -> np.ndarray:
        """Simulated time in nanoseconds; of other programs' recordings the log time."""
        if not self.has_header:
            return self._messages().log_time_ns.astype(np.int64)
        return np.ascontiguousarray(self._value(("header", "time_ns")))

    @property
    def time_s(self) -> np.ndarray:
        """Simulated time in seconds."""
        return self.time_ns / 1e9

    @property
    def source(self) -> np.ndarray:
        """The node that published each sample."""
        return self._source(self._messages())

    def table(self) -> dict[str, Any]:
        """The table that `rodeira export --csv` writes, by column (docs/reference/tables.md)."""
        from .table import table_of
        return table_of(self)

    def frame(self) -> "pandas.DataFrame":
        """The table as a frame of pandas; `frame.attrs["units"]` has the unit of each column."""
        from .table import frame_of
        return frame_of(self, self._file.path)

    # Reading.
    def _resolve(self, column: str) -> Path:
        return resolve(self.type, column, f"{self._file.path}: {self.name}")

    def _time_ns(self, batch: _Batch) -> np.ndarray:
        if not self.has_header:
            return batch.log_time_ns.astype(np.int64)
        path = ("header", "time_ns")
        return np.ascontiguousarray(batch.values[path] if path in batch.values else pick(batch.values[()], path))

    def _source(self, batch: _Batch) -> np.ndarray:
        names = np.array([channel.source for channel in self.channels])
        if len(self.channels) == 1:
            return np.full(len(batch.channel), names[0])
        ids = np.array([channel.id for channel in self.channels])
        order = np.argsort(ids)
        return names[order][np.searchsorted(ids[order], batch.channel)]

    def _value(self, path: Path) -> Node:
        if self._all is None and self._is_large():
            return self._column(path).values[path]
        return pick(self._loaded().values[()], path)

    def _messages(self) -> _Batch:
        """A batch of all messages, with the values that are the least to read."""
        if self._all is None and self._is_large():
            first = next(iter(self._columns), None)
            return self._column(first or (("header", "time_ns") if self.has_header else (self.type.members[0].name,)))
        return self._loaded()

    def _is_large(self) -> bool:
        counts = [self._file.expected(block, {channel.id for channel in self.channels}) for block in self._file.blocks]
        if None in counts or not self._layouts.is_fixed(self.type):
            return False
        return sum(count or 0 for count in counts) * self._layouts.dtype(self.type).itemsize > LARGE_BYTES

    def _column(self, path: Path) -> _Batch:
        if path not in self._columns:
            batch = self._load((path,))
            for other in self._columns.values():  # one copy of the times is enough
                batch.log_time_ns, batch.channel = other.log_time_ns, other.channel
            self._columns[path] = batch
        return self._columns[path]

    def _loaded(self) -> _Batch:
        if self._all is None:
            self._all = self._load(((),))
        return self._all

    def _load(self, paths: tuple[Path, ...]) -> _Batch:
        ids = {channel.id for channel in self.channels}
        file = self._file
        blocks = [block for block in file.blocks if file.expected(block, ids) != 0]
        out = self._room(blocks, ids) if paths == ((),) else None
        with ThreadPoolExecutor(max_workers=min(8, os.cpu_count() or 1)) as pool:
            begins = np.cumsum([0, *(file.expected(block, ids) or 0 for block in blocks)]).tolist()
            jobs = [pool.submit(self._read_block, block, ids, paths,
                                None if out is None else out[begins[i]:begins[i + 1]])
                    for i, block in enumerate(blocks)]
            batches, lost = [], []
            try:
                for job in jobs:
                    found = job.result()
                    if isinstance(found, _Batch):
                        batches.append(found)
                    else:
                        lost.append(found)
            except BaseException:
                pool.shutdown(cancel_futures=True)
                raise
        if not lost:
            lost += self._missing(ids, sum(len(batch.log_time_ns) for batch in batches))
        for sentence in lost:
            if sentence not in file.damage:
                file.damage.append(sentence)
                warnings.warn(sentence, RecordingWarning, stacklevel=4)
        return self._together(batches, out if not lost else None, paths)

    def _room(self, blocks: list[Block], ids: set[int]) -> np.ndarray | None:
        """Where the values of all messages go, if their number and size are known beforehand."""
        counts = [self._file.expected(block, ids) for block in blocks]
        if None in counts or not self._layouts.is_fixed(self.type):
            return None
        return np.empty(sum(count or 0 for count in counts), dtype=self._layouts.dtype(self.type))

    def _missing(self, ids: set[int], found: int) -> list[str]:
        if self._file.counts is None:
            return []
        said = sum(self._file.counts.get(channel, 0) for channel in ids)
        return [] if said == found else [
            f"{self._file.path}: {self.name}: {found} messages were found; the summary names {said}"]

    def _together(self, batches: list[_Batch], out: np.ndarray | None, paths: tuple[Path, ...]) -> _Batch:
        if not batches:
            empty = np.empty(0, dtype=np.int64)
            node = Decoder(self.type, self._layouts).decode(b"", empty, empty)
            return _Batch(empty.astype(np.uint64), empty, {path: pick(node, path) for path in paths})
        log_time_ns = np.concatenate([batch.log_time_ns for batch in batches])
        channel = np.concatenate([batch.channel for batch in batches])
        values = {path: out if out is not None else concatenate([batch.values[path] for batch in batches])
                  for path in paths}
        if (log_time_ns[1:] < log_time_ns[:-1]).any():  # several sources: one block after the other
            order = np.argsort(log_time_ns, kind="stable")
            log_time_ns, channel = log_time_ns[order], channel[order]
            values = {path: take(node, order) for path, node in values.items()}
        return _Batch(log_time_ns, channel, values)

    def _read_block(self, block: Block, ids: set[int], paths: tuple[Path, ...],
                    out: np.ndarray | None) -> _Batch | str:
        """The block's messages, into `out` if there is one; a sentence if the block is lost."""
        try:
            records = self._file.records(block)
        except Error as problem:
            return str(problem)
        at, heads = self._file.messages(block, records, ids)
        start = at + MESSAGE_HEAD.itemsize
        end = at + HEAD_BYTES + heads["length"].astype(np.int64)
        if (end > len(records)).any():
            return f"{self._file.path}: byte {block.offset}: a message that ends behind its chunk lies there"
        if out is not None and len(out) != len(at):
            out = None
        batch = _Batch(heads["log_time"].copy(), heads["channel"].copy(), {})
        try:
            batch.values = self._of_one_size(records, start, end, paths, out)
            if not batch.values:
                node = Decoder(self.type, self._layouts).decode(records, start, end)
                batch.values = {path: _own(pick(node, path)) for path in paths}
        except BadMessage as bad:
            head = heads[bad.message]
            channel = next(channel for channel in self.channels if channel.id == head["channel"])
            raise Error(f"{self._file.path}: {self.name} of '{channel.source}' at {int(head['log_time']) / 1e9:.9g} s: "
                        f"{bad.sentence}") from None
        if out is not None and (values := batch.values[()]) is not out:
            out[:] = values
        return batch

    def _of_one_size(self, records: bytes | memoryview, start: np.ndarray, end: np.ndarray, paths: tuple[Path, ...],
                     out: np.ndarray | None) -> dict[Path, Node]:
        """The values of little-endian messages of one size, into `out` if there is one. Nothing where the messages are
        of another kind or wrong: the decoder says what."""
        if len(start) == 0 or not self._layouts.is_fixed(self.type) or self._layouts.truth_paths(self.type):
            return {}
        dtype = self._layouts.dtype(self.type)
        left = end - start - ENCAPSULATION - dtype.itemsize
        if left.min() < 0 or left.max() > PADDING or (gather(records, start, ">u2") != 1).any():
            return {}
        if paths == ((),):
            found = gather(records, start + ENCAPSULATION, dtype)
            if out is None:
                return {(): found}
            out.view(np.uint8)[:] = found.view(np.uint8)  # one copy; by fields it would be one each
            return {(): out}
        count = len(records) - dtype.itemsize - ENCAPSULATION + 1
        every: np.ndarray = np.ndarray((count,), dtype=dtype, buffer=records, offset=ENCAPSULATION, strides=(1,))
        columns = {path: pick(every, path) for path in paths}
        return {path: column[start] for path, column in columns.items() if isinstance(column, np.ndarray)}


def _own(node: Node) -> Node:
    """The values without the block's other bytes."""
    return np.ascontiguousarray(node) if isinstance(node, np.ndarray) else node
