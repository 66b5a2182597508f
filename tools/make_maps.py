#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Writes the project's own traffic maps, configs/maps/*.motors, from the few numbers below.

  tools/make_maps.py [FOLDER]

A lane is laid from one pose to another: its two borders are cubic Bézier curves, circular arcs as far as a cubic is one
(handles of 4/3 tan(angle/4) radii). Lanes side by side share a curve. Coordinates are rounded to a millimetre, so the
same script gives the same bytes. Right-hand traffic; metres, x east, y north, angles from east to north.
"""
import math
import pathlib
import struct
import sys
import zlib

NONE, BOUNDARY, SINGLE, DASHED, DASHED_SAME, SPEED_CTRL = 0, 1, 2, 3, 4, 5
MIDDLE, START, END = 0, 1, 2
DRAWING_HEIGHT = "14.70026"  # where the original editor draws


class Pose:
    def __init__(self, x, y, heading):
        self.x, self.y, self.heading = x, y, heading

    def moved(self, ahead, left):
        c, s = math.cos(self.heading), math.sin(self.heading)
        return Pose(self.x + ahead * c - left * s, self.y + ahead * s + left * c, self.heading)


def border(a, b):
    """Four control points from pose to pose."""
    turn = math.remainder(b.heading - a.heading, math.tau)
    chord = math.hypot(b.x - a.x, b.y - a.y)
    if abs(turn) < 1e-6:
        handle = chord / 3
    else:
        handle = 4 / 3 * math.tan(abs(turn) / 4) * chord / (2 * math.sin(abs(turn) / 2))
    p, q = a.moved(handle, 0), b.moved(-handle, 0)
    return tuple((round(v.x, 3) + 0.0, round(v.y, 3) + 0.0) for v in (a, p, q, b))


def text(number):
    return f"{number:.3f}".rstrip("0").rstrip(".")


class Map:
    def __init__(self, name):
        self.name, self.curves, self.lanes, self.connections, self.heights = name, {}, [], [], {}
        self.picture, self.scale, self.lights = b"", 10, []

    def curve(self, points, z):
        for inverted in (False, True):
            key = points[::-1] if inverted else points
            if (key, z[::-1] if inverted else z) in self.curves:
                return self.curves[(key, z[::-1] if inverted else z)], inverted
        number = len(self.curves) + 1
        self.curves[(points, z)] = number
        if any(z):
            self.heights[number] = z
        return number, False

    def lane(self, a, b, width=3.25, left=SINGLE, right=BOUNDARY, mode=MIDDLE, z=(0, 0, 0, 0), end_width=None):
        """The lane from pose a to pose b of its middle; its number."""
        end_width = width if end_width is None else end_width
        sides = []
        for side, kind in ((0.5, left), (-0.5, right)):
            number, inverted = self.curve(border(a.moved(0, side * width), b.moved(0, side * end_width)), z)
            sides.append((number, inverted, kind))
        self.lanes.append((sides, mode))
        return len(self.lanes)

    def connect(self, a, b, stop=False):
        self.connections.append((a, b, stop))

    def chain(self, *lanes):
        for a, b in zip(lanes, lanes[1:]):
            self.connect(a, b)

    def write(self, folder):
        out = []
        for (points, _), number in self.curves.items():
            out.append(f"p,{number}," + ",".join(f"{text(x)},{DRAWING_HEIGHT},{text(y)}" for x, y in points))
        for number, (sides, mode) in enumerate(self.lanes, 1):
            out.append(f"l,{number}," + ",".join(f"{c},{i},{k}" for c, i, k in sides) + f",{mode}")
        out += [f"c,{a},{b},{stop},0,0,0" for a, b, stop in self.connections]
        out += [f"s,{text(self.scale)}", "i", ""]
        (folder / f"{self.name}.motors").write_bytes("\n".join(out).encode() + self.picture)
        companion = folder / f"{self.name}.motors.yaml"
        rows = ["rodeira: motors/1"]
        if self.heights:
            rows.append("heights_m:  # of a curve: z at its four control points")
            rows += [f"  {n}: [{', '.join(text(v) for v in z)}]" for n, z in self.heights.items()]
        if self.lights:
            rows += ["lights:  # of each junction; who is green: lanes, at whose end a light stands", "  - phases:"]
            rows += [
                f"      - {{green: [{', '.join(map(str, lanes))}], for_s: {seconds}}}" for lanes, seconds in self.lights
            ]
        if len(rows) > 1:
            companion.write_text("\n".join(rows + [""]))


def meadow(width, height):
    """A PNG of two greens in squares, for the ground."""
    rows = b"".join(b"\0" + bytes(((x // 8 + y // 8) % 2) for x in range(width)) for y in range(height))

    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    return (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, 8, 3, 0, 0, 0))
            + chunk(b"PLTE", bytes(
                (96, 128, 72, 104, 136, 80))) + chunk(b"IDAT", zlib.compress(rows, 9)) + chunk(b"IEND", b""))


LANE = 3.25  # width of a street's lane


def towards(x, y, angle, distance):
    """On the right-hand lane of an arm at `angle`, at `distance` from the node, driving to the node."""
    return Pose(x, y, angle + math.pi).moved(-distance, -LANE / 2)


def away(x, y, angle, distance):
    return Pose(x, y, angle).moved(distance, -LANE / 2)


def crossing_turns(plan, x, y, arms, reach):
    """Lanes over a crossing: arms = [(angle, lane that arrives, lane that leaves, STOP)]."""
    for angle, arrives, _, stop in arms:
        for other, _, leaves, _ in arms:
            if other == angle:
                continue
            turn = plan.lane(towards(x, y, angle, reach), away(x, y, other, reach), LANE, NONE, NONE)
            plan.connect(arrives, turn, stop)
            plan.connect(turn, leaves)


def ring(plan, x, y, arms, radius, reach, opening=math.radians(32), width=4.5):
    """A roundabout; arms by ascending angle, driven from east to north."""
    at = lambda a: Pose(x + radius * math.cos(a), y + radius * math.sin(a), a + math.pi / 2)
    passing, between = [], []
    for i, (angle, *_) in enumerate(arms):
        after = arms[(i + 1) % len(arms)][0] + (math.tau if i + 1 == len(arms) else 0)
        passing.append(plan.lane(at(angle - opening), at(angle + opening), width, BOUNDARY, DASHED_SAME))
        between.append(plan.lane(at(angle + opening), at(after - opening), width, BOUNDARY, BOUNDARY))
    for i, (angle, arrives, leaves, _) in enumerate(arms):
        enter = plan.lane(towards(x, y, angle, reach), at(angle + opening), LANE, NONE, BOUNDARY, end_width=width)
        leave = plan.lane(at(angle - opening), away(x, y, angle, reach), width, NONE, BOUNDARY, end_width=LANE)
        plan.chain(arrives, enter, between[i])
        plan.chain(between[i - 1], passing[i], between[i])
        plan.chain(between[i - 1], leave, leaves)


def four_arms(plan, near, far, minor=()):
    arms = []
    for angle in (0, math.pi / 2, math.pi, -math.pi / 2):
        arrives = plan.lane(towards(0, 0, angle, far), towards(0, 0, angle, near), LANE, DASHED, BOUNDARY, START)
        leaves = plan.lane(away(0, 0, angle, near), away(0, 0, angle, far), LANE, DASHED, BOUNDARY, END)
        arms.append((angle, arrives, leaves, angle in minor))
    return arms


def crossing():
    plan = Map("crossing")
    crossing_turns(plan, 0, 0, four_arms(plan, 12, 120, minor=(math.pi / 2, -math.pi / 2)), 12)
    plan.picture, plan.scale = meadow(96, 96), 26
    return plan


def roundabout():
    plan = Map("roundabout")
    arms = sorted(four_arms(plan, 34, 150))
    ring(plan, 0, 0, arms, 16, 34)
    plan.picture, plan.scale = meadow(96, 96), 32
    return plan


def ramp():
    """A carriageway of two lanes to the east; a ramp joins over a lane of acceleration, another leaves."""
    plan = Map("ramp")
    width, outer, inner, third = 3.75, 0.0, 3.75, -3.75
    stations = [-300, 0, 220, 290, 520, 590, 800]
    rows = {}
    for lane, y in (("outer", outer), ("inner", inner)):
        pieces = []
        for i, (a, b) in enumerate(zip(stations, stations[1:])):
            mode = START if i == 0 else END if i == len(stations) - 2 else MIDDLE
            beside = {1: SPEED_CTRL, 4: SPEED_CTRL}.get(i, NONE if i == 2 else BOUNDARY)
            left, right = (BOUNDARY, DASHED_SAME) if lane == "inner" else (DASHED_SAME, beside)
            pieces.append(plan.lane(Pose(a, y, 0), Pose(b, y, 0), width, left, right, mode))
        plan.chain(*pieces)
        rows[lane] = pieces
    bend = math.radians(30)
    begin, turned = Pose(-260, -95, bend), Pose(-150, -95 + 110 * math.tan(bend), bend)
    join = [plan.lane(begin, turned, width, BOUNDARY, BOUNDARY, START),
            plan.lane(turned, Pose(0, third, 0), width, BOUNDARY, BOUNDARY),
            plan.lane(Pose(0, third, 0), Pose(220, third, 0), width, SPEED_CTRL, BOUNDARY),
            plan.lane(Pose(220, third, 0), Pose(290, outer, 0), width, NONE, BOUNDARY)]
    plan.chain(*join, rows["outer"][3])
    leave = [
        plan.lane(Pose(520, outer, 0), Pose(590, third, 0), width, SPEED_CTRL, BOUNDARY),
        plan.lane(Pose(590, third, 0), Pose(690, third - 100 * math.tan(bend / 2), -bend), width, BOUNDARY, BOUNDARY),
        plan.lane(Pose(690, third - 100 * math.tan(bend / 2), -bend),
                  Pose(690, third - 100 * math.tan(bend / 2), -bend).moved(110, 0), width, BOUNDARY, BOUNDARY, END)
    ]
    plan.chain(rows["outer"][3], *leave)
    return plan


def town():
    """Nine nodes, the middle one a roundabout; eight streets lead out."""
    plan = Map("town")
    shift = {(0, 0): (-8, 5), (1, 0): (6, -9), (2, 0): (3, 8), (0, 1): (-5, 7), (1, 1): (0, 0), (2, 1): (9, -6),
             (0, 2): (7, -4), (1, 2): (-8, 6), (2, 2): (-3, -7)}
    nodes = {n: (n[0] * 130 - 130 + dx, n[1] * 130 - 130 + dy) for n, (dx, dy) in shift.items()}
    outside = {
        "w0": ((0, 0), (-250, -120)),
        "s1": ((1, 0), (10, -250)),
        "e0": ((2, 0), (250, -130)),
        "w1": ((0, 1), (-250, 15)),
        "e1": ((2, 1), (250, -10)),
        "n0": ((0, 2), (-130, 250)),
        "n1": ((1, 2), (-15, 250)),
        "e2": ((2, 2), (250, 110))
    }
    reach = {n: 34 if n == (1, 1) else 14 for n in nodes}
    arms = {n: [] for n in nodes}

    def street(a, b, pa, pb, ra, rb, minor):
        angle = math.atan2(pb[1] - pa[1], pb[0] - pa[0])
        length = math.dist(pa, pb)
        back = math.remainder(angle + math.pi, math.tau)
        there = plan.lane(away(*pa, angle, ra), away(*pa, angle, length - rb), LANE, DASHED, BOUNDARY,
                          END if b is None else MIDDLE)
        here = plan.lane(away(*pb, back, rb), away(*pb, back, length - ra), LANE, DASHED, BOUNDARY,
                         START if b is None else MIDDLE)
        arms[a].append((angle, here, there, minor))
        if b is not None:
            arms[b].append((back, there, here, minor))

    for x in range(3):
        for y in range(3):
            for other in ((x + 1, y), (x, y + 1)):
                if other in nodes:
                    street((x, y), other, nodes[(x, y)], nodes[other], reach[(x, y)], reach[other], minor=other[0] == x)
    for node, place in outside.values():
        street(node, None, nodes[node], place, reach[node], 0, minor=False)
    for node, around in arms.items():
        if node == (1, 1):
            ring(plan, *nodes[node], sorted(around), 16, reach[node])
        else:
            crossing_turns(plan, *nodes[node], sorted(around), reach[node])
    plan.picture, plan.scale = meadow(128, 128), 52
    return plan


def overpass():
    """A road to the north goes over one to the east on ramps of 7 %; two slip roads join them on the ground.
    They are clear of the road that they leave before it climbs: beside a ramp they would lie below it."""
    plan = Map("overpass")
    height, level, low = 6.0, (0.0,) * 4, 320
    stations = [-low, -215, -170, -40, 40, 170, low]
    heights = [level, level, (0.0, 0.0, height, height), (height,) * 4, (height, height, 0.0, 0.0), level]
    for quarter in (0, math.pi):
        c, s = math.cos(quarter), math.sin(quarter)
        pose = lambda x, y, heading: Pose(c * x - s * y, s * x + c * y, heading + quarter)
        over = []
        for i, (a, b) in enumerate(zip(stations, stations[1:])):
            mode = START if i == 0 else END if i == 5 else MIDDLE
            z = heights[i]
            over.append(
                plan.lane(pose(LANE / 2, a, math.pi / 2), pose(LANE / 2, b, math.pi / 2), LANE, SINGLE, BOUNDARY, mode,
                          z))
        under = [plan.lane(pose(a, -LANE / 2, 0), pose(b, -LANE / 2, 0), LANE, SINGLE, BOUNDARY, mode)
                 for a, b, mode in ((-low, 210, START), (210, low, END))]
        plan.chain(*over)
        plan.chain(*under)
        slip = [plan.lane(pose(LANE / 2, -215, math.pi / 2), pose(6, -190, math.radians(70)), LANE, NONE, BOUNDARY),
                plan.lane(pose(6, -190, math.radians(70)), pose(120, -16, math.radians(20)), LANE, BOUNDARY, BOUNDARY),
                plan.lane(pose(120, -16, math.radians(20)), pose(210, -LANE / 2, 0), LANE, NONE, BOUNDARY)]
        plan.chain(over[0], *slip, under[1])
    return plan


def lights():
    """A crossing with traffic lights: east and west, then north and south."""
    plan = Map("lights")
    arms = four_arms(plan, 12, 160)
    crossing_turns(plan, 0, 0, arms, 12)
    plan.lights = [([arms[0][1], arms[2][1]], 25), ([arms[1][1], arms[3][1]], 20)]
    plan.picture, plan.scale = meadow(96, 96), 34
    return plan


if __name__ == "__main__":
    target = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else pathlib.Path(__file__).parent.parent / "configs/maps")
    target.mkdir(parents=True, exist_ok=True)
    for make in (crossing, roundabout, ramp, town, overpass, lights):
        make().write(target)
