# SPDX-License-Identifier: Apache-2.0
"""`rodeira report` in a real browser: Debian's chromium prints the page, poppler's tools read the PDF. Nothing is cut
off, headings are repeated, and the pictures are there."""

import os
import pathlib
import re
import shutil
import subprocess
import tempfile
import unittest
import xml.etree.ElementTree as ElementTree

import numpy as np

ROOT = pathlib.Path(__file__).parents[2]
PROGRAM = os.environ.get("RODEIRA", "")
A4_PT = (595.0, 842.0)
INTERVALS = ("early=0..2", "middle=2..4", "late=4..6")


def run(*words):
    done = subprocess.run([str(word) for word in words], capture_output=True, timeout=280)
    if done.returncode != 0:
        raise AssertionError((done.stdout + done.stderr).decode(errors="replace"))
    return done.stdout


@unittest.skipUnless(PROGRAM, "RODEIRA does not name the program")
@unittest.skipUnless(shutil.which("chromium"), "the package chromium is not here")
@unittest.skipUnless(shutil.which("pdftotext"), "the package poppler-utils is not here")
class PrintedReport(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.kept = tempfile.TemporaryDirectory()
        cls.folder = pathlib.Path(cls.kept.name)
        drives = []
        for number in range(1, 5):
            drives.append(cls.folder / f"drive{number}.mcap")
            run(PROGRAM, "run", ROOT / "launch/car_ahead.yaml", "--for", 6, "--in-process", "--quiet", "--seed", number,
                "--record", drives[-1])
        page = cls.folder / "report.html"
        run(PROGRAM, "report", *drives, "--intervals", *INTERVALS, "-o", page)
        # The size of paper is a matter of the printer: the page itself names none.
        a4 = cls.folder / "a4.html"
        a4.write_text(page.read_text().replace("</style>", "@page { size: A4; }</style>"))
        cls.pdf = cls.folder / "report.pdf"
        run("chromium", "--headless", "--no-sandbox", "--disable-gpu", f"--user-data-dir={cls.folder / 'profile'}",
            "--no-pdf-header-footer", f"--print-to-pdf={cls.pdf}", a4.as_uri())
        boxes = run("pdftotext", "-bbox", cls.pdf, "-").decode()
        boxes = re.sub(r' xmlns="[^"]*"', "", re.sub(r"<!DOCTYPE[^>]*>", "", boxes))
        cls.pages = ElementTree.fromstring(boxes).findall(".//page")
        cls.texts = [[word.text for word in page.findall("word")] for page in cls.pages]

    @classmethod
    def tearDownClass(cls):
        cls.kept.cleanup()

    def test_every_word_is_on_the_paper(self):
        self.assertGreater(len(self.pages), 3)
        words = 0
        for page in self.pages:
            self.assertEqual((round(float(page.get("width"))), round(float(page.get("height")))), A4_PT)
            for word in page.findall("word"):
                words += 1
                self.assertGreaterEqual(float(word.get("xMin")), 0.0, word.text)
                self.assertLessEqual(float(word.get("xMax")), A4_PT[0], word.text)
        self.assertGreater(words, 1000)

    def test_each_measure_and_interval_is_there(self):
        listed = run(PROGRAM, "measures", "--list").decode()
        names = re.findall(r"^  (\w+)", listed, re.MULTILINE)
        self.assertGreater(len(names), 60)
        words = [word for text in self.texts for word in text]
        for name in names:
            self.assertEqual(words.count(name), 2, name)  # twelve intervals are two tables
        intervals = [interval.split("=")[0] for interval in INTERVALS]
        for page, text in enumerate(self.texts):
            if set(text) & set(names):
                self.assertIn("measure", text, f"page {page + 1} has rows without their headings")
            # Twelve intervals of four recordings, six in a table; none is cut off at the paper's edge.
            self.assertEqual(sum(text.count(name) for name in intervals), 6 * text.count("measure"))

    def test_pictures_are_drawn(self):
        run("pdftoppm", "-r", 40, "-gray", self.pdf, self.folder / "page")
        files = sorted(self.folder.glob("page-*.pgm"))
        self.assertEqual(len(files), len(self.pages))
        inked = []
        for file in files:
            kind, width, height, _ = file.read_bytes().split(maxsplit=4)[:4]
            self.assertEqual(kind, b"P5")
            pixels = np.frombuffer(file.read_bytes()[-int(width) * int(height):], np.uint8)
            inked.append(float(np.mean(pixels < 245)))
        self.assertGreater(min(inked), 0.002, "a blank page")
        ways = [page for page, text in enumerate(self.texts) if "Way" in text]
        self.assertTrue(ways)
        for page in ways:  # the land of a map is not white
            self.assertGreater(inked[page], 0.1)


if __name__ == "__main__":
    unittest.main()
