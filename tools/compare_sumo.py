#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""What SUMO does where docs/explanation/traffic.md compares this project's traffic with it: four cars that meet, a
closed town, a queue at a light, a turn, a roundabout's entry.

    tools/compare_sumo.py [four | town | queue | turn | roundabout]...     default: all; needs Debian's package `sumo`
    tools/compare_sumo.py networks [--rodeira PROGRAM] [--settings FILE] [--only NAME]...
                                                both programs on netgenerate's networks, as a table

Each network is made by netconvert or netgenerate. Each number is counted from SUMO's own output, in a temporary folder.
"""
import argparse
import csv
import math
import os
import pathlib
import random
import shutil
import subprocess
import sys
import tempfile
import xml.etree.ElementTree as xml

ARMS = {"e": (200, 0), "n": (0, 200), "w": (-200, 0), "s": (0, -200)}


def run(folder, *command):
    done = subprocess.run([str(word) for word in command],
                          cwd=folder,
                          stdout=subprocess.PIPE,
                          stderr=subprocess.STDOUT,
                          text=True)
    if done.returncode != 0:
        sys.exit(f"compare_sumo.py: '{command[0]}' ended with status {done.returncode}:\n{done.stdout[-2000:]}")


def write(folder, name, text):
    (folder / name).write_text(text)


def crossing(folder, kind):
    """Four arms of 200 m and one lane each way around a node of a kind."""
    nodes = "".join(f'<node id="{name}" x="{x}" y="{y}"/>' for name, (x, y) in ARMS.items())
    edges = "".join(
        f'<edge id="{a}in" from="{a}" to="c" numLanes="1" speed="13.89"/><edge id="{a}out" from="c" to="{a}" '
        'numLanes="1" speed="13.89"/>'
        for a in ARMS)
    write(folder, "x.nod.xml", f'<nodes><node id="c" x="0" y="0" type="{kind}"/>{nodes}</nodes>')
    write(folder, "x.edg.xml", f"<edges>{edges}</edges>")
    run(folder, "netconvert", "-n", "x.nod.xml", "-e", "x.edg.xml", "--no-turnarounds", "-o", "net.xml")


def sumo(folder, step_s, end_s, *more):
    run(folder, "sumo", "-n", "net.xml", "-r", "routes.xml", "--step-length", step_s, "--end", end_s, "--no-step-log",
        "--seed", 1, *more)


def four(folder):
    """Four cars straight on, with priority to the right: when the last one has arrived."""
    crossing(folder, "right_before_left")
    over = {"e": "w", "w": "e", "n": "s", "s": "n"}
    write(
        folder, "routes.xml", "<routes>" + "".join(f'<trip id="{a}" depart="0" from="{a}in" to="{b}out"/>'
                                                   for a, b in over.items()) + "</routes>")
    for step_s in (1, 0.1, 0.01):
        sumo(folder, step_s, 600, "--tripinfo-output", "trips.xml")
        last = max(float(trip.get("duration")) for trip in xml.parse(folder / "trips.xml").getroot())
        print(f"four cars that meet, steps of {step_s} s: the last trip takes {last:.1f} s")


def town(folder):
    """10 x 10 crossings 200 m apart, 45 cars a kilometre of lane, half an hour: how many cars SUMO teleports."""
    run(folder, "netgenerate", "--grid", "--grid.number", 10, "--grid.length", 200, "-j", "right_before_left",
        "--no-turnarounds.except-deadend", "true", "-o", "net.xml")
    root = xml.parse(folder / "net.xml").getroot()
    edges = [edge.get("id") for edge in root.iter("edge") if edge.get("function") != "internal"]
    onward = {edge: [] for edge in edges}
    for connection in root.iter("connection"):
        if connection.get("from") in onward and connection.get("to") in onward:
            onward[connection.get("from")].append(connection.get("to"))
    draws = random.Random(1)
    count = round(45 * len(edges) * 0.2)
    routes = []
    for number in range(count):
        way = [edges[number % len(edges)]]
        while len(way) < 160:
            way.append(draws.choice(onward[way[-1]]))
        routes.append(
            f'<vehicle id="{number}" depart="0" departPos="random_free"><route edges="{" ".join(way)}"/></vehicle>')
    write(folder, "routes.xml", "<routes>" + "\n".join(routes) + "</routes>")
    sumo(folder, 1, 1800, "--statistic-output", "said.xml")
    said = xml.parse(folder / "said.xml").getroot()
    teleports = said.find("teleports")
    print(
        f"closed town, {count} cars on {0.2 * len(edges):.0f} km: {teleports.get('total')} taken off the road "
        f"({teleports.get('yield')} at a crossing, {teleports.get('jam')} in a jam), "
        f"{said.find('vehicles').get('inserted')} had found room")


def queue(folder):
    """A queue of forty at a light that turns green: vehicles an hour over the line, from the fifth to the 25th."""
    write(
        folder, "x.nod.xml",
        '<nodes><node id="a" x="0" y="0"/><node id="b" x="1000" y="0" type="traffic_light"/><node id="c" x="2000" '
        'y="0"/></nodes>'
    )
    write(
        folder, "x.edg.xml",
        '<edges><edge id="in" from="a" to="b" numLanes="1" speed="13.89"/><edge id="out" from="b" to="c" numLanes="1" '
        'speed="13.89"/></edges>'
    )
    run(folder, "netconvert", "-n", "x.nod.xml", "-e", "x.edg.xml", "-o", "net.xml")
    light = next(xml.parse(folder / "net.xml").getroot().iter("tlLogic"))
    write(
        folder, "light.xml",
        f'<additional><tlLogic id="{light.get("id")}" type="static" programID="queue"><phase duration="300" state="r"/>'
        '<phase duration="600" state="G"/></tlLogic>'
        '<instantInductionLoop id="line" lane="in_0" pos="-1" file="passed.xml"/></additional>')
    for model in ("Krauss", "IDM"):
        for step_s in (1, 0.1):
            write(
                folder, "routes.xml",
                f'<routes><vType id="car" carFollowModel="{model}"/><route id="way" edges="in out"/>'
                '<flow id="f" type="car" route="way" begin="0" end="200" number="40" departSpeed="max"/></routes>')
            sumo(folder, step_s, 900, "-a", "light.xml")
            times = [
                float(at.get("time")) for at in xml.parse(folder / "passed.xml").getroot().iter("instantOut")
                if at.get("state") == "leave"
            ]
            print(f"saturation flow, {model}, steps of {step_s} s: {3600 * 20 / (times[24] - times[4]):.0f} an hour")


def turn(folder):
    """One car turns left and one right at the crossing: acceleration and jerk, sampled every 10 ms."""
    crossing(folder, "right_before_left")
    for name, out in (("left", "sout"), ("right", "nout")):
        write(folder, "routes.xml", f'<routes><trip id="t" depart="0" from="ein" to="{out}"/></routes>')
        sumo(folder, 0.01, 120, "--fcd-output", "cars.xml", "--precision", 6)
        seen = [(float(v.get("angle")), float(v.get("speed")))
                for v in xml.parse(folder / "cars.xml").getroot().iter("vehicle")]
        rates = [math.radians((b[0] - a[0] + 180) % 360 - 180) / 0.01 for a, b in zip(seen, seen[1:])]
        lateral = [rate * at[1] for rate, at in zip(rates, seen)]
        along = [(b[1] - a[1]) / 0.01 for a, b in zip(seen, seen[1:])]
        jerk = max(max(abs(b - a) / 0.01 for a, b in zip(of, of[1:])) for of in (lateral, along))
        print(
            f"turning {name}: {max(abs(a) for a in lateral):.1f} m/s2 sideways, "
            f"{math.degrees(max(abs(r) for r in rates)):.0f} deg/s, changes of acceleration of {jerk:.0f} m/s3"
        )


def roundabout(folder):
    """A ring of 16 m radius with four arms: vehicles an hour that enter from a queue.

    The arm before the queue's sends cars past it. The cars of both leave at the arm after.
    """
    points = [(math.cos(angle), math.sin(angle)) for angle in (0, math.pi / 2, math.pi, 3 * math.pi / 2)]
    nodes = "".join(
        f'<node id="r{i}" x="{16 * x:.3f}" y="{16 * y:.3f}" type="priority"/><node id="a{i}" x="{200 * x:.3f}" '
        f'y="{200 * y:.3f}"/>'
        for i, (x, y) in enumerate(points))
    write(folder, "x.nod.xml", f"<nodes>{nodes}</nodes>")
    edges = []
    for i in range(4):
        shape = " ".join(
            f"{16 * math.cos(math.pi / 2 * (i + k / 8)):.3f},{16 * math.sin(math.pi / 2 * (i + k / 8)):.3f}"
            for k in range(9))
        edges.append(
            f'<edge id="ring{i}" from="r{i}" to="r{(i + 1) % 4}" numLanes="1" speed="8.33" priority="2" '
            f'shape="{shape}"/>'
        )
        edges.append(
            f'<edge id="in{i}" from="a{i}" to="r{i}" numLanes="1" speed="13.89" priority="1"/><edge id="out{i}" '
            f'from="r{i}" to="a{i}" numLanes="1" speed="13.89" priority="1"/>'
        )
    write(folder, "x.edg.xml",
          "<edges>" + "".join(edges) + "<roundabout nodes=\"r0 r1 r2 r3\" edges=\"ring0 ring1 ring2 ring3\"/></edges>")
    run(folder, "netconvert", "-n", "x.nod.xml", "-e", "x.edg.xml", "--no-turnarounds", "-o", "net.xml")
    for past_per_h in (0, 200, 400, 600, 800, 1000, 1200):
        flow = f'<flow id="past" route="past" begin="0" end="1200" vehsPerHour="{past_per_h}" departSpeed="max"/>'
        past = flow if past_per_h else ""
        write(
            folder, "routes.xml",
            '<routes><route id="past" edges="in0 ring0 ring1 out2"/><route id="queue" edges="in1 ring1 out2"/>' + past
            + '<flow id="queue" route="queue" begin="0" end="1200" vehsPerHour="2000" departSpeed="max"/></routes>')
        sumo(folder, 0.1, 1200, "--tripinfo-output", "trips.xml")
        count = {"past": 0, "queue": 0}
        for trip in xml.parse(folder / "trips.xml").getroot():
            if float(trip.get("arrival")) > 200:
                count[trip.get("id").split(".")[0]] += 3.6
        handbook = 1380 * math.exp(-0.00102 * count["past"])
        print(
            f"roundabout: {count['past']:.0f} an hour circulate, {count['queue']:.0f} enter (by the handbook "
            f"{handbook:.0f}: {100 * (count['queue'] / handbook - 1):+.0f} %)"
        )


def need_sumo():
    if not all(shutil.which(tool) for tool in ("sumo", "netconvert", "netgenerate")):
        sys.exit("compare_sumo.py: SUMO is not installed (package sumo)")
    os.environ.setdefault("SUMO_HOME", "/usr/share/sumo")  # where Debian puts its types


# By netgenerate's own lengths, speeds, kinds of junction; half of random networks' size.
NETWORKS = {
    "grid": ["--grid"],
    "grid of 8": ["--grid", "--grid.number", "8"],
    "grid, two lanes": ["--grid", "--default.lanenumber", "2"],
    "spider": ["--spider"],
    "spider, five arms": ["--spider", "--spider.arm-number", "5", "--spider.circle-number", "4"],
    "random 1": ["--rand", "--rand.iterations", "200", "--seed", "1"],
    "random 2": ["--rand", "--rand.iterations", "200", "--seed", "2"],
    "random 3": ["--rand", "--rand.iterations", "200", "--seed", "3"],
}
WARM_S, UNTIL_S, PER_KM = 60, 360, 8


def random_ways(root, count, edges_each):
    """Ways for cars that stay on the road; back only at dead ends. Lane's kilometres."""
    length_m, onward = {}, {}
    for edge in root.iter("edge"):
        if edge.get("function") != "internal":
            length_m[edge.get("id")] = [float(lane.get("length")) for lane in edge.iter("lane")]
    turn, back = {edge: [] for edge in length_m}, {edge: [] for edge in length_m}
    for connection in root.iter("connection"):
        if connection.get("from") in length_m:
            into = back if connection.get("dir") == "t" else turn
            into[connection.get("from")].append(connection.get("to"))
    onward = {edge: turn[edge] or back[edge] for edge in length_m}
    draws, edges = random.Random(1), sorted(length_m)
    km = sum(sum(lanes) for lanes in length_m.values()) / 1000
    ways = []
    for _ in range(round(count * km)):
        way = [draws.choice(edges)]
        while len(way) < edges_each and onward[way[-1]]:
            way.append(draws.choice(onward[way[-1]]))
        ways.append(way)
    return ways, km


def networks(folder, rodeira, only, more=()):
    """Mean speed and vehicle kilometres an hour and lane's kilometre, the first minute left out."""
    print("| network | lane km | cars | SUMO m/s | Rodeira m/s | SUMO veh/h | Rodeira veh/h | ratio |")
    print("|---|---|---|---|---|---|---|---|")
    for name, words in NETWORKS.items():
        if only and name not in only:
            continue
        run(folder, "netgenerate", *words, "-o", "net.xml", "--opendrive-output", "net.xodr")
        ways, km = random_ways(xml.parse(folder / "net.xml").getroot(), PER_KM, 200)
        write(folder, "routes.xml", "<routes>" + "\n".join(
            f'<vehicle id="{number}" depart="0" departPos="random_free" departSpeed="avg">'
            f'<route edges="{" ".join(way)}"/></vehicle>' for number, way in enumerate(ways)) + "</routes>")
        sumo(folder, 0.1, UNTIL_S, "--fcd-output", "fcd.xml", "--device.fcd.period", 1)
        seen, there = 0.0, 0
        for _, step in xml.iterparse(folder / "fcd.xml"):
            if step.tag == "timestep":
                if float(step.get("time")) >= WARM_S:
                    speeds = [float(car.get("speed")) for car in step.iter("vehicle")]
                    seen, there = seen + sum(speeds), there + len(speeds)
                step.clear()
        steps = UNTIL_S - WARM_S
        done = subprocess.run([rodeira, "traffic", "run", "net.xodr", "--vehicles", str(len(ways)), "--for",
                               str(UNTIL_S), "--step", "0.1", "--warm", str(WARM_S), "--csv", "csv", "--rows-every",
                               "1", "--force", *more], cwd=folder, capture_output=True, text=True)
        if done.returncode != 0:
            sys.exit(f"compare_sumo.py: {name}: rodeira ended with status {done.returncode}: {done.stderr[-500:]}")
        own, own_there = 0.0, 0
        with (folder / "csv" / "trajectories.csv").open(newline="") as rows:
            for row in csv.DictReader(rows):
                if float(row["time_s"]) >= WARM_S:
                    own, own_there = own + float(row["speed_mps"]), own_there + 1
        theirs, ours = seen / max(1, there), own / max(1, own_there)
        flow, own_flow = (3.6 * total / steps / km for total in (seen, own))
        print(f"| {name} | {km:.1f} | {len(ways)} | {theirs:.2f} | {ours:.2f} | {flow:.0f} | {own_flow:.0f} | "
              f"{ours / theirs:.2f} |", flush=True)


def main():
    if sys.argv[1:2] == ["networks"]:
        parser = argparse.ArgumentParser(prog="compare_sumo.py networks")
        parser.add_argument("--rodeira", default=str(pathlib.Path(__file__).parent.parent / "build/bin/rodeira"))
        parser.add_argument("--only", action="append")
        parser.add_argument("--settings", help="traffic file for Rodeira's drivers")
        options = parser.parse_args(sys.argv[2:])
        need_sumo()
        with tempfile.TemporaryDirectory() as folder:
            networks(pathlib.Path(folder), str(pathlib.Path(options.rodeira).resolve()), options.only,
                     ["--settings", str(pathlib.Path(options.settings).resolve())] if options.settings else [])
        return
    studies = {"four": four, "town": town, "queue": queue, "turn": turn, "roundabout": roundabout}
    asked = sys.argv[1:] or list(studies)
    for name in asked:
        if name not in studies:
            sys.exit(f"compare_sumo.py: '{name}' was asked for; {', '.join(studies)} were expected")
    need_sumo()
    for name in asked:
        with tempfile.TemporaryDirectory() as folder:
            studies[name](pathlib.Path(folder))


if __name__ == "__main__":
    main()
