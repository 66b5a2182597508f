# SPDX-License-Identifier: Apache-2.0
"""Recordings of the program itself. Two other readers are the oracle: `rodeira export --csv`, and npm's decoders with
MCAP's reference reader. RODEIRA names the program; a test that needs what is not installed is skipped."""

import csv
import importlib.util
import json
import os
import pathlib
import shutil
import subprocess
import tempfile
import unittest
import warnings
from unittest import mock

import numpy as np
import rodeira

ROOT = pathlib.Path(__file__).parents[2]
PROGRAM = os.environ.get("RODEIRA", "")
OLD = ROOT / "tests/data/recordings/scripted_2c2fa2f4.mcap"
READER = ROOT / "tests/record-npm"


def run(*words):
    done = subprocess.run([PROGRAM, *map(str, words)], capture_output=True, text=True, timeout=300)
    if done.returncode != 0:
        raise AssertionError(f"{words}: status {done.returncode}: {done.stdout}{done.stderr}")
    return done.stdout


def list_text(value):
    """A sequence as `rodeira export` writes it into one cell."""
    if isinstance(value, bytes):
        return value.hex()
    return "; ".join(str(one) for one in np.asarray(value).tolist())


@unittest.skipUnless(PROGRAM, "RODEIRA does not name the program")
class OfTheProgram(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.path = pathlib.Path(cls.folder.name) / "drive.mcap"
        run("run", ROOT / "launch/car_ahead.yaml", "--for", 2.5, "--in-process", "--quiet", "--record", cls.path,
            "--seed", 4, "--set", "nodes.traffic.config.vehicles=12", "--set", "duration_s=9",
            "--meta", "participant=P07", "--meta", "condition=dry")

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    def compare_with_tables(self, path):
        folder = pathlib.Path(self.folder.name) / (pathlib.Path(path).stem + "_tables")
        run("export", "--csv", folder, path)
        drive = rodeira.open(path)
        self.assertEqual({file.stem for file in folder.glob("*.csv")}, set(drive.topics) - {"snapshot"})
        values = 0
        for file in folder.glob("*.csv"):
            with open(file, newline="", encoding="utf-8") as text:
                rows = list(csv.reader(text))
            names, rows = rows[0], sorted(rows[1:], key=lambda row: float(row[0]))
            table = drive[file.stem].table()
            self.assertEqual(list(table), names)
            for i, name in enumerate(names):
                cells, got = [row[i] for row in rows], table[name]
                self.assertEqual(len(got), len(cells), name)
                if name == "state_digest":
                    wanted = np.array([int(cell, 16) for cell in cells], dtype=np.uint64)
                elif got.dtype == object:
                    wanted, got = np.array(cells), np.array([list_text(value) for value in got])
                elif got.dtype.kind in "iu":
                    wanted = np.array([int(cell) for cell in cells], dtype=got.dtype)
                else:  # the shortest decimal reads back to the bits of its own precision
                    wanted = np.array(cells, dtype=got.dtype) if cells else got
                np.testing.assert_array_equal(got, wanted, f"{file.stem}: {name}")
                values += len(cells)
        return values

    def test_every_value_is_that_of_the_tables(self):
        self.assertGreater(self.compare_with_tables(self.path), 300_000)

    def test_every_value_of_an_older_recording_is_that_of_the_tables(self):
        """With today's names of topics and members."""
        self.assertGreater(self.compare_with_tables(OLD), 10_000)

    @unittest.skipUnless(shutil.which("node") and (READER / "node_modules").is_dir(),
                         "node or the reference reader is not installed: npm ci --prefix tests/record-npm")
    def test_every_value_is_that_of_other_decoders(self):
        drive = rodeira.open(self.path)
        lines = subprocess.run(["node", READER / "values.mjs", self.path], capture_output=True, text=True, check=True,
                               timeout=300).stdout.splitlines()
        by_topic = {}
        for line in lines:
            message = json.loads(line)
            by_topic.setdefault(message["topic"], []).append(message)
        self.assertEqual(set(by_topic), {drive[name].full_name for name in drive if len(drive[name])})
        for name, messages in by_topic.items():
            topic = drive[name]
            messages.sort(key=lambda message: int(message["time"]))
            self.assertEqual([message["source"] for message in messages], topic.source.tolist())
            self.compare([message["value"] for message in messages], topic.values(), name)

    def compare(self, wanted, got, place):
        """Objects as JSON gives them against columns, member by member."""
        if isinstance(got, dict) or (isinstance(got, np.ndarray) and got.dtype.names):
            names = list(got) if isinstance(got, dict) else list(got.dtype.names)
            if len(wanted):
                self.assertEqual(list(wanted[0]) if isinstance(wanted[0], dict) else names, names, place)
            if isinstance(got, np.ndarray) and got.ndim > 1:
                wanted, got = [one for row in wanted for one in row], got.reshape(-1)
            for name in names:
                self.compare([one[name] for one in wanted], got[name], f"{place}.{name}")
        elif isinstance(got, rodeira.Ragged):
            self.assertEqual([len(one) for one in wanted], got.lengths.tolist(), place)
            self.compare([inner for one in wanted for inner in one], got.values, place)
        elif got.dtype.kind == "U" or got.dtype == object:
            self.assertEqual(wanted, got.tolist(), place)
        else:
            if got.dtype.itemsize == 8 and got.dtype.kind in "iu":
                wanted = [int(one) for one in wanted]
            np.testing.assert_array_equal(got, np.array(wanted, dtype=got.dtype).reshape(got.shape), place)

    def test_a_part_as_tables_is_that_part_of_the_columns(self):
        folder = pathlib.Path(self.folder.name) / "part"
        run("export", "--csv", folder, "--topics", "vehicle_state,traffic_state,scenario_events", "--columns",
            "position_w_m,wheels.load_n,agents.id,events.name", "--rate", 50, "--from", 0.5, "--to", 2, self.path)
        drive = rodeira.open(self.path)
        self.assertEqual({file.stem for file in folder.glob("*.csv")},
                         {"vehicle_state", "traffic_state", "scenario_events"})
        wanted = {"vehicle_state": ["position_w_m.x", "position_w_m.y", "position_w_m.z",
                                    *(f"wheels[{i}].load_n" for i in range(4))],
                  "traffic_state": ["agents.id"], "scenario_events": ["events.name"]}
        for name, columns in wanted.items():
            with open(folder / f"{name}.csv", newline="", encoding="utf-8") as text:
                names, *rows = csv.reader(text)
            self.assertEqual(names, ["time_s", "step", "source", *columns])
            table = drive[name].table()
            step = table["step"]
            kept = (step >= 500) & (step < 2000) & ((step % 20 == 0) | (name == "scenario_events"))
            self.assertGreater(kept.sum(), 0)
            for i, column in enumerate(names):
                got = table[column][kept]
                np.testing.assert_array_equal(np.array([row[i] for row in rows], dtype=got.dtype), got, column)

    def test_a_part_that_does_not_exist_is_refused(self):
        for words, sentence in ((["--columns", "odometer"], "unknown column 'odometer'; did you mean 'odometer_m'?"),
                                (["--topics", "vehicle"], "unknown topic 'vehicle'"),
                                (["--from", "2", "--to", "1"], "--to: 1 s was found; a time after 2 s was expected"),
                                (["--rate", "0"], "--rate")):
            done = subprocess.run([PROGRAM, "export", "--csv", self.path.with_name("none"), *words, self.path],
                                  capture_output=True, text=True)
            self.assertEqual(done.returncode, 2, done.stderr)
            self.assertIn(sentence, done.stderr)
            self.assertFalse(self.path.with_name("none").exists())

    def test_events_marks_meta_and_files(self):
        drive = rodeira.open(self.path)
        self.assertEqual(drive.meta, {"participant": "P07", "condition": "dry"})
        self.assertEqual(drive.overrides[:3], ("nodes.traffic.config.vehicles=12", "duration_s=9", "seed=4"))
        self.assertEqual(drive.files["launch.yaml"], (ROOT / "launch/car_ahead.yaml").read_bytes())
        scenario = "files/../configs/scenarios/car_ahead_brakes.yaml"
        self.assertEqual(drive.files[scenario], (ROOT / "configs/scenarios/car_ahead_brakes.yaml").read_bytes())
        for name, data in drive.files.items():
            on_disk = (ROOT / "launch" / name.removeprefix("files/"))
            if name.startswith("files/"):
                self.assertEqual(data, on_disk.read_bytes(), name)
        self.assertEqual([remark.kind for remark in drive.remarks], ["start", "end"])
        self.assertEqual(drive.remarks[-1].time_s, 2.5)
        self.assertEqual(drive.marks, [rodeira.Mark(1.0, "instruction: follow the car in front", "story")])
        # The scenario's first event, as configs/scenarios/car_ahead_brakes.yaml says.
        self.assertEqual(drive.events, [rodeira.Event(1.0, "story", "mark", "instruction: follow the car in front", 0)])
        self.assertEqual(drive.metadata["rodeira"]["seed"], "4")
        self.assertEqual(drive.damage, ())

    def test_columns_read_alone_equal_those_of_all(self):
        drive = rodeira.open(self.path)
        for name in drive:
            topic = drive[name]
            wanted = [column for column in topic.columns][:60]
            alone = rodeira.open(self.path)[name].read(["time_s", "source", *wanted])
            np.testing.assert_array_equal(alone["time_s"], topic.time_s)
            np.testing.assert_array_equal(alone["source"], topic.source)
            for column in wanted:
                both = (alone[column], topic[column])
                if isinstance(both[0], rodeira.Ragged):
                    np.testing.assert_array_equal(both[0].offsets, both[1].offsets)
                    both = (both[0].values, both[1].values)
                np.testing.assert_array_equal(*both, f"{name}: {column}")

    def test_a_large_topic_is_read_by_columns(self):
        small = rodeira.open(self.path)
        with mock.patch("rodeira.topic.LARGE_BYTES", 0):
            for name in ("vehicle_state", "traffic_state", "weather_state"):
                topic = rodeira.open(self.path)[name]
                self.assertEqual(len(topic), len(small[name]))
                np.testing.assert_array_equal(topic.time_s, small[name].time_s)
                np.testing.assert_array_equal(topic.source, small[name].source)
                for column in [*topic.columns][5:40]:
                    got, wanted = topic[column], small[name][column]
                    if isinstance(got, rodeira.Ragged):
                        got, wanted = got.values, wanted.values
                    np.testing.assert_array_equal(got, wanted, column)
                self.assertEqual(topic._all is None, name != "traffic_state", "a topic of one size is read by columns")
                np.testing.assert_array_equal(topic.table()["time_s"], small[name].table()["time_s"])

    def test_groups_of_columns(self):
        state = rodeira.open(self.path)["vehicle_state"]
        self.assertEqual(state["wheels.load_n"].shape, (len(state), 4))
        np.testing.assert_array_equal(state["wheels.load_n"][:, 2], state["wheels[2].load_n"])
        self.assertEqual(state["position_w_m"].dtype.names, ("x", "y", "z"))
        self.assertEqual(state.array()["header"]["step"].tolist(), list(range(2501)))
        agents = rodeira.open(self.path)["traffic_state"]["agents.speed_mps"]
        self.assertEqual(agents.lengths.tolist(), [12] * len(agents))
        np.testing.assert_array_equal(agents[7], agents.values[84:96])
        np.testing.assert_array_equal(agents[-1], agents.values[-12:])

    def test_units(self):
        units = rodeira.open(self.path)["vehicle_state"].units
        for column, unit in (("velocity_w_mps.x", "m/s"), ("wheels[3].load_n", "N"), ("steering_torque_nm", "N m"),
                             ("angular_velocity_b_radps.z", "rad/s"), ("acceleration_w_mps2.y", "m/s^2"),
                             ("fuel_rate_kgps", "kg/s"), ("odometer_m", "m"), ("throttle", ""), ("gear", ""),
                             ("header.time_ns", "ns"), ("wheels[0].hub_b_m.z", "m"), ("attitude_wb.w", "")):
            self.assertEqual(units[column], unit, column)

    @unittest.skipUnless(importlib.util.find_spec("pandas"), "the Python package pandas is not installed")
    def test_frames(self):
        drive = rodeira.open(self.path)
        frame = drive["traffic_state"].frame()
        self.assertEqual(len(frame), 12 * len(drive["traffic_state"]))
        self.assertEqual(frame.attrs["units"]["agents.speed_mps"], "m/s")
        self.assertEqual(frame.attrs["units"]["time_s"], "s")
        self.assertEqual(frame.attrs["topic"], "rodeira/traffic_state")
        means = frame.groupby("agents.id")["agents.speed_mps"].mean()
        speeds = drive["traffic_state"]["agents.speed_mps"].values.reshape(-1, 12)
        ids = drive["traffic_state"]["agents.id"][0]
        np.testing.assert_allclose(means[ids].to_numpy(), speeds.mean(axis=0), rtol=1e-12)

    def test_a_cut_recording_is_read_to_its_cut(self):
        whole = self.path.read_bytes()
        cut = self.path.with_name("cut.mcap")
        cut.write_bytes(whole[:len(whole) * 2 // 3])
        with warnings.catch_warnings(record=True) as caught:
            warnings.simplefilter("always")
            drive = rodeira.open(cut)
            state = drive["vehicle_state"]
            count = len(state)
        self.assertIn("the file is cut or damaged here", str(caught[0].message))
        self.assertGreater(count, 500)
        np.testing.assert_array_equal(state.array(), rodeira.open(self.path)["vehicle_state"].array()[:count])


if __name__ == "__main__":
    unittest.main()
