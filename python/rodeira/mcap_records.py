# SPDX-License-Identifier: Apache-2.0
"""The records of an MCAP file (https://mcap.dev/spec): an opcode, a length and the content, little-endian."""

from __future__ import annotations

import struct
from dataclasses import dataclass, field

MAGIC = b"\x89MCAP0\r\n"
HEAD_BYTES = 9           # opcode and length
FOOTER_BYTES = HEAD_BYTES + 20
MESSAGE_HEAD_BYTES = 22  # of a message's content, before its data

HEADER, FOOTER, SCHEMA, CHANNEL, MESSAGE, CHUNK, MESSAGE_INDEX, CHUNK_INDEX = range(0x01, 0x09)
ATTACHMENT, ATTACHMENT_INDEX, STATISTICS, METADATA, METADATA_INDEX, SUMMARY_OFFSET, DATA_END = range(0x09, 0x10)


class Short(Exception):
    """A record ends before its last field."""


class Fields:
    """Reads the fields of one record's content, or of a map in it."""

    def __init__(self, data: memoryview) -> None:
        self.data = data
        self.at = 0

    def raw(self, size: int) -> memoryview:
        if size > len(self.data) - self.at:
            raise Short
        self.at += size
        return self.data[self.at - size:self.at]

    def number(self, code: str) -> int:
        return int(struct.unpack("<" + code, self.raw(struct.calcsize("<" + code)))[0])

    def text(self) -> str:
        return bytes(self.raw(self.number("I"))).decode("utf-8", "backslashreplace")

    def texts(self) -> dict[str, str]:
        block = Fields(self.raw(self.number("I")))
        texts: dict[str, str] = {}
        while block.at < len(block.data):
            key = block.text()
            texts[key] = block.text()
        return texts

    def counts(self) -> dict[int, int]:
        block = self.raw(self.number("I"))
        if len(block) % 10:
            raise Short
        return {int(channel): int(count) for channel, count in struct.iter_unpack("<HQ", block)}


@dataclass(frozen=True)
class Schema:
    id: int
    name: str
    encoding: str
    text: str


@dataclass(frozen=True)
class Channel:
    id: int
    schema: int
    topic: str
    encoding: str
    metadata: dict[str, str] = field(hash=False)

    @property
    def source(self) -> str:
        """The node that published; for files of other programs the channel's number."""
        return self.metadata.get("source", f"channel {self.id}")


@dataclass(frozen=True)
class ChunkHead:
    first_log_time_ns: int
    last_log_time_ns: int
    uncompressed_bytes: int
    crc: int
    compression: str
    records: memoryview


def read_schema(content: memoryview) -> Schema:
    fields = Fields(content)
    return Schema(fields.number("H"), fields.text(), fields.text(), fields.text())


def read_channel(content: memoryview) -> Channel:
    fields = Fields(content)
    return Channel(fields.number("H"), fields.number("H"), fields.text(), fields.text(), fields.texts())


def read_chunk(content: memoryview) -> ChunkHead:
    fields = Fields(content)
    first, last, size, crc = (fields.number(code) for code in "QQQI")
    compression = fields.text()
    return ChunkHead(first, last, size, crc, compression, fields.raw(fields.number("Q")))


def read_statistics(content: memoryview) -> dict[int, int]:
    """Messages by channel."""
    fields = Fields(content)
    fields.raw(8 + 2 + 4 + 4 + 4 + 4 + 8 + 8)
    return fields.counts()


def seconds(time_ns: int) -> str:
    """'12.345 s', for sentences."""
    return f"{time_ns / 1e9:.3f} s"
