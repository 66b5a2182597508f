# SPDX-License-Identifier: Apache-2.0
"""The study of examples/study: its first pair of drives gives the first rows of the table that stands there, R's
t-test of that table gives the result that the tutorial shows, and SciPy's t-test agrees. RODEIRA names the program; R
and SciPy are needed for their parts, which are skipped without them."""

import csv
import importlib.util
import os
import pathlib
import re
import shutil
import subprocess
import tempfile
import unittest

ROOT = pathlib.Path(__file__).parents[2]
STUDY = ROOT / "examples/study"
PROGRAM = os.environ.get("RODEIRA", "")
NAMES = ("file", "participant", "condition", "run", "interval")


def rows(path):
    with open(path, newline="", encoding="utf-8") as table:
        return list(csv.DictReader(table))


def result():
    """(interval, measure) and the numbers of each line of the result."""
    for line in (STUDY / "result.txt").read_text().splitlines()[1:]:
        interval, measure, *numbers = line.replace(" to ", " ").split()
        yield interval, measure, [float(number) for number in numbers]


class Study(unittest.TestCase):
    @unittest.skipUnless(PROGRAM, "RODEIRA does not name the program")
    def test_the_first_pair_gives_the_rows_of_the_table(self):
        with tempfile.TemporaryDirectory() as folder:
            done = subprocess.run([STUDY / "run", folder, "1"], capture_output=True, text=True, timeout=280,
                                  env={**os.environ, "RODEIRA": PROGRAM}, check=False)
            self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
            found = rows(pathlib.Path(folder) / "table.csv")
            written = pathlib.Path(folder) / "P01-dry.mcap"
            before = written.stat().st_mtime_ns
            again = subprocess.run([STUDY / "run", folder, "1"], capture_output=True, text=True, timeout=280,
                                   env={**os.environ, "RODEIRA": PROGRAM}, check=False)
            self.assertEqual(again.returncode, 0, again.stderr)
            self.assertEqual(written.stat().st_mtime_ns, before, "a recorded drive is not repeated")
            self.assertEqual(rows(pathlib.Path(folder) / "table.csv"), found)
        expected = [row for row in rows(STUDY / "table.csv") if row["participant"] == "P01"]
        self.assertEqual(len(found), len(expected))
        for got, want in zip(found, expected):
            for name, value in want.items():
                if name in NAMES or value == "" or got[name] == "":
                    self.assertEqual(got[name], value, name)
                else:
                    self.assertAlmostEqual(float(got[name]), float(value), delta=1e-6 * abs(float(value)), msg=name)

    def test_the_tutorial_shows_the_result(self):
        page = (ROOT / "docs/tutorials/first-study.md").read_text()
        shown = re.findall(r"^```text\n(.*?)^```$", page, re.DOTALL | re.MULTILINE)
        self.assertEqual(shown, [(STUDY / "result.txt").read_text()])

    @unittest.skipUnless(shutil.which("Rscript"), "Rscript is not installed (Debian: r-base-core)")
    def test_r_gives_the_result(self):
        done = subprocess.run(["Rscript", "--vanilla", STUDY / "test.R", STUDY / "table.csv"], capture_output=True,
                              text=True, timeout=120, check=True)
        self.assertEqual(done.stdout, (STUDY / "result.txt").read_text())

    @unittest.skipUnless(importlib.util.find_spec("scipy"), "the Python package scipy is not installed")
    def test_scipy_agrees(self):
        from scipy import stats  # pylint: disable=import-outside-toplevel

        table = rows(STUDY / "table.csv")
        count = 0
        for interval, measure, numbers in result():
            of = {}
            for row in table:
                if row["interval"] == interval and row[measure]:
                    of.setdefault(row["participant"], {})[row["condition"]] = float(row[measure])
            pairs = [pair for pair in of.values() if len(pair) == 2]
            t, p = stats.ttest_rel([pair["rain"] for pair in pairs], [pair["dry"] for pair in pairs])
            self.assertAlmostEqual(t, numbers[5], delta=0.0051)
            self.assertEqual(len(pairs) - 1, numbers[6])
            self.assertAlmostEqual(p, numbers[7], delta=0.06 * p)
            count += 1
        self.assertGreaterEqual(count, 4)


if __name__ == "__main__":
    unittest.main()
