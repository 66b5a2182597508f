# SPDX-License-Identifier: Apache-2.0
"""Encodes values in CDR version 1 with struct.pack, one value after the other, by the rules of OMG CORBA 3.3, part 2,
9.3: a number lies at a multiple of its size from the start of the message. Shares no line with the reader."""

from __future__ import annotations

import struct


class Cdr:
    def __init__(self, order: str = "<") -> None:
        self.order = order
        self.bytes = bytearray()

    def put(self, code: str, *values: float) -> "Cdr":
        size = struct.calcsize("=" + code)
        for value in values:
            self.bytes += bytes(-len(self.bytes) % size)
            self.bytes += struct.pack(self.order + code, value)
        return self

    def text(self, value: str | bytes) -> "Cdr":
        raw = value if isinstance(value, bytes) else value.encode() + b"\0"
        self.put("I", len(raw))
        self.bytes += raw
        return self

    def payload(self) -> bytes:
        return bytes([0, self.order == "<", 0, 0]) + bytes(self.bytes)
