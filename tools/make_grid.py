#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Writes a town of N x N crossings as a traffic map, for benchmarks: priority to the right, streets of 200 m.

  tools/make_grid.py N FILE.motors

Every crossing has all turns; streets lead out on all four sides.
"""
import math
import pathlib
import sys

from make_maps import DASHED, BOUNDARY, END, LANE, MIDDLE, START, Map, away, crossing_turns

LENGTH, REACH, OUT = 200, 14, 100


def grid(count, name):
    plan = Map(name)
    arms = {(x, y): [] for x in range(count) for y in range(count)}
    for (x, y), here in arms.items():
        for angle, dx, dy in ((0, 1, 0), (math.pi / 2, 0, 1), (math.pi, -1, 0), (-math.pi / 2, 0, -1)):
            other = arms.get((x + dx, y + dy))
            if other is not None and dx + dy < 0:
                continue  # laid from the other end
            far = LENGTH - REACH if other is not None else OUT
            there = plan.lane(away(LENGTH * x, LENGTH * y, angle, REACH), away(LENGTH * x, LENGTH * y, angle, far),
                              LANE, DASHED, BOUNDARY, MIDDLE if other is not None else END)
            back = math.remainder(angle + math.pi, math.tau)
            end = (LENGTH * x + dx * (LENGTH if other is not None else OUT), LENGTH * y + dy *
                   (LENGTH if other is not None else OUT))
            start = REACH if other is not None else 0
            come = plan.lane(away(*end, back, start), away(*end, back, (LENGTH if other is not None else OUT) - REACH),
                             LANE, DASHED, BOUNDARY, MIDDLE if other is not None else START)
            here.append((angle, come, there, False))
            if other is not None:
                other.append((back, there, come, False))
    for (x, y), here in arms.items():
        crossing_turns(plan, LENGTH * x, LENGTH * y, here, REACH)
    return plan


if __name__ == "__main__":
    path = pathlib.Path(sys.argv[2])
    path.parent.mkdir(parents=True, exist_ok=True)
    grid(int(sys.argv[1]), path.stem).write(path.parent)
