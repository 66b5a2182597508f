# SPDX-License-Identifier: Apache-2.0
"""Writes MCAP files by the specification (https://mcap.dev/spec), in forms that Rodeira's own writer does not use."""

from __future__ import annotations

import struct
import zlib

MAGIC = b"\x89MCAP0\r\n"


def text(value: str) -> bytes:
    return struct.pack("<I", len(value.encode())) + value.encode()


def texts(values: dict[str, str]) -> bytes:
    inner = b"".join(text(key) + text(value) for key, value in values.items())
    return struct.pack("<I", len(inner)) + inner


def record(opcode: int, content: bytes) -> bytes:
    return struct.pack("<BQ", opcode, len(content)) + content


def schema(number: int, name: str, idl: str, encoding: str = "omgidl") -> bytes:
    return record(0x03, struct.pack("<H", number) + text(name) + text(encoding) + text(idl))


def channel(number: int, of_schema: int, topic: str, source: str | None = None, encoding: str = "cdr") -> bytes:
    meta = {} if source is None else {"source": source}
    return record(0x04, struct.pack("<HH", number, of_schema) + text(topic) + text(encoding) + texts(meta))


def message(of_channel: int, time_ns: int, payload: bytes) -> bytes:
    return record(0x05, struct.pack("<HIQQ", of_channel, 0, time_ns, time_ns) + payload)


def compressed(kind: str, records: bytes) -> bytes:
    if kind == "zstd":
        import zstandard
        return zstandard.ZstdCompressor().compress(records)
    if kind == "lz4":
        import lz4.frame
        return lz4.frame.compress(records)
    return records


def chunk(records: bytes, kind: str = "", indexes: bool = False, crc: int | None = None) -> bytes:
    """A Chunk record; with `indexes` also its MessageIndex records."""
    inner = compressed(kind, records)
    crc = zlib.crc32(records) if crc is None else crc
    out = record(0x06, struct.pack("<QQQI", 0, 0, len(records), crc) + text(kind) +
                 struct.pack("<Q", len(inner)) + inner)
    if indexes:
        found: dict[int, bytes] = {}
        at = 0
        while at < len(records):
            opcode, length = struct.unpack_from("<BQ", records, at)
            if opcode == 0x05:
                number, _, time_ns = struct.unpack_from("<HIQ", records, at + 9)
                found[number] = found.get(number, b"") + struct.pack("<QQ", time_ns, at)
            at += 9 + length
        for number, entries in found.items():
            out += record(0x07, struct.pack("<HI", number, len(entries)) + entries)
    return out


def attachment(name: str, data: bytes) -> bytes:
    content = struct.pack("<QQ", 0, 0) + text(name) + text("text/plain") + struct.pack("<Q", len(data)) + data
    return record(0x09, content + struct.pack("<I", zlib.crc32(content)))


def metadata(name: str, entries: dict[str, str]) -> bytes:
    return record(0x0C, text(name) + texts(entries))


def mcap(data: bytes, summary: bytes = b"", library: str = "handmade") -> bytes:
    """A whole file: header, data, end of the data, summary if there is one, footer."""
    body = MAGIC + record(0x01, text("") + text(library)) + data + record(0x0F, struct.pack("<I", 0))
    start = len(body) if summary else 0
    footer = struct.pack("<BQQQ", 0x02, 20, start, 0)
    return body + summary + footer + struct.pack("<I", zlib.crc32(summary + footer)) + MAGIC
