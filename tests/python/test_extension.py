# SPDX-License-Identifier: Apache-2.0
"""What the package calls in C++ (`_rodeira`), and runs that it starts. Oracles: the program's own tables, closed forms,
and round trips. RODEIRA names the program; without the extension module most of it is skipped."""

import importlib.util
import json
import math
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

import numpy as np
import rodeira

ROOT = pathlib.Path(__file__).parents[2]
PROGRAM = os.environ.get("RODEIRA", "")
N222 = ROOT / "configs/worlds/n222.yaml"
HAS_EXTENSION = bool(importlib.util.find_spec("_rodeira") or importlib.util.find_spec("rodeira._rodeira"))
needs_extension = unittest.skipUnless(HAS_EXTENSION, "the Python extension module _rodeira is not installed")


@needs_extension
@unittest.skipUnless(PROGRAM, "RODEIRA does not name the program")
class MeasuresOfRecordings(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.kept = tempfile.TemporaryDirectory()
        cls.path = pathlib.Path(cls.kept.name) / "drive.mcap"
        rodeira.run(ROOT / "launch/car_ahead.yaml", seed=4, for_s=6, record=cls.path, in_process=True,
                    meta={"participant": "P07"})

    @classmethod
    def tearDownClass(cls):
        cls.kept.cleanup()

    def test_they_are_those_of_the_program(self):
        table = self.path.with_suffix(".json")
        words = ["measures", self.path, "--intervals", "a=0..3", "b=event:mark..+4", "-o", table]
        subprocess.run([PROGRAM, *words], check=True, capture_output=True)
        wanted = json.loads(table.read_text())
        got = rodeira.measures(self.path, intervals=["a=0..3", "b=event:mark..+4"])
        self.assertEqual([row.interval for row in got], [row["interval"] for row in wanted])
        found = 0
        for row, other in zip(got, wanted):
            self.assertEqual((row.participant, row.from_s, row.to_s), ("P07", other["from_s"], other["to_s"]))
            self.assertEqual(list(row.measures), list(other["measures"]))
            for name, one in row.measures.items():
                value = other["measures"][name]
                self.assertEqual(value["value"] is None, math.isnan(one.value), name)
                self.assertEqual((one.unit, one.n, dict(one.options)), (value["unit"], value["n"], value["options"]))
                if value["value"] is None:
                    self.assertEqual(one.reason, value["missing"])
                else:
                    self.assertAlmostEqual(one.value, value["value"], delta=1e-12 * max(1.0, abs(one.value)))
                    found += 1
        self.assertGreater(found, 50)

    def test_names_options_and_frames(self):
        drive = rodeira.open(self.path)
        table = rodeira.measures([drive, self.path], ["speed_max_mps", "tet_s"], options={"tet_s": {"threshold_s": 2}})
        self.assertEqual(table.names, ("speed_max_mps", "tet_s"))
        self.assertEqual(len(table["speed_max_mps"]), 2)
        self.assertEqual(table["speed_max_mps"][0], table["speed_max_mps"][1])
        velocity = drive["vehicle_state"]["velocity_w_mps"]
        speed = np.sqrt(velocity["x"]**2 + velocity["y"]**2 + velocity["z"]**2)  # the slip angle is small
        self.assertAlmostEqual(table["speed_max_mps"][0], speed[::10].max(), delta=1e-3)
        self.assertEqual(table.rows[0].measures["tet_s"].options["threshold_s"], "2")
        for words, sentence in ((dict(measures=["speed_maks_mps"]), "did you mean 'speed_max_mps'"),
                                (dict(options={"tet_s": {"threshold": 2}}), "did you mean 'threshold_s'"),
                                (dict(options={"tet_s": {"threshold_s": -1}}), "-1 was found"),
                                (dict(intervals=["a=mark:begin..end"]), "no mark 'begin'"),
                                (dict(subject="egg"), "did you mean 'ego'"), (dict(rate_hz=100), "for tables")):
            with self.assertRaises(rodeira.Error) as raised:
                rodeira.measures(self.path, **words)
            self.assertIn(sentence, str(raised.exception))
        one = rodeira.measures(self.path, "speed_max_mps", intervals="a=0..0.5")
        self.assertEqual((one.names, [row.interval for row in one]), (("speed_max_mps",), ["a"]))
        for path in (self.path.with_name("none.mcap"), self.path.with_name(f"{self.path.stem}z.mcap"),
                     self.path.parent):
            with self.assertRaises(rodeira.Error) as program:
                rodeira.measures(path)
            with self.assertRaises(rodeira.Error) as package:
                rodeira.open(path)
            self.assertEqual(str(program.exception), str(package.exception))

    @unittest.skipUnless(importlib.util.find_spec("pandas"), "the Python package pandas is not installed")
    def test_frames(self):
        table = rodeira.measures(self.path, ["speed_max_mps", "sdlp_m"])
        frame, long = table.frame(), table.long()
        self.assertEqual(list(frame.columns[-2:]), ["speed_max_mps", "sdlp_m"])
        self.assertEqual(frame.attrs["units"], {"speed_max_mps": "m/s", "sdlp_m": "m"})
        self.assertEqual(list(long.measure), ["speed_max_mps", "sdlp_m"])
        self.assertEqual(long.value[0], table["speed_max_mps"][0])

    # The series of a recording, given as if it were another program's table, have the recording's measures.
    def test_a_table_of_the_same_drive_has_the_same_measures(self):
        series = rodeira.series(self.path)
        names = ["speed_mean_mps", "speed_sd_mps", "throttle_mean", "lane_position_mean_m", "gap_min_m", "ttc_min_s",
                 "steering_sd_deg", "jerk_rms_mps3", "distance_m"]
        own, given, found = rodeira.measures(self.path, names), rodeira.measures(series, names), 0
        for name in names:
            self.assertEqual(math.isnan(own[name][0]), math.isnan(given[name][0]), name)
            if not math.isnan(own[name][0]):
                self.assertAlmostEqual(given[name][0], own[name][0], delta=1e-9 * max(1.0, abs(own[name][0])), msg=name)
                found += 1
        self.assertGreaterEqual(found, 7)


    def test_one_process_or_several_give_the_same_bits(self):
        several = rodeira.run(ROOT / "launch/car_ahead.yaml", seed=4, for_s=6, meta={"participant": "P07"})
        one, other = rodeira.measures(self.path), rodeira.measures(several)
        self.assertEqual(one.names, other.names)
        for name in one.names:
            np.testing.assert_array_equal(one[name], other[name], err_msg=name)


@needs_extension
@unittest.skipUnless(PROGRAM, "RODEIRA does not name the program")
class WayAhead(unittest.TestCase):
    """On a straight street across a crossing with lights: what lies ahead stands still, and shows its colours."""
    @classmethod
    def setUpClass(cls):
        cls.drive = rodeira.run(ROOT / "launch/lights.yaml", for_s=45, in_process=True,
                                set={"nodes.view": None, "nodes.traffic.config.vehicles": 10})
        cls.series = rodeira.series(cls.drive)
        cls.front = cls.series["x_m"] + cls.drive["vehicle_state"]["front_m"][0]

    def test_the_junction_and_the_line_stand_still(self):
        begins = (self.front + self.series["junction_ahead_m"])[np.isfinite(self.series["junction_ahead_m"])]
        line = (self.front + self.series["light_ahead_m"])[np.isfinite(self.series["light_ahead_m"])]
        for places in (begins, line):
            self.assertGreater(len(places), 1000)
            np.testing.assert_allclose(places, places[0], atol=0.01)
        self.assertLess(line[0], begins[0] + 0.01)
        inside = self.series["junction"] == 1.0
        self.assertTrue(inside.any(), "it comes into the junction")
        self.assertTrue(np.isnan(self.series["junction_ahead_m"][inside]).all())
        entered = self.series["x_m"][inside].min()
        self.assertAlmostEqual(entered, begins[0], delta=0.25)  # at 14 m/s, from sample to sample

    def test_the_light_shows_its_controllers_colour(self):
        seen = np.flatnonzero(np.isfinite(self.series["light_ahead"]))
        self.assertGreater(len(seen), 1000)
        self.assertGreater(len(np.unique(self.series["light_ahead"][seen])), 1)
        signals = self.drive["signals_state"]
        controllers, colours = signals["groups.controller"], signals["groups.colour"]
        steps = np.round(signals.time_s * 100).astype(int)
        same = {}
        for controller in np.unique(controllers.values):
            colour = np.full(len(self.series["time_s"]) + 1, np.nan)
            own = controllers.values == controller
            colour[steps[controllers.samples[own]]] = colours.values[own]
            same[controller] = (colour[seen] == self.series["light_ahead"][seen]).mean()
        self.assertEqual(max(same.values()), 1.0, same)

    def test_the_distance_at_the_stop(self):
        got = rodeira.measures(self.drive, ["stop_line_distance_m"])
        speed = self.series["speed_mps"]
        moves = np.flatnonzero(speed > 0.5)[0]
        stops = moves + np.flatnonzero(speed[moves:] < 0.1)
        if not len(stops):
            self.assertEqual(got.rows[0].measures["stop_line_distance_m"].reason, "the vehicle does not stop")
            return
        nearer = np.fmin(self.series["light_ahead_m"], self.series["junction_ahead_m"])[stops[0]]
        np.testing.assert_array_equal(got["stop_line_distance_m"][0], nearer)


@needs_extension
class MeasuresOfTables(unittest.TestCase):
    def setUp(self):
        self.time = np.arange(6000) / 60.0
        self.table = {"t": self.time, "offset": 0.3 * np.sin(2 * np.pi * 0.1 * self.time),
                      "v_kmh": np.full(6000, 72.0), "width": np.full(6000, 3.5)}
        self.columns = {"lane_position_m": "offset", "speed_mps": ("v_kmh", 1 / 3.6), "lane_width_m": "width"}

    def test_closed_forms(self):
        got = rodeira.measures(self.table, ["sdlp_m", "speed_mean_mps", "distance_m"], columns=self.columns, time="t")
        self.assertAlmostEqual(got["sdlp_m"][0], 0.3 / math.sqrt(2) * math.sqrt(6000 / 5999), delta=1e-12)
        self.assertAlmostEqual(got["speed_mean_mps"][0], 20.0, delta=1e-12)
        marked = rodeira.measures(self.table, ["speed_mean_mps"], columns=self.columns, time="t",
                                  intervals=["task=mark:begin..+20"], marks=[(30, "begin")])
        self.assertEqual((marked.rows[0].from_s, marked.rows[0].to_s), (30, 50))

    def test_uneven_samples_need_a_rate(self):
        self.table["t"] = self.time + 0.004 * np.sin(np.arange(6000))
        with self.assertRaises(rodeira.Error) as raised:
            rodeira.measures(self.table, ["sdlp_m"], columns=self.columns, time="t")
        self.assertIn("rate_hz", str(raised.exception))
        self.table["offset"] = 0.3 * np.sin(2 * np.pi * 0.1 * self.table["t"])
        got = rodeira.measures(self.table, ["sdlp_m"], columns=self.columns, time="t", rate_hz=50)
        self.assertAlmostEqual(got["sdlp_m"][0], 0.3 / math.sqrt(2), delta=1e-3)

    def test_wrong_tables_are_refused(self):
        for columns, sentence in (({"speed_mps": "v_kph"}, "did you mean 'v_kmh'"),
                                  ({"speed_mp": "v_kmh"}, "did you mean 'speed_mps'"),
                                  (None, "columns={…} was expected")):
            with self.assertRaises(rodeira.Error) as raised:
                rodeira.measures(self.table, ["sdlp_m"], columns=columns, time="t")
            self.assertIn(sentence, str(raised.exception))


class Packages(unittest.TestCase):
    def test_without_numpy_the_package_of_debian_is_named(self):
        environment = {**os.environ, "PYTHONPATH": str(ROOT / "python")}
        done = subprocess.run([sys.executable, "-S", "-c", "import rodeira"], capture_output=True, text=True,
                              env=environment)
        self.assertEqual(done.returncode, 1)
        self.assertRegex(done.stderr.splitlines()[-1], "ImportError: .*python3-numpy")


@needs_extension
class Worlds(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.world = rodeira.World(N222)

    def test_points_of_a_lane_lie_in_it(self):
        lanes = [lane for lane in self.world.lanes if lane.lane in (-1, 1)]
        self.assertGreater(len(lanes), 1)
        for lane in lanes[:4]:
            begin, end = self.world.stations(lane)
            points = self.world.polyline(lane, 5.0)
            self.assertLessEqual(np.linalg.norm(np.diff(points, axis=0), axis=1).max(), 5.5)
            found = self.world.locate_all(*points[1:-1].T)
            np.testing.assert_allclose(found["lane_position_m"], 0.0, atol=1e-6)
            np.testing.assert_allclose(found["distance_m"], 0.0, atol=1e-9)
            self.assertTrue((found["lane"] == lane.lane).all())
            self.assertTrue((np.diff(found["s_m"]) > 0).all() and begin < found["s_m"][0] < found["s_m"][-1] < end)
            left, right = self.world.edges(lane, 5.0)
            width = np.linalg.norm(left - right, axis=1)
            np.testing.assert_allclose(width[1:-1], found["lane_width_m"], rtol=2e-3)

    def test_next_lanes_begin_where_a_lane_ends(self):
        world, followed = rodeira.World(ROOT / "configs/worlds/lights.yaml"), 0
        for lane in world.lanes:
            begin, end = world.stations(lane)
            for after in world.next(lane):
                own, other = world.polyline(lane), world.polyline(after.lane)
                ends = [np.linalg.norm(a - b) for a in (own[0], own[-1]) for b in (other[0], other[-1])]
                self.assertLess(min(ends), 0.1, (lane, after))
                self.assertIn(after.s_m, world.stations(after.lane))
                self.assertAlmostEqual(after.distance_m, end - begin, delta=1e-9)
                followed += 1
            for near, far in zip(world.next(lane, begin + 0.25 * (end - begin)), world.next(lane, end)):
                self.assertAlmostEqual(abs(near.distance_m - far.distance_m), 0.75 * (end - begin), delta=1e-6)
        self.assertGreater(followed, 20)

    def test_what_is_not_there(self):
        self.assertIsNone(self.world.locate(math.nan, 0.0))
        for lane in (("no such road", 0, 1), (self.world.roads[0], 99, 1), (self.world.roads[0], 0, 77)):
            with self.assertRaises(rodeira.Error):
                self.world.polyline(rodeira.Lane(*lane))
        with self.assertRaises(rodeira.Error) as raised:
            rodeira.World(ROOT / "configs/worlds/plane.yaml")
        self.assertIn("no roads", str(raised.exception))

    @unittest.skipUnless(PROGRAM, "RODEIRA does not name the program")
    def test_a_driven_car_is_located_as_its_measures_say(self):
        drive = rodeira.run(ROOT / "launch/car_ahead.yaml", for_s=4, in_process=True)
        series = rodeira.series(drive)
        world = rodeira.World(ROOT / "configs/worlds" / pathlib.Path(world_of(drive)).name)
        self.assertEqual(world.content_hash, drive.metadata["rodeira"]["world_hash"])
        found = world.locate_all(series["x_m"], series["y_m"], series["z_m"])
        np.testing.assert_array_equal(found["s_m"], series["s_m"])
        np.testing.assert_array_equal(found["t_m"], series["t_m"])
        np.testing.assert_array_equal(found["lane"], series["lane"])


def world_of(drive):
    return next(name for name in drive.files if name.endswith(".yaml") and "worlds/" in name)


@unittest.skipUnless(PROGRAM, "RODEIRA does not name the program")
class Runs(unittest.TestCase):
    def test_a_run_gives_its_recording(self):
        first, second, other = (rodeira.run(ROOT / "launch/car_ahead.yaml", seed=seed, for_s=1.5, in_process=True,
                                            set={"nodes.traffic.config.vehicles": 4}, meta={"run": "a"})
                                for seed in (3, 3, 8))
        self.assertEqual(first.metadata["rodeira"]["seed"], "3")
        self.assertEqual(first.meta, {"run": "a"})
        self.assertEqual(first["vehicle_state"].time_s[-1], 1.5)
        digests = [one["traffic_state"]["header.state_digest"].tolist() for one in (first, second, other)]
        self.assertEqual(digests[0], digests[1])
        self.assertNotEqual(digests[0], digests[2])
        path = pathlib.Path(first.path)
        self.assertTrue(path.exists())
        del first
        self.assertFalse(path.exists(), "a recording without a name is removed with its object")

    def test_what_the_program_says_is_the_error(self):
        with self.assertRaises(rodeira.Error) as raised:
            rodeira.run("demmo", for_s=1)
        self.assertIn("demo", str(raised.exception))
        with self.assertRaises(rodeira.Error) as raised:
            rodeira.run(ROOT / "launch/car_ahead.yaml", for_s=1, set={"seeed": 1})
        self.assertIn("seeed", str(raised.exception))
