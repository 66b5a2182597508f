# SPDX-License-Identifier: Apache-2.0
"""An MCAP file: channels, attachments, metadata, and the places of the messages of a channel.

The file is mapped into memory and its top-level records are walked through once, so that a file needs neither a summary
nor an end. What cannot be read is named in `damage`.
"""

from __future__ import annotations

import mmap
import os
import struct
import zlib
from dataclasses import dataclass, field

import numpy as np

from .checksum import crc32
from .compression import decompress
from .errors import Error, nearest_file
from .mcap_records import (ATTACHMENT, CHANNEL, CHUNK, CHUNK_INDEX, DATA_END, FOOTER, FOOTER_BYTES, HEAD_BYTES, HEADER,
                           MAGIC, MESSAGE, MESSAGE_HEAD_BYTES, MESSAGE_INDEX, METADATA, SCHEMA, STATISTICS, Channel,
                           ChunkHead, Fields, Schema, Short, read_channel, read_chunk, read_schema, read_statistics,
                           seconds)

_HEAD = struct.Struct("<BQ")
MESSAGE_HEAD = np.dtype([("opcode", "u1"), ("length", "<u8"), ("channel", "<u2"), ("sequence", "<u4"),
                         ("log_time", "<u8"), ("publish_time", "<u8")])  # of a record, before its data


@dataclass(frozen=True)
class Attachment:
    name: str
    media_type: str
    stored: memoryview = field(repr=False)

    def data(self) -> bytes:
        """The attached file, decompressed if the recorder compressed it."""
        if self.media_type != "application/x-rodeira-zstd":
            return bytes(self.stored)
        size = int.from_bytes(self.stored[:8], "little")
        try:
            return bytes(decompress("zstd", self.stored[8:], size))
        except Error as problem:
            raise Error(f"attachment '{self.name}': {problem}") from None


@dataclass
class Block:
    """Messages that lie together: those of a chunk, or those outside of chunks."""
    offset: int
    head: ChunkHead | None = None
    indexes: dict[int, memoryview] = field(default_factory=dict)  # by channel: pairs of log time and offset
    offsets: list[int] = field(default_factory=list)              # of messages outside of chunks, in the file


class McapFile:
    """Raises Error if the file cannot be opened or does not begin as MCAP."""

    def __init__(self, path: str | os.PathLike[str]) -> None:
        self.path = os.fspath(path)
        try:
            with open(self.path, "rb") as file:
                size = os.fstat(file.fileno()).st_size
                self.data = memoryview(b"")
                if size:
                    self.data = memoryview(mmap.mmap(file.fileno(), 0, access=mmap.ACCESS_READ))
        except (FileNotFoundError, NotADirectoryError):
            raise Error(f"{self.path}: there is no such file{nearest_file(self.path)}") from None
        except IsADirectoryError:
            raise Error(f"{self.path}: this is not a file, a recording was expected") from None
        except OSError as problem:
            raise Error(f"{self.path}: the recording cannot be opened: {problem.strerror or problem}") from None
        if bytes(self.data[:len(MAGIC)]) != MAGIC:
            raise Error(f"{self.path}: this is no MCAP recording: it does not begin with MCAP's mark")
        self.library = ""
        self.damage: list[str] = []
        self.schemas: dict[int, Schema] = {}
        self.channels: dict[int, Channel] = {}
        self.blocks: list[Block] = []
        self.attachments: list[Attachment] = []
        self.metadata: list[tuple[str, dict[str, str]]] = []
        self.counts: dict[int, int] | None = None  # messages by channel, as the summary says
        self._chunk_offsets: list[int] = []        # as the summary says
        self._read_summary()
        self._walk()
        self._find_channels()

    # The records of the file itself.
    def _record(self, at: int, end: int) -> tuple[int, memoryview, int]:
        """Opcode, content and end of the record at that byte; Short if it does not end before `end`."""
        if end - at < HEAD_BYTES:
            raise Short
        opcode, length = _HEAD.unpack_from(self.data, at)
        if length > end - at - HEAD_BYTES:
            raise Short
        return opcode, self.data[at + HEAD_BYTES:at + HEAD_BYTES + length], at + HEAD_BYTES + length

    def _read_summary(self) -> None:
        end = len(self.data) - len(MAGIC) - FOOTER_BYTES
        if end < len(MAGIC) or self.data[-len(MAGIC):] != MAGIC or self.data[end] != FOOTER:
            return  # the walk says that the file has no end
        start, _, crc = struct.unpack_from("<QQI", self.data, end + HEAD_BYTES)
        if start == 0:
            return
        if not len(MAGIC) <= start <= end or (crc and crc != zlib.crc32(self.data[start:end + FOOTER_BYTES - 4])):
            self.damage.append(f"{self.path}: byte {start}: the summary is damaged")
            return
        at = start
        try:
            while at < end:
                opcode, content, at = self._record(at, end)
                self._define(opcode, content)
                if opcode == STATISTICS:
                    self.counts = read_statistics(content)
                elif opcode == CHUNK_INDEX:
                    self._chunk_offsets.append(struct.unpack_from("<Q", content, 16)[0])
        except (Short, struct.error):
            self.damage.append(f"{self.path}: byte {at}: the summary is damaged")

    def _define(self, opcode: int, content: memoryview) -> None:
        if opcode == SCHEMA:
            schema = read_schema(content)
            self.schemas.setdefault(schema.id, schema)
        elif opcode == CHANNEL:
            channel = read_channel(content)
            self.channels.setdefault(channel.id, channel)

    def _walk(self) -> None:
        at = self._walk_from(len(MAGIC))
        if at is None:
            return
        if self.blocks:
            self.blocks[-1].indexes.clear()  # more of them may have followed
        later = [offset for offset in sorted(self._chunk_offsets) if offset > at]
        lost = (f"what lies between there and byte {later[0]} is lost" if later else
                f"the {len(self.data) - at} bytes from there on are lost")
        self.damage.append(f"{self.path}: byte {at}: the file is cut or damaged here; {lost}")
        if later:
            self._walk_from(later[0])

    def _walk_from(self, at: int) -> int | None:
        """Takes all records up to the end of the data; otherwise the byte of the first that cannot be read."""
        end = len(self.data)
        while True:
            try:
                opcode, content, after = self._record(at, end)
                if opcode == DATA_END:
                    return None if self.data[-len(MAGIC):] == MAGIC else after
                if opcode == FOOTER:
                    return None
                if opcode == 0:
                    return at
                self._take(opcode, content, at)
                at = after
            except (Short, struct.error):
                return at

    def _take(self, opcode: int, content: memoryview, at: int) -> None:
        if opcode == CHUNK:
            self.blocks.append(Block(at, read_chunk(content)))
        elif opcode == MESSAGE:
            if len(content) < MESSAGE_HEAD_BYTES:
                raise Short
            if not self.blocks or self.blocks[-1].head is not None:
                self.blocks.append(Block(at))
            self.blocks[-1].offsets.append(at)
        elif opcode == MESSAGE_INDEX:
            fields = Fields(content)
            channel = fields.number("H")
            if self.blocks:
                self.blocks[-1].indexes[channel] = fields.raw(fields.number("I"))
        elif opcode == ATTACHMENT:
            self._take_attachment(content, at)
        elif opcode == METADATA:
            fields = Fields(content)
            self.metadata.append((fields.text(), fields.texts()))
        elif opcode == HEADER:
            fields = Fields(content)
            fields.text()
            self.library = fields.text()
        else:
            self._define(opcode, content)

    def _take_attachment(self, content: memoryview, at: int) -> None:
        fields = Fields(content)
        fields.raw(16)
        name, media_type = fields.text(), fields.text()
        stored = fields.raw(fields.number("Q"))
        covered = fields.at
        crc = fields.number("I")
        if crc and crc != zlib.crc32(content[:covered]):
            self.damage.append(f"{self.path}: byte {at}: the attachment '{name}' is damaged and left out")
        else:
            self.attachments.append(Attachment(name, media_type, stored))

    def _find_channels(self) -> None:
        """Reads the chunks that may hold channels which the summary does not name."""
        for block in self.blocks:
            if block.head is None or (block.indexes and all(channel in self.channels for channel in block.indexes)):
                continue
            try:
                records = self.records(block)
            except Error:
                continue  # told when its messages are read
            for offset, opcode, length in walk(records):
                if opcode in (SCHEMA, CHANNEL):
                    try:
                        self._define(opcode, memoryview(records)[offset + HEAD_BYTES:offset + HEAD_BYTES + length])
                    except Short:
                        self.damage.append(f"{self.path}: byte {block.offset}: a channel or schema of this chunk is "
                                           "damaged")

    # The messages.
    def records(self, block: Block) -> bytes | memoryview:
        """The block's records, decompressed and their checksum found right; Error says why they are lost."""
        if block.head is None:
            return self.data
        head = block.head
        place = (f"{self.path}: byte {block.offset}: the chunk with the messages from "
                 f"{seconds(head.first_log_time_ns)} to {seconds(head.last_log_time_ns)} is lost")
        try:
            records = decompress(head.compression, head.records, head.uncompressed_bytes)
        except Error as problem:
            raise Error(f"{place}: {problem}") from None
        if head.crc and crc32(records) != head.crc:
            raise Error(f"{place}: its checksum is wrong")
        return records

    def expected(self, block: Block, channels: set[int]) -> int | None:
        """How many messages the indexes name; nothing if there is no index."""
        if block.head is None or not block.indexes:
            return None
        return sum(len(index) // 16 for channel, index in block.indexes.items() if channel in channels)

    def messages(self, block: Block, records: bytes | memoryview, channels: set[int]) -> tuple[np.ndarray, np.ndarray]:
        """Where in `records` the messages of these channels begin, in file order, and their heads (MESSAGE_HEAD)."""
        offsets = self._indexed(block, channels)
        if offsets is not None:
            heads = self._heads(records, offsets)
            if heads is not None and self._are_messages(heads, channels):
                return offsets, heads
        if block.head is None:
            offsets = np.array(block.offsets, dtype=np.int64)
        else:
            offsets = np.array([offset for offset, opcode, length in walk(records)
                                if opcode == MESSAGE and length >= MESSAGE_HEAD_BYTES], dtype=np.int64)
        heads = gather(records, offsets, MESSAGE_HEAD)
        wanted = np.isin(heads["channel"], np.array(sorted(channels), dtype=np.uint16))
        return offsets[wanted], heads[wanted]

    def _indexed(self, block: Block, channels: set[int]) -> np.ndarray | None:
        """What the message indexes say; nothing without them."""
        if block.head is None or not block.indexes or any(len(index) % 16 for index in block.indexes.values()):
            return None
        found = [np.frombuffer(block.indexes[channel], dtype="<i8")[1::2]
                 for channel in channels & block.indexes.keys()]
        if not found:
            return np.empty(0, dtype=np.int64)
        offsets = found[0].astype(np.int64) if len(found) == 1 else np.concatenate(found)
        return offsets if (offsets[1:] > offsets[:-1]).all() else np.unique(offsets)

    @staticmethod
    def _heads(records: bytes | memoryview, offsets: np.ndarray) -> np.ndarray | None:
        """The heads at these sorted places; nothing if one lies outside of the records."""
        if len(offsets) and (offsets[0] < 0 or offsets[-1] > len(records) - MESSAGE_HEAD.itemsize):
            return None
        return gather(records, offsets, MESSAGE_HEAD)

    @staticmethod
    def _are_messages(heads: np.ndarray, channels: set[int]) -> bool:
        if not ((heads["opcode"] == MESSAGE) & (heads["length"] >= MESSAGE_HEAD_BYTES)).all():
            return False
        if len(channels) == 1:
            return bool((heads["channel"] == next(iter(channels))).all())
        return bool(np.isin(heads["channel"], np.array(sorted(channels), dtype=np.uint16)).all())


def gather(data: bytes | memoryview, offsets: np.ndarray, dtype: str | np.dtype) -> np.ndarray:
    """The values of that type at these bytes, whatever their alignment; each must lie within the data."""
    kind = np.dtype(dtype)
    count = len(data) - kind.itemsize + 1
    if len(offsets) == 0 or count <= 0:
        return np.empty(len(offsets), dtype=kind)
    every: np.ndarray = np.ndarray((count,), dtype=np.dtype(("V", kind.itemsize)), buffer=data, strides=(1,))
    return every[offsets].view(kind)


def walk(records: bytes | memoryview) -> list[tuple[int, int, int]]:
    """Offset, opcode and length of each record, up to the first that does not fit."""
    found = []
    at, end = 0, len(records) - HEAD_BYTES
    while at <= end:
        opcode, length = _HEAD.unpack_from(records, at)
        if length > end - at:
            break
        found.append((at, opcode, length))
        at += HEAD_BYTES + length
    return found
