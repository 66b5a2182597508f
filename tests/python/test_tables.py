# SPDX-License-Identifier: Apache-2.0
"""`rodeira export` beyond a folder of CSV: .mat files, long tables, marks, derived columns, parts by marks. The .mat
file is read back by SciPy and by Octave, whose values are compared with python/rodeira's. RODEIRA names the program."""

import csv
import importlib.util
import os
import pathlib
import re
import shutil
import subprocess
import tempfile
import unittest

import numpy as np
import rodeira

ROOT = pathlib.Path(__file__).parents[2]
PROGRAM = os.environ.get("RODEIRA", "")


def call(*words):
    return subprocess.run([PROGRAM, *map(str, words)], capture_output=True, text=True, timeout=300)


def field(column):
    """The name of a column in a .mat file, for columns without a name that two of them would share."""
    return re.sub(r"[^A-Za-z0-9]+", "_", column).strip("_")


@unittest.skipUnless(PROGRAM, "RODEIRA does not name the program")
class Tables(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.kept = tempfile.TemporaryDirectory()
        cls.folder = pathlib.Path(cls.kept.name)
        cls.path = cls.folder / "drive.mcap"
        done = call("run", ROOT / "launch/car_ahead.yaml", "--for", 3, "--in-process", "--quiet", "--record", cls.path,
                    "--seed", 4, "--set", "nodes.traffic.config.vehicles=6")
        if done.returncode != 0:
            raise AssertionError(done.stdout + done.stderr)
        cls.drive = rodeira.open(cls.path)

    @classmethod
    def tearDownClass(cls):
        cls.kept.cleanup()

    def export(self, *words):
        done = call("export", *words, self.path)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)

    def rows(self, name):
        with open(self.folder / name, newline="", encoding="utf-8") as text:
            return list(csv.DictReader(text))

    def mat(self):
        path = self.folder / "drive.mat"
        if not path.exists():
            self.export("--mat", path, "--marks", "--derived")
        return path

    @unittest.skipUnless(importlib.util.find_spec("scipy"), "the Python package scipy is not installed")
    def test_scipy_reads_every_value_of_a_mat_file(self):
        import scipy.io
        found = scipy.io.loadmat(self.mat(), squeeze_me=True, struct_as_record=False)
        topics = [name for name in self.drive.topics if name != "snapshot"]
        self.assertEqual({name for name in found if not name.startswith("__")}, {*topics, "marks", "derived"})
        values = 0
        for topic in topics:
            table = self.drive[topic].table()
            self.assertEqual(len({field(column) for column in table}), len(table), "columns have names of their own")
            for column, wanted in table.items():
                got = np.atleast_1d(getattr(found[topic], field(column)))
                if wanted.dtype.kind in "OUS":
                    got = got if got.size or not len(wanted) else np.array([""])  # an empty text
                    if wanted.dtype.kind != "O" and len(wanted) and len(got) == 1:
                        got = np.repeat(got, len(wanted))  # one text stands for all rows
                    if wanted.dtype.kind != "O":
                        self.assertEqual([str(one) for one in got], [str(one) for one in wanted], (topic, column))
                    continue
                self.assertEqual(got.dtype, np.uint64 if column == "state_digest" else np.float64, (topic, column))
                wanted = wanted if column == "state_digest" else wanted.astype(np.float64)
                np.testing.assert_array_equal(got, wanted, f"{topic} {column}")
                values += len(wanted)
        self.assertGreater(values, 100_000)
        self.assertEqual(list(np.atleast_1d(found["marks"].name)), ["mark"])

    @unittest.skipUnless(shutil.which("octave-cli") or shutil.which("octave"), "octave is not installed")
    def test_octave_reads_a_mat_file(self):
        script = self.folder / "read.m"
        script.write_text(f"""load('{self.mat()}');
state = vehicle_state;
printf('%d %.17g %.17g\\n', numel(state.time_s), sum(state.velocity_w_mps_x), state.time_s(end));
printf('%s|%s|%d\\n', state.source, class(state.state_digest), iscellstr(marks.name) || ischar(marks.name));
printf('%d %.17g\\n', sum(isnan(derived.leader_gap_m)), max(derived.speed_mps));
disp(state.state_digest(end));
""")
        done = subprocess.run(["octave-cli" if shutil.which("octave-cli") else "octave", "--norc", "--quiet", script],
                              capture_output=True, text=True, timeout=120)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        lines = done.stdout.splitlines()
        state = self.drive["vehicle_state"]
        count, total, last = lines[0].split()
        self.assertEqual(int(count), len(state))
        self.assertAlmostEqual(float(total), float(np.sum(state["velocity_w_mps.x"])), delta=1e-9)
        self.assertEqual(float(last), state.time_s[-1])
        self.assertEqual(lines[1], "ego|uint64|1")
        self.assertEqual(int(lines[3]), int(state["header.state_digest"][-1]))

    def test_derived_columns_are_those_of_the_series(self):
        self.export("--csv", self.folder / "derived", "--topics", "controls", "--derived", "--rate", 50, "--to", 2)
        done = call("measures", self.path, "--series", self.folder / "series.csv")
        self.assertEqual(done.returncode, 0, done.stderr)
        wanted = [row for row in self.rows("series.csv") if float(row["time_s"]) < 2][::2]
        got = self.rows("derived/derived.csv")
        self.assertEqual(len(got), 100)
        self.assertEqual(list(got[0]), list(wanted[0]))
        for one, other in zip(got, wanted):
            for column, text in one.items():
                self.assertEqual(text == "", other[column] == "", column)
                if text:
                    self.assertAlmostEqual(float(text), float(other[column]), delta=1e-6 * max(1, abs(float(text))))

    def test_marks_and_a_part_by_them(self):
        mark = self.drive.events[0]
        self.assertEqual((mark.time_s, mark.name), (1.0, "mark"))
        self.export("--csv", self.folder / "part", "--topics", "vehicle_state", "--columns", "odometer_m", "--marks",
                    "--from", "event:mark", "--to", "+0.5")
        self.assertEqual([(row["time_s"], row["kind"], row["name"], row["argument"]) for row in
                          self.rows("part/marks.csv")], [("1", "event", "mark", mark.argument)])
        steps = [int(row["step"]) for row in self.rows("part/vehicle_state.csv")]
        self.assertEqual(steps, list(range(1000, 1500)))
        done = call("export", "--csv", self.folder / "none", "--from", "mark:begin", self.path)
        self.assertEqual(done.returncode, 2)
        self.assertIn("--from: the recording has no mark 'begin'", done.stderr)
        self.assertFalse((self.folder / "none").exists())

    def test_long_tables_have_the_values_of_wide_ones(self):
        words = ["--topics", "vehicle_state,traffic_state", "--columns", "odometer_m,gear,agents.id,agents.speed_mps",
                 "--rate", 20]
        self.export("--csv", self.folder / "wide", *words)
        self.export("--csv", self.folder / "long", "--long", *words)
        for name in ("vehicle_state", "traffic_state"):
            wide, long = self.rows(f"wide/{name}.csv"), self.rows(f"long/{name}.csv")
            columns = [column for column in wide[0] if column not in ("time_s", "step", "source")]
            wanted = [(row["time_s"], row["source"], column, row[column]) for row in wide for column in columns]
            self.assertEqual(wanted, [(row["time_s"], row["source"], row["column"], row["value"]) for row in long])

    def test_what_does_not_fit_together_is_refused(self):
        for words, sentence in ((["--mat", self.folder / "a.mat", "--csv", self.folder / "a"], "excludes"),
                                (["--mat", self.folder / "a.mat", "--long"], "excludes"),
                                (["--csv", self.folder / "a", "--subject", "ego"], "--derived"),
                                (["--csv", self.folder / "a", "--derived", "--subject", "eg"], "did you mean 'ego'"),
                                ([], "--fcd FILE.xml was expected")):
            done = call("export", *words, self.path)
            self.assertEqual(done.returncode, 2, done.stderr)
            self.assertIn(sentence, done.stderr)
            self.assertFalse((self.folder / "a").exists() or (self.folder / "a.mat").exists())
