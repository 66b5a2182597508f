#!/usr/bin/env python3
"""Invents the world "N222" and prints its world file: python3 tools/author_n222.py > configs/worlds/n222.yaml

Nothing of it is surveyed. What is taken from the real road between Regua and Pinhao: 93 bends on 27 km (3.4 a km), radii
of 30 to 200 m, a carriageway of at least 5.50 m, paved shoulders of 0.50 m. The rest is drawn from a seed. The axis is
accepted where it stays within the terrain and keeps clear of itself; `rodeira world check` has the last word.
"""
import math

BENDS = 19
LANE_M, SHOULDER_M, EDGE_LINE_M = 2.90, 0.50, 0.12
GENERAL_HEADING_DEG = 20.0


class Draw:
    """A small generator of its own (SplitMix64), so that the file never depends on a library's version."""

    def __init__(self, seed):
        self.state = seed

    def bits(self):
        self.state = (self.state + 0x9E3779B97F4A7C15) % 2**64
        z = self.state
        z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9 % 2**64
        z = (z ^ (z >> 27)) * 0x94D049BB133111EB % 2**64
        return z ^ (z >> 31)

    def uniform(self, low, high):
        return low + (high - low) * (self.bits() >> 11) / 2**53


def bends(draw):
    """(radius, clothoid length, arc length, straight before) of each bend; radius positive to the left."""
    heading = math.radians(GENERAL_HEADING_DEG)
    found = []
    for _ in range(BENDS):
        radius = round(math.exp(draw.uniform(math.log(30.0), math.log(200.0))) / 5.0) * 5.0
        clothoid = max(15.0, round(0.3 * radius))
        # Turn back towards the general direction: the farther from it, the surer and the more.
        astray = heading - math.radians(GENERAL_HEADING_DEG)
        left = draw.uniform(-1.0, 1.0) > 1.6 * astray
        turn = draw.uniform(0.5, 1.3) + (min(1.2, 0.8 * abs(astray)) if left == (astray < 0.0) else 0.0)
        turn = min(turn, 2.6)
        arc = max(8.0, round(radius * turn - clothoid))
        heading += (1.0 if left else -1.0) * (arc + clothoid) / radius
        found.append((radius if left else -radius, clothoid, arc, round(draw.uniform(30.0, 260.0))))
    return found


def elements(road):
    for radius, clothoid, arc, straight in road:
        yield ("line", straight, 0.0, 0.0)
        yield ("clothoid", clothoid, 0.0, 1.0 / radius)
        yield ("arc", arc, 1.0 / radius, 1.0 / radius)
        yield ("clothoid", clothoid, 1.0 / radius, 0.0)
    yield ("line", 120.0, 0.0, 0.0)


def walk(road, step=2.0):
    x = y = 0.0
    heading = math.radians(GENERAL_HEADING_DEG)
    points = [(x, y)]
    for _, length, k0, k1 in elements(road):
        count = math.ceil(length / step)
        h = length / count
        for i in range(count):
            middle = heading + (k0 + (k1 - k0) * (i + 0.5) / count / 2) * (i + 0.5) * h
            x, y = x + h * math.cos(middle), y + h * math.sin(middle)
            points.append((x, y))
        heading += 0.5 * (k0 + k1) * length
    return points


def keeps_clear(points, clearance=75.0):
    """No two parts of the axis, farther apart along it than a hairpin is long, are nearer than this."""
    for i in range(0, len(points), 4):
        for j in range(i + 110, len(points), 4):
            if math.dist(points[i], points[j]) < clearance:
                return False
    return True


def choose():
    for seed in range(222, 4000):
        road = bends(Draw(seed))
        length = sum(element[1] for element in elements(road))
        if not 5300.0 <= length <= 5700.0 or min(abs(bend[0]) for bend in road) > 35.0:
            continue
        points = walk(road)
        width = max(p[0] for p in points) - min(p[0] for p in points)
        height = max(p[1] for p in points) - min(p[1] for p in points)
        if max(width, height) < 4600.0 and keeps_clear(points):
            return seed, road, length, points
    raise SystemExit("no seed gives a road that fits")


def profile(seed, length):
    """Points of vertical intersection: grades of up to 7 %, parabolas of K = 1200 to 3000 m."""
    draw = Draw(seed + 1_000_000)
    points, s, z, before = [(0.0, 120.0, 0.0)], 0.0, 120.0, None
    while length - s > 320.0:
        step = round(draw.uniform(180.0, 320.0) / 10.0) * 10.0
        grade = draw.uniform(-0.07, 0.07) - 0.0004 * (z - 130.0)
        grade = max(-0.07, min(0.07, grade))
        s, z = s + step, z + round(grade * step, 1)
        points.append((s, round(z, 1), 0.0))
    points.append((math.ceil(length), points[-1][1], 0.0))
    for i in range(1, len(points) - 1):
        g = [(points[i + n][1] - points[i + n - 1][1]) / (points[i + n][0] - points[i + n - 1][0]) for n in (0, 1)]
        room = min(points[i][0] - points[i - 1][0], points[i + 1][0] - points[i][0])
        parabola = min(0.9 * room, max(40.0, abs(g[1] - g[0]) * draw.uniform(1200.0, 3000.0)))
        points[i] = (points[i][0], points[i][1], round(parabola / 10.0) * 10.0)
    return points


def centre_line(road, length):
    """(from, to, kind): continuous through bends below 100 m of radius, with approach strokes before them."""
    closed, s = [], 0.0
    for radius, clothoid, arc, straight in road:
        begin, end = s + straight, s + straight + 2 * clothoid + arc
        s = end
        if abs(radius) < 100.0:
            begin, end = max(0.0, begin - 15.0), end + 15.0
            if closed and begin - closed[-1][1] < 90.0:
                closed[-1] = (closed[-1][0], end)
            else:
                closed.append((begin, end))
    pieces, at = [], 0.0
    for begin, end in closed:
        approach = max(at, begin - 60.0)
        if approach > at:
            pieces.append((at, approach, "free"))
        if begin > approach:
            pieces.append((approach, begin, "approach"))
        pieces.append((begin, end, "closed"))
        at = end
    pieces.append((at, length, "free"))
    return pieces


def number(value):
    return f"{value:.3f}".rstrip("0").rstrip(".")


def write(seed, road, length, points):
    box = [(min(p[i] for p in points) + max(p[i] for p in points)) / 2 for i in (0, 1)]
    print(f"""# A world inspired by the Portuguese national road 222 between Regua and Pinhao. Invented, not surveyed: only the
# number of bends a km, their range of radii and the widths are those of the real road. Written by
# tools/author_n222.py (its seed {seed}); the format is described in docs/formats.md.
rodeira: world/1
name: N222
description: {number(length)} m of winding hill road, {BENDS} bends, inspired by N222

friction: {{asphalt: 1.0, gravel: 0.6, grass: 0.55, soil: 0.65, road_mark: 0.9}}

terrain:
  surface: grass
  generate:                     # hills from a seed, level with the road near it
    seed: 222
    columns: 513
    rows: 513
    spacing_m: 10
    west_m: -2560
    south_m: -2560
    below_m: 0.3
    flat_m: 14
    full_m: 260
    relief:
      - {{wavelength_m: 1900, amplitude_m: 260}}
      - {{wavelength_m: 800, amplitude_m: 110}}
      - {{wavelength_m: 350, amplitude_m: 40}}
      - {{wavelength_m: 140, amplitude_m: 10}}
      - {{wavelength_m: 60, amplitude_m: 2}}
    # A local system whose origin lies in the Douro valley; the hills are none of that place.
    projection: "+proj=tmerc +lat_0=41.16 +lon_0=-7.66 +k=1 +x_0=0 +y_0=0 +ellps=GRS80 +units=m"

start: {{road: n222, lane: -1, s_m: 30}}

roads:
  - id: n222
    start: {{x_m: {number(round(-box[0]))}, y_m: {number(round(-box[1]))}, heading_deg: {number(GENERAL_HEADING_DEG)}}}
    axis:""")
    s = 0.0
    for n, (radius, clothoid, arc, straight) in enumerate(road, 1):
        side = "left" if radius > 0.0 else "right"
        print(f"      # bend {n}, to the {side}, from s = {number(s + straight)} m")
        print(f"      - line: {{length_m: {number(straight)}}}")
        print(f"      - clothoid: {{length_m: {number(clothoid)}, radius_end_m: {number(radius)}}}")
        print(f"      - arc: {{length_m: {number(arc)}, radius_m: {number(radius)}}}")
        print(f"      - clothoid: {{length_m: {number(clothoid)}, radius_start_m: {number(radius)}}}")
        s += straight + 2 * clothoid + arc
    print("      - line: {length_m: 120}")
    print("    vertical:                   # points where two grades meet, each rounded by a parabola")
    for s, z, parabola in profile(seed, length):
        tail = f", parabola_m: {number(parabola)}" if parabola else ""
        print(f"      - {{s_m: {number(s)}, z_m: {number(z)}{tail}}}")
    print(f"""    section:
      lanes:                      # carriageway {number(2 * LANE_M)} m
        - {{id: -1, width_m: {number(LANE_M)}, speed_limit_kmh: 70}}
        - {{id: 1, width_m: {number(LANE_M)}, speed_limit_kmh: 70}}
      surface: asphalt
      crossfall: {{kind: crown, fall: 0.025}}
      shoulders:
        left: {{width_m: {number(SHOULDER_M)}, surface: asphalt, fall: 0.025}}
        right: {{width_m: {number(SHOULDER_M)}, surface: asphalt, fall: 0.025}}
      verge: {{width_m: 1.2, fall: 0.08, surface: grass}}
      blend_m: 9
    marks:""")
    edge = LANE_M + EDGE_LINE_M / 2
    for t in (-edge, edge):
        print(f"      - {{t_m: {number(t)}, width_m: {number(EDGE_LINE_M)}, kind: continuous}}")
    kinds = {"free": "dashed, stroke_m: 4, gap_m: 8", "approach": "dashed, stroke_m: 5, gap_m: 2", "closed": "continuous"}
    for begin, end, kind in centre_line(road, length):
        print(f"      - {{t_m: 0, width_m: 0.1, from_s_m: {number(begin)}, to_s_m: {number(end)}, kind: {kinds[kind]}}}")


if __name__ == "__main__":
    write(*choose())
