#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Invents the world "N222" and prints its world file: python3 tools/author_n222.py > configs/worlds/n222.yaml

Nothing of it is surveyed. From the real road between Regua and Pinhao are: 93 bends on 27 km (3.4 a km), radii
of 30 to 200 m, a carriageway of at least 5.50 m, paved shoulders of 0.50 m. The rest is drawn from a seed. The axis is
accepted where it stays within the terrain and keeps clear of itself; `rodeira world check` has the last word.

The objects beside the road follow from it and from the hills, which are computed as in `common/world/road/hills.cpp`:
guard rails where the land falls away, chevrons and warnings at the sharp bends, rows of vines, olives and trees where
there is room.
"""
import bisect
import math

from authoring import Draw, number

BENDS = 19
LANE_M, SHOULDER_M, EDGE_LINE_M = 2.90, 0.50, 0.12
GENERAL_HEADING_DEG = 20.0
VERGE_M, FALL, VERGE_FALL = 1.2, 0.025, 0.08
EDGE_M = LANE_M + SHOULDER_M + VERGE_M  # of all that is built, from the axis
SHARP_M = 50.0                          # radius: from here on a bend has a warning and chevrons
# No hill of this seed hides the road where overtaking is allowed: tests/common/world/road/n222_test.cpp.
HILLS = {"seed": 230, "columns": 513, "rows": 513, "spacing_m": 10, "west_m": -2560, "south_m": -2560, "base_z_m": 120,
         "below_m": 0.3, "flat_m": 5, "full_m": 90, "reach_m": 270}
REACH_M = 20  # of cuts and fills: less than to the centre of the sharpest bend, where they would meet themselves
RELIEF = [(1900, 260), (800, 110), (350, 40), (140, 10), (60, 2)]  # wavelength, amplitude


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


def height(points, s):
    """Of the profile and its slope, parabolas included."""
    grades = [(b[1] - a[1]) / (b[0] - a[0]) for a, b in zip(points, points[1:])]
    for i in range(1, len(points) - 1):
        at, z, parabola = points[i]
        into = s - (at - 0.5 * parabola)
        if parabola and 0.0 <= into < parabola:
            turn = (grades[i] - grades[i - 1]) / parabola
            z_there = z - 0.5 * parabola * grades[i - 1] + grades[i - 1] * into + 0.5 * turn * into * into
            return z_there, grades[i - 1] + turn * into
    i = max((k for k in range(len(points) - 1) if points[k][0] <= s), default=0)
    return points[i][1] + grades[i] * (s - points[i][0]), grades[i]


class Axis:
    """Where the road lies: (x, y, heading, curvature) at a station."""

    def __init__(self, road, origin, length, grades):
        self.length, self.grades, self.stations, self.poses = length, grades, [], []
        x, y = origin
        heading, s = math.radians(GENERAL_HEADING_DEG), 0.0
        for _, piece, k0, k1 in elements(road):
            count = math.ceil(piece)
            h = piece / count
            for i in range(count):
                self.stations.append(s + i * h)
                k = k0 + (k1 - k0) * i / count
                self.poses.append((x, y, heading, k))
                middle = heading + 0.5 * h * (k + 0.25 * (k1 - k0) / count)
                x, y = x + h * math.cos(middle), y + h * math.sin(middle)
                heading += h * (k + 0.5 * (k1 - k0) / count)
            s += piece
        self.stations.append(s)
        self.poses.append((x, y, heading, 0.0))

    def at(self, s):
        i = min(max(bisect.bisect_right(self.stations, s) - 1, 0), len(self.stations) - 1)
        x, y, heading, k = self.poses[i]
        ahead = s - self.stations[i]
        middle = heading + 0.5 * k * ahead
        return x + ahead * math.cos(middle), y + ahead * math.sin(middle), heading + k * ahead, k

    def beside(self, s, t):
        x, y, heading, _ = self.at(s)
        return x - t * math.sin(heading), y + t * math.cos(heading)


class Hills:
    """The terrain that the world file's `generate` makes, before it is cut and filled."""

    def __init__(self, road, axis):
        self.road, begin = [], 0.0
        for _, length, _, _ in elements(road):
            steps = math.ceil(length / 40.0)
            for i in range(steps + 1):
                s = begin + length * i / steps
                share = length / steps * (0.5 if i in (0, steps) else 1.0)
                self.road.append((*axis.at(s)[:2], height(axis.grades, s)[0], share))
            begin += length
        self.gradients = {}

    @staticmethod
    def draw(keys):
        z = 0x9E3779B97F4A7C15
        for key in keys:
            z = ((z ^ key) + 0x9E3779B97F4A7C15) % 2**64
            z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9 % 2**64
            z = (z ^ (z >> 27)) * 0x94D049BB133111EB % 2**64
            z ^= z >> 31
        return -1.0 + 2.0 * (z >> 11) / 2**53

    def noise(self, layer, east, north):
        across, along = east / RELIEF[layer][0], north / RELIEF[layer][0]
        column, row = int(across), int(along)
        u, v = across - column, along - row
        value = {}
        for i in (0, 1):
            for j in (0, 1):
                key = (HILLS["seed"], layer, column + i, row + j)
                if key not in self.gradients:
                    self.gradients[key] = (self.draw((*key, 0)), self.draw((*key, 1)))
                g = self.gradients[key]
                value[i, j] = g[0] * (u - i) + g[1] * (v - j)
        fu, fv = (w * w * w * (w * (w * 6.0 - 15.0) + 10.0) for w in (u, v))
        south, north = (value[0, j] + fu * (value[1, j] - value[0, j]) for j in (0, 1))
        return south + fv * (north - south)

    def at(self, x, y):
        weights = 4.0 / HILLS["reach_m"] ** 3
        heights, nearest = weights * HILLS["base_z_m"], 1e18
        for px, py, pz, length in self.road:
            squared = (x - px) ** 2 + (y - py) ** 2
            weight = length * max(0.0, 1.0 - squared / HILLS["reach_m"]**2)**3 / (squared + HILLS["flat_m"]**2)**2
            weights, heights = weights + weight, heights + weight * (pz - HILLS["below_m"])
            nearest = min(nearest, squared)
        u = min(1.0, max(0.0, (math.sqrt(nearest) - HILLS["flat_m"]) / (HILLS["full_m"] - HILLS["flat_m"])))
        east, north = x - HILLS["west_m"], y - HILLS["south_m"]
        grown = u * u * (3.0 - 2.0 * u)
        return heights / weights + grown * sum(a * self.noise(i, east, north) for i, (_, a) in enumerate(RELIEF))


def spans(road):
    """(begin, end, radius) of each bend with its clothoids."""
    found, s = [], 0.0
    for radius, clothoid, arc, straight in road:
        found.append((s + straight, s + straight + 2 * clothoid + arc, radius))
        s = found[-1][1]
    return found


def signs(road, grades, length):
    """Limits at both ends, warnings before sharp bends and long grades, chevrons outside; one post at a place."""
    found = [("{type: speed_limit, value: 70, s_m: 20}", 20.0, "along"),
             (f"{{type: speed_limit, value: 70, s_m: {number(length - 20)}, for: against}}", length - 20.0, "against")]

    def put(text, s, way):
        if 10.0 < s < length - 10.0 and all(way != other or abs(s - at) > 35.0 for _, at, other in found):
            found.append((f"{{{text}, s_m: {number(s)}{', for: against' if way == 'against' else ''}}}", s, way))

    for begin, end, radius in spans(road):
        if abs(radius) > SHARP_M:
            continue
        left = radius > 0.0
        put(f"type: bend_{'left' if left else 'right'}", begin - 90.0, "along")
        put(f"type: bend_{'right' if left else 'left'}", end + 90.0, "against")
    for (s0, z0, p0), (s1, z1, p1) in zip(grades, grades[1:]):
        percent = round(100.0 * abs(z1 - z0) / (s1 - s0))
        if percent < 6:
            continue
        put(f"type: {'uphill' if z1 > z0 else 'downhill'}, value: {percent}", round(s0 + 0.5 * p0), "along")
        put(f"type: {'downhill' if z1 > z0 else 'uphill'}, value: {percent}", round(s1 - 0.5 * p1), "against")
    lines = [text for text, _, _ in sorted(found, key=lambda sign: sign[1])]
    for begin, end, radius in spans(road):
        if abs(radius) > SHARP_M:
            continue
        outside, every = "right" if radius > 0.0 else "left", 12
        for way, first in (("along", begin), ("against", begin + 6)):
            where = f"from_s_m: {number(first)}, every_m: {every}, to_s_m: {number(end)}"
            lines.append(f"{{type: chevron, side: {outside}, z_m: 1, for: {way}, {where}}}")
    return lines


def rails(road, axis, hills):
    """(side, from, to): where the finished ground, FAR_M beyond the verge, lies more than DEEP_M below its edge."""
    FAR_M, DEEP_M, STEP_M = 12.0, 2.5, 6.0
    found = []
    for side, sign in (("left", 1.0), ("right", -1.0)):
        runs = []
        for k in range(int(axis.length / STEP_M) + 1):
            s = k * STEP_M
            edge = height(axis.grades, s)[0] - FALL * (LANE_M + SHOULDER_M) - VERGE_FALL * VERGE_M
            if hills.at(*axis.beside(s, sign * (EDGE_M + FAR_M))) > edge - DEEP_M:
                continue
            begin, end = max(0.0, s - 8.0), min(axis.length, s + 8.0)
            if runs and begin - runs[-1][1] < 25.0:
                runs[-1] = (runs[-1][0], end)
            else:
                runs.append((begin, end))
        found += [(side, begin, end) for begin, end in runs if end - begin >= 30.0]
    return found


def rows(road, axis, hills, draw):
    """Rows of plants beside the road, and some houses: (type, side, beside, from, every, to, height).

    On a bend's inner side they keep the sight clear, and none comes near another part of the road.
    """
    found = []

    def fits(side, beside, begin, end):
        sign = 1.0 if side == "left" else -1.0
        for s in range(math.floor(begin), math.ceil(end), 4):
            t = sign * (EDGE_M + beside)
            if axis.at(s)[3] * t > 0.0 and (beside < 15.0 or axis.at(s)[3] * t > 0.6):
                return False
            x, y = axis.beside(s, t)
            if any(abs(s - at) > 1.2 * (EDGE_M + beside) and math.dist((x, y), pose[:2]) < EDGE_M + 8.0
                   for at, pose in zip(axis.stations[::4], axis.poses[::4])):
                return False
        return True

    def level(side, beside, begin, end):
        """How far the land rises or falls from the road's edge, at most."""
        sign = 1.0 if side == "left" else -1.0
        return max(abs(hills.at(*axis.beside(s, sign * (EDGE_M + beside))) - height(axis.grades, s)[0])
                   for s in (begin, 0.5 * (begin + end), end))

    s = 60.0
    while s < axis.length - 120.0:
        side = "left" if draw.uniform(0.0, 1.0) < 0.5 else "right"
        what, length = draw.uniform(0.0, 1.0), round(draw.uniform(50.0, 130.0))
        begin, end = round(s), round(s) + length
        if what < 0.3:    # vines, in rows along the slope
            for row in range(4):
                if fits(side, 9.0 + 3.0 * row, begin, end):
                    found.append(("bush", side, 9.0 + 3.0 * row, begin, 2.5, end, 1.3))
        elif what < 0.65:  # olives
            for row in range(3):
                beside = round(7.0 + 7.0 * row + draw.uniform(0.0, 2.0), 1)
                if fits(side, beside, begin, end):
                    tall = round(draw.uniform(3.5, 5.5), 1)
                    found.append(("tree", side, beside, begin + 3 * row, 8 + row, end, tall))
        else:             # a wood
            for row in range(4):
                beside, every = round(6.5 + 5.0 * row + draw.uniform(0.0, 3.5), 1), round(draw.uniform(7.0, 16.0), 1)
                if fits(side, beside, begin, end):
                    found.append(("tree", side, beside, begin + round(draw.uniform(0.0, 9.0)), every, end,
                                  round(draw.uniform(5.0, 11.0), 1)))
        if draw.uniform(0.0, 1.0) < 0.2:
            other = "right" if side == "left" else "left"
            if fits(other, 20.0, begin, begin + 16) and level(other, 20.0, begin, begin + 16) < 2.5:
                found.append(("house", other, 20.0, begin + 8, None, None, 6.5))
        s += draw.uniform(45.0, 110.0)
    return found


def write(seed, road, length, points):
    box = [(min(p[i] for p in points) + max(p[i] for p in points)) / 2 for i in (0, 1)]
    origin, grades = (round(-box[0]), round(-box[1])), profile(seed, length)
    axis = Axis(road, origin, length, grades)
    hills = Hills(road, axis)
    print("# A world inspired by the Portuguese national road 222 between Regua and Pinhao. "
          "Invented, not surveyed: only the")
    print(f"""# number of bends a km, their range of radii and the widths are those of the real road. Written by
# tools/author_n222.py (its seed {seed}); the format is described in docs/reference/world-files.md.
rodeira: world/2
name: N222
description: {number(length)} m of winding hill road, {BENDS} bends, inspired by N222

friction: {{asphalt: 1.0, gravel: 0.6, grass: 0.55, soil: 0.65, road_mark: 0.9}}

terrain:
  surface: grass
  generate:                     # hills from a seed, level with the road near it""")
    for key, value in HILLS.items():
        print(f"    {key}: {value}")
    print("    relief:")
    for wavelength, amplitude in RELIEF:
        print(f"      - {{wavelength_m: {wavelength}, amplitude_m: {amplitude}}}")
    print(f"""    # A local system whose origin lies in the Douro valley; the hills are none of that place.
    projection: "+proj=tmerc +lat_0=41.16 +lon_0=-7.66 +k=1 +x_0=0 +y_0=0 +ellps=GRS80 +units=m"

start: {{road: n222, lane: -1, s_m: 30}}

roads:
  - id: n222
    kind: rural
    start: {{x_m: {number(origin[0])}, y_m: {number(origin[1])}, heading_deg: {number(GENERAL_HEADING_DEG)}}}
    axis:""")
    s = 0.0
    for n, (radius, clothoid, arc, straight) in enumerate(road, 1):
        side = "left" if radius > 0.0 else "right"
        up = height(grades, s + straight)[1] > 0.04 and height(grades, s + straight + 2 * clothoid + arc)[1] > 0.04
        print(f"      # bend {n}, to the {side}{', uphill' if up else ''}, from s = {number(s + straight)} m")
        print(f"      - line: {{length_m: {number(straight)}}}")
        print(f"      - clothoid: {{length_m: {number(clothoid)}, radius_end_m: {number(radius)}}}")
        print(f"      - arc: {{length_m: {number(arc)}, radius_m: {number(radius)}}}")
        print(f"      - clothoid: {{length_m: {number(clothoid)}, radius_start_m: {number(radius)}}}")
        s += straight + 2 * clothoid + arc
    print("      - line: {length_m: 120}")
    print("    vertical:                   # points where two grades meet, each rounded by a parabola")
    for s, z, parabola in grades:
        tail = f", parabola_m: {number(parabola)}" if parabola else ""
        print(f"      - {{s_m: {number(s)}, z_m: {number(z)}{tail}}}")
    print(f"""    speed_limit_kmh: 70
    section:
      lanes:                      # carriageway {number(2 * LANE_M)} m
        - {{id: -1, width_m: {number(LANE_M)}}}
        - {{id: 1, width_m: {number(LANE_M)}}}
      crossfall: {{kind: crown, fall: {FALL}}}
      shoulders:
        left: {{width_m: {number(SHOULDER_M)}, fall: {FALL}}}
        right: {{width_m: {number(SHOULDER_M)}, fall: {FALL}}}
      verge: {{width_m: {number(VERGE_M)}, fall: {VERGE_FALL}}}
      slopes: {{cut: 1.5, fill: 2, reach_m: {REACH_M}}}
    lines:""")
    edge = LANE_M + EDGE_LINE_M / 2
    for t in (-edge, edge):
        print(f"      - {{t_m: {number(t)}, width_m: {number(EDGE_LINE_M)}, kind: continuous}}")
    kinds = {"free": "dashed, stroke_m: 4, gap_m: 8", "approach": "dashed, stroke_m: 5, gap_m: 2",
             "closed": "continuous"}
    for begin, end, kind in centre_line(road, length):
        where = f"from_s_m: {number(begin)}, to_s_m: {number(end)}"
        print(f"      - {{t_m: 0, width_m: 0.1, {where}, kind: {kinds[kind]}}}")
    print("    signs:")
    for line in signs(road, grades, length):
        print(f"      - {line}")
    print("    objects:")
    for side in ("left", "right"):
        print(f"      - {{type: post, side: {side}, beside_m: -0.8, from_s_m: 25, every_m: 50}}")
    for side, begin, end in rails(road, axis, hills):
        print(f"      - {{type: guard_rail, side: {side}, from_s_m: {number(begin)}, to_s_m: {number(end)}}}")
    for kind, side, beside, begin, every, end, tall in rows(road, axis, hills, Draw(seed + 2_000_000)):
        where = f"s_m: {number(begin)}"
        if every is not None:
            where = f"from_s_m: {number(begin)}, every_m: {number(every)}, to_s_m: {number(end)}"
        print(f"      - {{type: {kind}, side: {side}, beside_m: {number(beside)}, {where}, height_m: {number(tall)}}}")


if __name__ == "__main__":
    write(*choose())
