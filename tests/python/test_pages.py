# SPDX-License-Identifier: Apache-2.0
"""What docs/how-to/export.md and examples/notebooks show is run as it stands there, on a recording of the program. The
mean speed that each language prints is compared with the one of the table, line by line. RODEIRA names the program; R,
Octave, pandas and matplotlib are needed for their parts, which are skipped without them."""

import csv
import importlib.util
import json
import math
import os
import pathlib
import re
import shutil
import struct
import subprocess
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).parents[2]
PROGRAM = os.environ.get("RODEIRA", "")
PAGE = ROOT / "docs/how-to/export.md"
NOTEBOOKS = ROOT / "examples/notebooks"


def blocks(language):
    return re.findall(rf"^```{language}\n(.*?)^```$", PAGE.read_text(), re.DOTALL | re.MULTILINE)


def needs_module(name):
    return unittest.skipUnless(importlib.util.find_spec(name), f"the Python package {name} is not installed")


def needs_program(name, package):
    return unittest.skipUnless(shutil.which(name), f"{name} is not installed (Debian: {package})")


@unittest.skipUnless(PROGRAM, "RODEIRA does not name the program")
class Pages(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.kept = tempfile.TemporaryDirectory()
        cls.folder = pathlib.Path(cls.kept.name)
        for words in (["run", ROOT / "launch/car_ahead.yaml", "--for", "2", "--in-process", "--quiet", "--record",
                       cls.folder / "demo.mcap", "--set", "nodes.traffic.config.vehicles=8", "--seed", "6"],
                      ["export", "--csv", cls.folder / "demo_tables", cls.folder / "demo.mcap"],
                      ["export", "--mat", cls.folder / "demo.mat", cls.folder / "demo.mcap"]):
            done = subprocess.run([PROGRAM, *words], capture_output=True, text=True, timeout=300)
            if done.returncode != 0:
                raise AssertionError(done.stdout + done.stderr)
        with open(cls.folder / "demo_tables/vehicle_state.csv", newline="") as table:
            speeds = [3.6 * math.hypot(float(row["velocity_w_mps.x"]), float(row["velocity_w_mps.y"]))
                      for row in csv.DictReader(table)]
        cls.sentence = f"{len(speeds)} samples, {math.fsum(speeds) / len(speeds):.3f} km/h on average"

    @classmethod
    def tearDownClass(cls):
        cls.kept.cleanup()

    def run_file(self, text, name, program):
        path = self.folder / name
        path.write_text(text)
        done = subprocess.run([*program, path], cwd=self.folder, capture_output=True, text=True, timeout=120,
                              env={**os.environ, "MPLBACKEND": "Agg", "PYTHONPATH": str(ROOT / "python")})
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        return done.stdout

    def test_python(self):
        said = self.run_file(blocks("python")[0], "first.py", [sys.executable])
        self.assertIn(self.sentence, said.splitlines())
        self.assertIn("'vehicle_state'", said)

    @needs_module("pandas")
    def test_pandas(self):
        said = self.run_file(blocks("python")[1], "frame.py", [sys.executable])
        self.assertEqual(said.splitlines()[-1], "m/s")
        with open(self.folder / "demo_tables/traffic_state.csv", newline="") as table:
            fastest = {}
            for row in csv.DictReader(table):
                speed = float(row["agents.speed_mps"])
                fastest[row["agents.id"]] = max(speed, fastest.get(row["agents.id"], speed))
        printed = dict(re.findall(r"^(\d+) +([\d.]+)$", said, re.MULTILINE))
        self.assertEqual(set(printed), set(fastest))
        for agent, speed in printed.items():
            self.assertAlmostEqual(float(speed), fastest[agent], places=5)

    @needs_program("Rscript", "r-base-core")
    def test_r(self):
        (text,) = blocks("r")
        said = self.run_file(text, "tables.R", ["Rscript", "--vanilla"])
        self.assertIn(self.sentence, said.splitlines())
        self.assertGreater((self.folder / "speed.pdf").stat().st_size, 1000)

    @needs_program("octave-cli", "octave")
    def test_octave(self):
        (text,) = blocks("octave")
        text = text.replace("plot(", "numel(")  # there is no screen
        self.assertIn(self.sentence, self.run_file(text, "tables.m", ["octave-cli", "--norc"]).splitlines())

    @needs_module("matplotlib")
    def test_notebooks(self):
        (self.folder / "drive.mcap").hardlink_to(self.folder / "demo.mcap")
        found = sorted(NOTEBOOKS.glob("*.ipynb"))
        self.assertTrue(found)
        for path in found:
            cells = json.loads(path.read_text())["cells"]
            for cell in cells:
                self.assertFalse(cell.get("outputs"), f"{path}: outputs are not kept")
            text = "\n\n".join("".join(cell["source"]) for cell in cells if cell["cell_type"] == "code")
            self.run_file(text, f"{path.stem}.py", [sys.executable])
            pictures = re.findall(r'savefig\("([^"]+)"', text)
            self.assertGreaterEqual(len(pictures), 3)
            for picture in pictures:
                data = (self.folder / picture).read_bytes()
                self.assertEqual(data[:8], b"\x89PNG\r\n\x1a\n")
                self.assertGreater(min(struct.unpack(">II", data[16:24])), 300)


if __name__ == "__main__":
    unittest.main()
