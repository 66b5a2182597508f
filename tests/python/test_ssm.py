# SPDX-License-Identifier: Apache-2.0
"""SUMO's device.ssm as an oracle: two cars are moved along given trajectories, and SUMO's time to collision, DRAC and
changes of PET are compared with those of the extension module. Debian's sumo and sumo-tools are needed."""

import importlib.util
import math
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest
import xml.etree.ElementTree as ElementTree

import numpy as np
import rodeira

TOOLS = pathlib.Path(os.environ.get("SUMO_HOME", "/usr/share/sumo")) / "tools"
HAS_SUMO = bool(shutil.which("sumo") and shutil.which("netconvert") and (TOOLS / "traci").is_dir())
HAS_EXTENSION = bool(importlib.util.find_spec("_rodeira") or importlib.util.find_spec("rodeira._rodeira"))
STEP_S = 0.1
LENGTH_M, WIDTH_M = 5.0, 1.8  # of SUMO's default car


@unittest.skipUnless(HAS_SUMO, "SUMO (Debian: sumo, sumo-tools) is not installed")
@unittest.skipUnless(HAS_EXTENSION, "the Python extension module _rodeira is not installed")
class SurrogateSafety(unittest.TestCase):
    def setUp(self):
        kept = tempfile.TemporaryDirectory()
        self.addCleanup(kept.cleanup)
        self.folder = pathlib.Path(kept.name)

    def net(self, nodes, edges, connections=""):
        for name, text in (("a.nod.xml", f"<nodes>{nodes}</nodes>"), ("a.edg.xml", f"<edges>{edges}</edges>"),
                           ("a.con.xml", f"<connections>{connections}</connections>")):
            (self.folder / name).write_text(text)
        subprocess.run(["netconvert", "-n", "a.nod.xml", "-e", "a.edg.xml", "-x", "a.con.xml", "-o", "a.net.xml",
                        "--no-turnarounds", "--offset.disable-normalization"], cwd=self.folder, check=True,
                       capture_output=True)

    def conflicts(self, routes, places):
        """What SUMO writes when `places` (by car: front x, y, angle of each step) are driven."""
        (self.folder / "a.rou.xml").write_text(
            "<routes><vType id='car' length='5' width='1.8' maxSpeed='60' accel='50' decel='50'/>" +
            "".join(f"<route id='{car}' edges='{edges}'/>" for car, edges in routes.items()) +
            "".join(f"<vehicle id='{car}' type='car' route='{car}' depart='0' departSpeed='0'>"
                    "<param key='has.ssm.device' value='true'/><param key='device.ssm.file' value='ssm.xml'/>"
                    "<param key='device.ssm.measures' value='TTC DRAC PET'/>"
                    "<param key='device.ssm.thresholds' value='100 0 100'/>"
                    "<param key='device.ssm.trajectories' value='true'/>"
                    "<param key='device.ssm.range' value='400'/></vehicle>" for car in routes) + "</routes>")
        steps = len(next(iter(places.values())))
        script = self.folder / "drive.py"
        script.write_text(f"""import sys
sys.path.insert(0, {str(TOOLS)!r})
import traci
places = {places!r}
traci.start(["sumo", "-n", "a.net.xml", "-r", "a.rou.xml", "--step-length", "{STEP_S}", "--no-step-log", "true",
             "--collision.action", "none", "--no-warnings", "true", "--default.speeddev", "0"])
traci.simulationStep()
for car in places:
    traci.vehicle.setSpeedMode(car, 0)
    traci.vehicle.setLaneChangeMode(car, 0)
for k in range({steps}):
    for car, path in places.items():
        x, y, angle, speed = path[k]
        traci.vehicle.moveToXY(car, "", -1, x, y, angle, keepRoute=2)
        traci.vehicle.setSpeed(car, speed)
    traci.simulationStep()
traci.close()
""")
        done = subprocess.run([sys.executable, script], cwd=self.folder, capture_output=True, text=True, timeout=120)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        return ElementTree.parse(self.folder / "ssm.xml").getroot().findall("conflict")

    def test_time_to_collision_and_drac_of_following(self):
        self.net("<node id='a' x='0' y='0'/><node id='b' x='2000' y='0'/>",
                 "<edge id='e' from='a' to='b' numLanes='1' speed='60'/>")
        lane_y = -1.6  # the middle of a lane of 3.2 m, right of the edge
        count = 140
        own = [(20.0 + 25.0 * STEP_S * k, lane_y, 90.0, 25.0) for k in range(count)]
        leader = [(20.0 + 155.0 + LENGTH_M + 15.0 * STEP_S * k, lane_y, 90.0, 15.0) for k in range(count)]
        conflicts = self.conflicts({"leader": "e", "own": "e"}, {"leader": leader, "own": own})
        conflict = next(one for one in conflicts if one.get("ego") == "own")
        times = np.array(conflict.find("timeSpan").get("values").split(), dtype=float)
        compared = 0
        for name, tag in (("ttc_s", "TTCSpan"), ("drac_mps2", "DRACSpan")):
            for time, text in zip(times, conflict.find(tag).get("values").split()):
                k = round(time / STEP_S) - 1  # of the places: the first step sets none
                if text == "NA" or not 0 < k < count:
                    continue
                gap = leader[k][0] - LENGTH_M - own[k][0]
                table = {"time_s": np.arange(3) * STEP_S, "speed_mps": np.full(3, 25.0),
                         "leader_id": np.ones(3), "leader_speed_mps": np.full(3, 15.0),
                         "leader_gap_m": np.full(3, gap)}
                far = {"max_gap_m": 200, "max_time_gap_s": 10}
                got = rodeira.measures(table, ["ttc_min_s", "drac_max_mps2"],
                                       options={"ttc_min_s": far, "drac_max_mps2": far})
                value = got["ttc_min_s" if name == "ttc_s" else "drac_max_mps2"][0]
                self.assertAlmostEqual(value, float(text), delta=0.006, msg=(name, time, gap))
                compared += 1
        self.assertGreater(compared, 150)

    def test_time_to_collision_and_drac_after_a_merge(self):
        """A slow car joins the lane ahead of a faster one. SUMO's network as OpenDRIVE gives lanes and gaps here."""
        nodes = ("<node id='c' x='0' y='0' type='priority'/><node id='w' x='-500' y='0'/><node id='o' x='500' y='0'/>"
                 "<node id='s' x='-350' y='-350'/>")
        edges = "".join(f"<edge id='{a}{b}' from='{a}' to='{b}' numLanes='1' speed='60'/>"
                        for a, b in (("w", "c"), ("c", "o"), ("s", "c")))
        self.net(nodes, edges, "<connection from='wc' to='co'/><connection from='sc' to='co'/>")
        subprocess.run(["netconvert", "-s", "a.net.xml", "--opendrive-output", "a.xodr"], cwd=self.folder, check=True,
                       capture_output=True)
        fast, slow = 15.0, 10.0
        cars = ""
        for name, way, speed in (("own", "wc co", fast), ("other", "sc co", slow)):
            cars += (f"<vType id='{name}' length='{LENGTH_M}' width='{WIDTH_M}' maxSpeed='{speed}' speedDev='0' "
                     "accel='50' decel='50' sigma='0' tau='0.1' minGap='0' jmIgnoreFoeProb='1' jmIgnoreFoeSpeed='100' "
                     f"jmIgnoreJunctionFoeProb='1'/><route id='{name}' edges='{way}'/>")
        for name, at, speed in (("own", 200, fast), ("other", 314, slow)):
            cars += (f"<vehicle id='{name}' type='{name}' route='{name}' depart='0' departSpeed='{speed}' "
                     f"departPos='{at}'><param key='has.ssm.device' value='true'/>"
                     "<param key='device.ssm.file' value='ssm.xml'/><param key='device.ssm.measures' value='TTC DRAC'/>"
                     "<param key='device.ssm.thresholds' value='100 0'/>"
                     "<param key='device.ssm.trajectories' value='true'/>"
                     "<param key='device.ssm.range' value='600'/></vehicle>")
        (self.folder / "a.rou.xml").write_text(f"<routes>{cars}</routes>")
        done = subprocess.run(["sumo", "-n", "a.net.xml", "-r", "a.rou.xml", "--step-length", str(STEP_S), "--end",
                               "60", "--no-step-log", "--no-warnings", "--collision.action", "none"], cwd=self.folder,
                              capture_output=True, text=True, timeout=120)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        conflict = next(one for one in ElementTree.parse(self.folder / "ssm.xml").getroot().findall("conflict")
                        if one.get("ego") == "own")

        def track(tag):
            return np.array([[float(number) for number in point.split(",")[:2]]
                             for point in conflict.find(tag).get("values").split()])
        own, other = track("egoPosition"), track("foePosition")  # of the fronts
        speeds = np.hypot(*track("egoVelocity").T)  # at the end it brakes behind the slow one
        world = rodeira.World(self.folder / "a.xodr")
        here, there = world.locate_all(*own.T), world.locate_all(*other.T)
        merged = (here["road"] == there["road"]) & (here["road"] >= 0) & (here["lane"] == there["lane"])
        gaps = np.where(merged, there["s_m"] - LENGTH_M - here["s_m"], np.nan)
        far = {"max_gap_m": 200, "max_time_gap_s": 30}
        compared = 0
        for k, (ttc, drac) in enumerate(zip(conflict.find("TTCSpan").get("values").split(),
                                            conflict.find("DRACSpan").get("values").split())):
            if not gaps[k] > 1.5 or ttc == "NA":  # SUMO's two decimals of speeds say less of a smaller gap
                continue
            table = {"time_s": np.arange(3) * STEP_S, "speed_mps": np.full(3, speeds[k]), "leader_id": np.ones(3),
                     "leader_speed_mps": np.full(3, slow), "leader_gap_m": np.full(3, gaps[k])}
            got = rodeira.measures(table, ["ttc_min_s", "drac_max_mps2"],
                                   options={"ttc_min_s": far, "drac_max_mps2": far})
            self.assertAlmostEqual(got["ttc_min_s"][0], float(ttc), delta=0.012, msg=f"sample {k}, gap {gaps[k]}")
            self.assertAlmostEqual(got["drac_max_mps2"][0], float(drac), delta=0.006 + 0.02 * float(drac))
            compared += 1
        self.assertGreater(compared, 20)

    def crossing(self, own, other, length_m, width_m, braking_mps2):
        """What SUMO writes of two cars that it drives itself across one another, each at its speed from its distance:
        the conflict of the first one. (Of cars moved by moveToXY its device counts no way on a junction's lanes, so
        that its PET is too long by the time on them.)"""
        self.net("<node id='c' x='0' y='0' type='priority'/><node id='w' x='-500' y='0'/><node id='o' x='500' y='0'/>"
                 "<node id='s' x='0' y='-500'/><node id='n' x='0' y='500'/>",
                 "".join(f"<edge id='{a}{b}' from='{a}' to='{b}' numLanes='1' speed='60'/>"
                         for a, b in (("w", "c"), ("c", "o"), ("s", "c"), ("c", "n"))),
                 "<connection from='wc' to='co'/><connection from='sc' to='cn'/>")
        cars = ""
        for name, edges, (speed_mps, distance_m) in (("own", "wc co", own), ("other", "sc cn", other)):
            cars += (f"<vType id='{name}' length='{length_m}' width='{width_m}' maxSpeed='{speed_mps}' speedDev='0' "
                     f"accel='{braking_mps2}' decel='{braking_mps2}' "
                     "sigma='0' jmIgnoreFoeProb='1' jmIgnoreFoeSpeed='100' jmIgnoreJunctionFoeProb='1'/>"
                     f"<route id='{name}' edges='{edges}'/>")
        for name, (speed_mps, distance_m) in (("own", own), ("other", other)):
            cars += (f"<vehicle id='{name}' type='{name}' route='{name}' depart='0' departSpeed='{speed_mps}' "
                     f"departPos='{500 - distance_m}'><param key='has.ssm.device' value='true'/>"
                     "<param key='device.ssm.file' value='ssm.xml'/><param key='device.ssm.measures' value='PET'/>"
                     "<param key='device.ssm.thresholds' value='100'/>"
                     "<param key='device.ssm.trajectories' value='true'/>"
                     "<param key='device.ssm.range' value='600'/></vehicle>")
        (self.folder / "a.rou.xml").write_text(f"<routes>{cars}</routes>")
        done = subprocess.run(["sumo", "-n", "a.net.xml", "-r", "a.rou.xml", "--step-length", str(STEP_S), "--end",
                               "80", "--no-step-log", "--no-warnings", "--collision.action", "none"], cwd=self.folder,
                              capture_output=True, text=True, timeout=120)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        conflicts = ElementTree.parse(self.folder / "ssm.xml").getroot().findall("conflict")
        return next(one for one in conflicts if one.get("ego") == "own")

    def test_post_encroachment_time_of_crossing(self):
        right = 1.6  # the lanes' middles, right of the edges
        # With 50 m/s2 nothing keeps the cars from their speed; with 4.5 m/s2 the first one slows before the junction.
        for own, other, length, width, braking in (((12.0, 200.0), (10.0, 220.0), LENGTH_M, WIDTH_M, 50.0),
                                                   ((12.0, 200.0), (10.0, 245.0), LENGTH_M, WIDTH_M, 50.0),
                                                   ((12.0, 200.0), (20.0, 450.0), LENGTH_M, WIDTH_M, 50.0),
                                                   ((6.0, 200.0), (10.0, 440.0), LENGTH_M, WIDTH_M, 50.0),
                                                   ((8.0, 200.0), (7.0, 260.0), LENGTH_M, WIDTH_M, 50.0),
                                                   ((12.0, 200.0), (10.0, 220.0), 9.0, 2.4, 50.0),
                                                   ((12.0, 200.0), (10.0, 220.0), LENGTH_M, WIDTH_M, 4.5)):
            with self.subTest(own=own, other=other, length=length, braking=braking):
                conflict = self.crossing(own, other, length, width, braking)
                paths = []
                for tag in ("egoPosition", "foePosition"):  # of the fronts
                    x, y = np.array([[float(number) for number in point.split(",")]
                                     for point in conflict.find(tag).get("values").split()]).T
                    heading = math.atan2(y[-1] - y[0], x[-1] - x[0])
                    paths.append(rodeira.Path(x - 0.5 * length * math.cos(heading),
                                              y - 0.5 * length * math.sin(heading), np.full(len(x), heading), length,
                                              width))
                got = rodeira.pet(*paths, 1.0 / STEP_S).value
                # The second's front reaches the first's right side; the first's rear leaves the second's right side.
                enters = (other[1] - right - 0.5 * width) / other[0]
                leaves = (own[1] + right + 0.5 * width + length) / own[0]
                if braking == 50.0:
                    self.assertAlmostEqual(got, enters - leaves, delta=0.005)
                else:
                    self.assertLess(got, enters - leaves - 0.5)
                self.assertAlmostEqual(got, float(conflict.find("PET").get("value")), delta=0.011)
