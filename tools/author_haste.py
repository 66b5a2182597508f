#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Invents the world "HASTE" and prints its world file: python3 tools/author_haste.py > configs/worlds/haste.yaml

No curvature table of the road that the name stands for is public. Everything here is invented: 2 x 3.5 m, shoulders
of 0.75 m, radii of 250 to 1000 m with clothoids of A = R/2 to R/3, grades of up to 4 %. Six roads cross the main one at
grade, one passes over it on a bridge; five villages lie on it. All of it is drawn from a seed.
"""
import math

from authoring import Draw, number

SEED = 2003
LENGTH_M = 29_600.0
VILLAGES = ["Alvite", "Bouça", "Cerdeira", "Freixo", "Moinhos"]
CROSSINGS = 6


def main_axis(draw):
    """Elements of the main road, about to the east: (kind, length, radius, A)."""
    found, heading, total = [], 0.0, 0.0
    while total < LENGTH_M:
        straight = round(draw.uniform(150.0, 700.0))
        radius = round(math.exp(draw.uniform(math.log(250.0), math.log(1000.0))) / 10.0) * 10.0
        a = round(radius * draw.uniform(1.0 / 3.0, 0.5))
        clothoid = a * a / radius
        left = draw.uniform(-1.0, 1.0) > 2.0 * heading
        turn = draw.uniform(0.25, 0.7) + 0.7 * abs(heading) * (left == (heading < 0.0))
        arc = max(60.0, round(radius * turn - clothoid))
        heading += (1.0 if left else -1.0) * (arc + clothoid) / radius
        signed = radius if left else -radius
        found += [("line", straight, 0.0, 0.0), ("in", clothoid, signed, a), ("arc", arc, signed, 0.0),
                  ("out", clothoid, signed, a)]
        total += straight + 2.0 * clothoid + arc
    found.append(("line", 300.0, 0.0, 0.0))
    return found, total + 300.0


def straights(axis):
    """(from, to) of the straight pieces, in stations."""
    s, found = 0.0, []
    for kind, length, _, _ in axis:
        if kind == "line":
            found.append((s, s + length))
        s += length
    return found


def profile(draw, length):
    """(s, z, parabola): grades of up to 4 %, parabolas of K = 5000 to 12 000 m."""
    points, s, z = [(0.0, 180.0, 0.0)], 0.0, 180.0
    while length - s > 1400.0:
        step = round(draw.uniform(600.0, 1300.0) / 10.0) * 10.0
        grade = max(-0.04, min(0.04, draw.uniform(-0.035, 0.035) - 0.0002 * (z - 190.0)))
        s, z = s + step, round(z + grade * step, 1)
        points.append((s, z, 0.0))
    points.append((math.ceil(length), points[-1][1], 0.0))
    for i in range(1, len(points) - 1):
        g = [(points[i + n][1] - points[i + n - 1][1]) / (points[i + n][0] - points[i + n - 1][0]) for n in (0, 1)]
        room = min(points[i][0] - points[i - 1][0], points[i + 1][0] - points[i][0])
        parabola = min(0.9 * room, max(60.0, abs(g[1] - g[0]) * draw.uniform(5000.0, 12_000.0)))
        points[i] = (points[i][0], points[i][1], round(parabola / 10.0) * 10.0)
    return points


def height(points, s):
    """Of the profile, parabolas included."""
    for i in range(1, len(points) - 1):
        at, z, parabola = points[i]
        if abs(s - at) < 0.5 * parabola:
            g = [(points[i + n][1] - points[i + n - 1][1]) / (points[i + n][0] - points[i + n - 1][0]) for n in (0, 1)]
            into = s - (at - 0.5 * parabola)
            return z - 0.5 * parabola * g[0] + g[0] * into + (g[1] - g[0]) / (2.0 * parabola) * into * into
    for before, after in zip(points, points[1:]):
        if s <= after[0]:
            return before[1] + (after[1] - before[1]) * (s - before[0]) / (after[0] - before[0])
    return points[-1][1]


def walk(axis):
    x = y = heading = 0.0
    points = [(x, y)]
    for kind, length, radius, _ in axis:
        k0 = 0.0 if kind in ("line", "in") else 1.0 / radius
        k1 = 0.0 if kind in ("line", "out") else 1.0 / radius
        count = math.ceil(length / 10.0)
        for i in range(count):
            h = length / count
            middle = heading + (k0 + (k1 - k0) * (i + 0.5) / count / 2) * (i + 0.5) * h
            x, y = x + h * math.cos(middle), y + h * math.sin(middle)
            points.append((x, y))
        heading += 0.5 * (k0 + k1) * length
    return points


def print_axis(axis):
    for kind, length, radius, a in axis:
        if kind == "line":
            print(f"      - line: {{length_m: {number(length)}}}")
        elif kind == "arc":
            print(f"      - arc: {{length_m: {number(length)}, radius_m: {number(radius)}}}")
        else:
            print(
                f"      - clothoid: {{a_m: {number(a)}, radius_{'end' if kind == 'in' else 'start'}_m: "
                f"{number(radius)}}}"
            )


def print_village(name, begin, end):
    """Signs and houses of a village on the main road."""
    print(f"""      - {{type: town, text: {name}, s_m: {number(begin)}}}
      - {{type: speed_limit, value: 50, s_m: {number(begin + 5)}}}
      - {{type: end_of_town, text: {name}, s_m: {number(end)}}}
      - {{type: town, text: {name}, s_m: {number(end)}, for: against}}
      - {{type: speed_limit, value: 50, s_m: {number(end - 5)}, for: against}}
      - {{type: end_of_town, text: {name}, s_m: {number(begin)}, for: against}}""")


def main():
    draw = Draw(SEED)
    axis, length = main_axis(draw)
    points = profile(draw, length)
    track = walk(axis)
    low = [min(p[i] for p in track) for i in (0, 1)]
    high = [max(p[i] for p in track) for i in (0, 1)]
    margin = 1300.0
    spacing = 25.0
    columns = math.ceil((high[0] - low[0] + 2 * margin) / spacing) + 1
    rows = math.ceil((high[1] - low[1] + 2 * margin) / spacing) + 1
    long_ones = [(a, b) for a, b in straights(axis) if b - a > 330.0 and a > 900.0 and b < length - 900.0]
    apart, used = [], -1e9
    for a, b in long_ones:
        if a - used > 1500.0:
            apart.append((a, b))
            used = a
    sites = [
        apart[round(i * (len(apart) - 1) / (len(VILLAGES) + CROSSINGS))] for i in range(len(VILLAGES) + CROSSINGS + 1)
    ]
    villages = [(name, site[0] + 20.0, site[1] - 20.0) for name, site in zip(VILLAGES, sites[1::2])]
    rest = [site for site in sites if all(site[0] + 20.0 != village[1] for village in villages)]
    crossings = [round(0.5 * (a + b)) for a, b in rest[:CROSSINGS]]
    over = round(0.5 * (rest[CROSSINGS][0] + rest[CROSSINGS][1]))

    described = (f"a main road of {number(length)} m, {CROSSINGS} roads that cross it, one above it, "
                 f"{len(VILLAGES)} villages; all invented")
    road = f"a main road of {number(length / 1000)} km"
    print(f"""# A world for long drives: {road} through hills and villages, crossed by other roads. Invented:
# tools/author_haste.py says how, and wrote this file (its seed {SEED}); format: docs/reference/world-files.md.
rodeira: world/2
name: HASTE
description: {described}

terrain:
  surface: grass
  generate:
    seed: {SEED}
    columns: {columns}
    rows: {rows}
    spacing_m: {number(spacing)}
    west_m: {number(math.floor(low[0] - margin))}
    south_m: {number(math.floor(low[1] - margin))}
    base_z_m: 195
    below_m: 0.5
    flat_m: 12
    full_m: 350
    reach_m: 700
    relief:
      - {{wavelength_m: 2300, amplitude_m: 150}}
      - {{wavelength_m: 900, amplitude_m: 55}}
      - {{wavelength_m: 330, amplitude_m: 16}}
      - {{wavelength_m: 120, amplitude_m: 3}}
    projection: "+proj=tmerc +lat_0=41.3 +lon_0=-8.1 +k=1 +x_0=0 +y_0=0 +ellps=GRS80 +units=m"

start: {{road: main, lane: -1, s_m: 40}}

templates:
  country:
    lanes: [{{id: -1, width_m: 2.75}}, {{id: 1, width_m: 2.75}}]
    crossfall: {{kind: crown, fall: 0.025}}
    shoulders: {{left: {{width_m: 0.5}}, right: {{width_m: 0.5}}}}
    verge: {{width_m: 1.2, fall: 0.08}}
    lines:
      - {{lane: 0, kind: dashed, stroke_m: 3, gap_m: 6, width_m: 0.1}}

roads:
  - id: main
    start: {{x_m: 0, y_m: 0, heading_deg: 0}}
    axis:""")
    print_axis(axis)
    print("    vertical:")
    for s, z, parabola in points:
        tail = f", parabola_m: {number(parabola)}" if parabola else ""
        print(f"      - {{s_m: {number(s)}, z_m: {number(z)}{tail}}}")
    print("    section: {template: rural}")
    print("    speed_limits:\n      - {s_m: 0, speed_kmh: 90}")
    for name, begin, end in villages:
        print(f"      - {{s_m: {number(begin)}, speed_kmh: 50}}\n      - {{s_m: {number(end)}, speed_kmh: 90}}")
    print("    lines:")
    for lane in (-1, 1):
        print(f"      - {{lane: {lane}, kind: continuous, width_m: 0.12}}")
    closed, s = [], 0.0
    for kind, piece, radius, _ in axis:
        if kind == "in":
            begin = s
        s += piece
        if kind == "out" and abs(radius) < 450.0:
            closed.append((max(0.0, begin - 10.0), s + 10.0))
    closed += [(begin, end) for _, begin, end in villages] + [(c - 90.0, c + 90.0) for c in crossings]
    at = 0.0
    for begin, end in sorted(closed):
        begin, end = max(begin, at), max(end, at)
        if begin - at > 120.0:
            print(
                f"      - {{lane: 0, kind: dashed, stroke_m: 4, gap_m: 8, from_s_m: {number(at)}, to_s_m: "
                f"{number(begin - 60)}}}"
            )
            print(f"      - {{lane: 0, kind: dashed_warn, from_s_m: {number(begin - 60)}, to_s_m: {number(begin)}}}")
        else:
            begin = at
        if end > begin:
            print(f"      - {{lane: 0, kind: continuous, from_s_m: {number(begin)}, to_s_m: {number(end)}}}")
        at = end
    print(f"      - {{lane: 0, kind: dashed, stroke_m: 4, gap_m: 8, from_s_m: {number(at)}}}")
    print("    signs:")
    for village in villages:
        print_village(*village)
    s = 0.0
    for kind, piece, radius, _ in axis:
        if kind == "in" and abs(radius) < 320.0 and s > 200.0:
            print(f"      - {{type: bend_{'left' if radius > 0 else 'right'}, s_m: {number(s - 120)}}}")
        s += piece
    print("    objects:")
    for name, begin, end in villages:
        for side in ("left", "right"):
            print(
                f"      - {{type: house, side: {side}, beside_m: 12, from_s_m: {number(begin + 15)}, every_m: 32, "
                f"to_s_m: {number(end - 15)}}}"
            )
        print(
            f"      - {{type: lamp, side: right, beside_m: 0.3, from_s_m: {number(begin)}, every_m: 40, to_s_m: "
            f"{number(end)}}}"
        )
    print(f"      - {{type: filling_station, side: right, beside_m: 14, s_m: {number(villages[2][2] + 60)}}}")
    print(f"      - {{type: guard_rail, side: right, from_s_m: {number(over - 40)}, to_s_m: {number(over + 40)}}}")
    print(
        f"      - {{type: tree, side: left, beside_m: 9, from_s_m: {number(villages[0][2] + 40)}, every_m: 25, to_s_m: "
        f"{number(villages[0][2] + 640)}}}"
    )
    for i, s in enumerate(crossings):
        z, turn = height(points, s), round(draw.uniform(62.0, 118.0))
        first, second = round(draw.uniform(-0.03, 0.03), 3), round(draw.uniform(-0.03, 0.03), 3)
        radius = round(draw.uniform(150.0, 350.0) / 10.0) * 10.0 * (1 if i % 2 else -1)
        print(f"""  - id: cross{i + 1}
    name: cross{i + 1}
    place: {{road: main, s_m: {number(s)}, turn_deg: {turn}, own_s_m: 700}}
    axis:
      - arc: {{length_m: 150, radius_m: {number(radius)}}}
      - clothoid: {{length_m: 60, radius_start_m: {number(radius)}}}
      - line: {{length_m: 990}}
      - clothoid: {{length_m: 60, radius_end_m: {number(-radius)}}}
      - arc: {{length_m: 140, radius_m: {number(-radius)}}}
    vertical:
      - {{s_m: 0, z_m: {number(z - first * 550)}}}
      - {{s_m: 550, z_m: {number(z)}, parabola_m: 120}}
      - {{s_m: 850, z_m: {number(z)}, parabola_m: 120}}
      - {{s_m: 1400, z_m: {number(z + second * 550)}}}
    section: {{template: country}}
    speed_limit_kmh: 70""")
    z = height(points, over)
    print(f"""  - id: bridge
    place: {{road: main, s_m: {number(over)}, turn_deg: 85, own_s_m: 500}}
    axis:
      - line: {{length_m: 1000}}
    vertical:
      - {{s_m: 0, z_m: {number(z - 2)}}}
      - {{s_m: 200, z_m: {number(z)}, parabola_m: 60}}
      - {{s_m: 500, z_m: {number(z + 9.5)}, parabola_m: 200}}
      - {{s_m: 800, z_m: {number(z)}, parabola_m: 60}}
      - {{s_m: 1000, z_m: {number(z - 2)}}}
    section: {{template: country}}
    speed_limit_kmh: 70
    bridges:
      - {{from_s_m: 475, to_s_m: 525, name: over the main road}}
    objects:
      - {{type: guard_rail, side: left, from_s_m: 455, to_s_m: 545}}
      - {{type: guard_rail, side: right, from_s_m: 455, to_s_m: 545}}""")
    print("\njunctions:")
    for i, s in enumerate(crossings):
        control = "stop" if i % 3 == 0 else "give_way"
        print(
            f"  - {{id: j{i + 1}, roads: [{{road: main, s_m: {number(s)}}}, {{road: cross{i + 1}, s_m: 700}}], "
            f"control: {control}}}"
        )


if __name__ == "__main__":
    main()
