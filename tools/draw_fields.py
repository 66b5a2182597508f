#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Draws an invented plan of fields, 256 x 208 pixels, as a picture to drape over a terrain: draw_fields.py FILE.png

Cells around seeded points are fields of one colour each with furrows; hedges lie between them.
"""
import math
import random
import struct
import sys
import zlib

WIDTH, HEIGHT = 256, 208
COLOURS = [(124, 140, 66), (150, 146, 80), (96, 122, 60), (168, 150, 92), (134, 116, 78), (110, 134, 74)]


def main(target):
    dice = random.Random(4)
    fields = [(dice.uniform(0, WIDTH), dice.uniform(0, HEIGHT), dice.choice(COLOURS), dice.uniform(0, math.pi),
               dice.uniform(3, 7)) for _ in range(40)]
    rows = []
    for y in range(HEIGHT):
        row = bytearray([0])
        for x in range(WIDTH):
            near = sorted((math.hypot(x - f[0], y - f[1]), f) for f in fields)[:2]
            (first, field), (second, _) = near
            _, _, colour, angle, furrow = field
            shade = 1.0 + 0.07 * math.sin(2.0 * math.pi *
                                          (x * math.cos(angle) + y * math.sin(angle)) / furrow) + dice.uniform(
                                              -0.03, 0.03)
            if second - first < 2.2:
                colour, shade = (66, 84, 44), 1.0 + dice.uniform(-0.12, 0.12)
            row += bytes(max(0, min(255, int(c * shade))) for c in colour)
        rows.append(bytes(row))

    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    header = struct.pack(">IIBBBBB", WIDTH, HEIGHT, 8, 2, 0, 0, 0)
    with open(target, "wb") as out:
        out.write(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"IDAT", zlib.compress(b"".join(rows), 9))
                  + chunk(b"IEND", b""))


if __name__ == "__main__":
    main(sys.argv[1])
