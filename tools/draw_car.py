#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Draws the mechanism of a multibody vehicle file from the side, from above and from the front.

    tools/draw_car.py FILE.yaml FILE.svg

Rods and arms are lines between their points, carriers are filled, springs thick, points are dots (those of the chassis
hollow), wheels as they stand. Needs python3-yaml; `rsvg-convert FILE.svg -o FILE.png` makes a picture of it.
"""
import sys

import yaml

SCALE = 240.0  # pixels a metre
MARGIN = 60.0
COLOURS = {
    "plate": "#3a6ea5",
    "rod": "#3a6ea5",
    "carrier": "#b5542c",
    "spring": "#2b8a3e",
    "chassis": "#888888",
    "wheel": "#222222"
}


def main(source, target):
    car = yaml.safe_load(open(source, encoding="utf-8"))
    mechanism = car["mechanism"]
    at = {name: point["at_m"] for name, point in mechanism["points"].items()}
    radius, width = car["wheel"]["radius_m"], car["wheel"]["width_m"]
    hubs = [car["wheels"][name]["centre"] for name in ("front_left", "front_right", "rear_left", "rear_right")]
    half = max(abs(p[1]) for p in at.values()) + 0.5 * width
    reach = max(abs(p[0]) for p in at.values()) + radius
    high = max(p[2] for p in at.values()) + 0.1
    views = [  # title, the axes across and up on paper, origin on paper
        ("from the left", lambda p: (-p[0], p[2]), (MARGIN + reach * SCALE, MARGIN + high * SCALE)),
        ("from above", lambda p: (-p[0], -p[1]), (MARGIN + reach * SCALE, 2 * MARGIN + (high + half) * SCALE)),
        ("from the front", lambda p: (p[1], p[2]), (2 * MARGIN + (2 * reach + half) * SCALE, MARGIN + high * SCALE)),
    ]
    size = (3 * MARGIN + (2 * reach + 2 * half) * SCALE, 3 * MARGIN + (high + 2 * half) * SCALE)
    out = [
        f'<svg xmlns="http://www.w3.org/2000/svg" width="{size[0]:.0f}" height="{size[1]:.0f}" '
        'font-family="sans-serif" font-size="14">',
        '<rect width="100%" height="100%" fill="white"/>'
    ]
    for number, (title, project, origin) in enumerate(views):
        def xy(p):
            u, v = project(p)
            return origin[0] + SCALE * u, origin[1] - SCALE * v

        def line(a, b, colour, thick):
            (x1, y1), (x2, y2) = xy(a), xy(b)
            out.append(
                f'<line x1="{x1:.1f}" y1="{y1:.1f}" x2="{x2:.1f}" y2="{y2:.1f}" stroke="{colour}" '
                f'stroke-width="{thick}" stroke-linecap="round"/>'
            )

        def shape(points, colour, filled):
            text = " ".join(f"{x:.1f},{y:.1f}" for x, y in map(xy, points))
            fill = f'fill="{colour}" fill-opacity="0.25"' if filled else 'fill="none"'
            out.append(f'<polygon points="{text}" {fill} stroke="{colour}" stroke-width="2"/>')

        left, top = origin[0] - SCALE * (half if number == 2 else reach), origin[1] - SCALE * (half
                                                                                               if number == 1 else high)
        out.append(f'<text x="{left:.1f}" y="{top - 14:.1f}">{title}</text>')
        if number != 1:
            line((reach, half, 0.0), (-reach, -half, 0.0), "#aaaaaa", 1)
        for hub in hubs:
            x, y, z = at[hub]
            if number == 0:
                cx, cy = xy(at[hub])
                out.append(
                    f'<circle cx="{cx:.1f}" cy="{cy:.1f}" r="{radius * SCALE:.1f}" fill="none" '
                    f'stroke="{COLOURS["wheel"]}" stroke-width="1.5"/>'
                )
            else:
                corners = [
                    (x + i * radius, y + j * 0.5 * width, z + k * radius)
                    for i, j, k in ([(1, 1, 0), (1, -1, 0), (-1, -1,
                                                             0), (-1, 1,
                                                                  0)] if number == 1 else [(0, 1,
                                                                                            1), (0, -1,
                                                                                                 1), (0, -1,
                                                                                                      -1), (0, 1, -1)])
                ]
                shape(corners, COLOURS["wheel"], False)
        for name, body in mechanism["bodies"].items():
            points = [at[p] for p in body["points"]]
            if name == "chassis":
                for p in points[1:]:
                    x, y = xy(p)
                    out.append(
                        f'<circle cx="{x:.1f}" cy="{y:.1f}" r="4" fill="white" stroke="{COLOURS["chassis"]}" '
                        'stroke-width="2"/>'
                    )
            elif body.get("kind") == "plate":
                shape(points[:3], COLOURS["plate"], True)
            elif name.endswith("carrier"):
                for p in points:
                    line(p, at[next(h for h in hubs if h in body["points"])], COLOURS["carrier"], 3)
            else:
                line(points[0], points[1], COLOURS["rod"], 3)
        for name, distance in mechanism["distances"].items():
            if name in mechanism["forces"]:
                line(at[distance["points"][0]], at[distance["points"][1]], COLOURS["spring"], 6)
        line(at["column_top"], at["column_foot"], COLOURS["chassis"], 3)
        for name, p in at.items():
            if name in mechanism["bodies"]["chassis"]["points"]:
                continue
            x, y = xy(p)
            out.append(f'<circle cx="{x:.1f}" cy="{y:.1f}" r="3" fill="black"/>')
    legend = [("chassis: 22 points", "chassis"), ("arms, rods, rack", "rod"), ("carriers", "carrier"),
              ("springs and dampers", "spring"), ("wheels", "wheel")]
    x, y = views[2][2][0] - half * SCALE, views[1][2][1] - 40
    for i, (text, colour) in enumerate(legend):
        out.append(
            f'<line x1="{x:.1f}" y1="{y + 26 * i - 5:.1f}" x2="{x + 30:.1f}" y2="{y + 26 * i - 5:.1f}" '
            f'stroke="{COLOURS[colour]}" stroke-width="5"/>'
        )
        out.append(f'<text x="{x + 40:.1f}" y="{y + 26 * i:.1f}">{text}</text>')
    out.append("</svg>")
    open(target, "w", encoding="utf-8").write("\n".join(out) + "\n")


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    main(sys.argv[1], sys.argv[2])
