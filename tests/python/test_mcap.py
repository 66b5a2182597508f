# SPDX-License-Identifier: Apache-2.0
"""MCAP files that handmade.py writes by the specification: forms, damage, and sentences."""

import importlib.util
import os
import pathlib
import tempfile
import unittest
import warnings

import handmade
import numpy as np
import rodeira
from cdr import Cdr

IDL = "module lab { struct Gaze { long number; double x_m; string word; }; struct Pulse { double beat_hz; }; };"


def gaze(number):
    return Cdr().put("i", number).put("d", number / 8).text(f"w{number % 3}").payload()


def definitions():
    return [handmade.schema(1, "lab::Gaze", IDL), handmade.schema(2, "lab::Pulse", IDL),
            handmade.channel(3, 1, "lab/gaze", "left"), handmade.channel(4, 1, "lab/gaze", "right"),
            handmade.channel(7, 2, "lab/pulse")]


def samples(first, last):
    """Two sources of one topic, and a second topic between them."""
    out = []
    for i in range(first, last):
        out.append(handmade.message(3, 1000 * i, gaze(i)))
        out.append(handmade.message(7, 1000 * i + 1, Cdr().put("d", i).payload()))
        out.append(handmade.message(4, 1000 * i + 2, gaze(-i)))
    return b"".join(out)


class Files(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)

    def path(self, data):
        path = pathlib.Path(self.folder.name) / "file.mcap"
        path.write_bytes(data)
        return path

    def open(self, data):
        """The recording and the warnings of opening it and of reading all topics."""
        with warnings.catch_warnings(record=True) as caught:
            warnings.simplefilter("always")
            drive = rodeira.open(self.path(data))
            for name in drive:
                len(drive[name])
        return drive, [str(warning.message) for warning in caught]

    def check(self, drive, count):
        topic = drive["lab/gaze"]
        self.assertEqual(len(topic), 2 * count)
        self.assertEqual(topic["number"].tolist(), [n for i in range(count) for n in (i, -i)])
        self.assertEqual(topic["x_m"].tolist(), [n / 8 for i in range(count) for n in (i, -i)])
        self.assertEqual(topic["word"].tolist(), [f"w{n % 3}" for i in range(count) for n in (i, -i)])
        self.assertEqual(topic.source.tolist(), ["left", "right"] * count)
        self.assertEqual(topic.time_ns.tolist(), [n for i in range(count) for n in (1000 * i, 1000 * i + 2)])
        self.assertEqual(drive["lab/pulse"]["beat_hz"].tolist(), list(range(count)))
        self.assertEqual(drive["lab/pulse"].read(["beat_hz"])["beat_hz"].tolist(), list(range(count)))
        self.assertEqual(drive["lab/pulse"].sources, ("channel 7",))

    def test_every_form_of_a_whole_file(self):
        kinds = [""] + [kind for kind, module in (("zstd", "zstandard"), ("lz4", "lz4"))
                        if importlib.util.find_spec(module)]
        head = b"".join(definitions())
        forms = {"outside of chunks": head + samples(0, 30)}
        for kind in kinds:
            for indexes in (False, True):
                forms[f"'{kind}' indexes {indexes}"] = b"".join(
                    handmade.chunk(head + samples(10 * i, 10 * i + 10), kind, indexes) for i in range(3))
        forms["chunks and messages outside of them"] = (
            handmade.chunk(head + samples(0, 10), "", True) + samples(10, 20) + handmade.chunk(samples(20, 30)))
        for name, data in forms.items():
            for summary in (b"", head):
                with self.subTest(form=name, summary=bool(summary)):
                    drive, said = self.open(handmade.mcap(data, summary))
                    self.check(drive, 30)
                    self.assertEqual((said, drive.damage), ([], ()))

    @unittest.skipUnless(importlib.util.find_spec("lz4"), "the Python package lz4 is not installed (python3-lz4)")
    def test_damaged_lz4(self):
        head = b"".join(definitions())
        whole = handmade.chunk(samples(0, 10), "lz4")
        broken = whole[:60] + bytes([whole[60] ^ 255]) + whole[61:]
        drive, said = self.open(handmade.mcap(head + broken + samples(0, 5)))
        self.check(drive, 5)
        self.assertIn("is lost", said[0])

    def test_records_of_applications_and_of_later_revisions_are_passed_over(self):
        head = b"".join(definitions())
        strange = handmade.record(0x90, b"own") + handmade.record(0x33, b"later")
        drive, said = self.open(handmade.mcap(strange + head + strange + handmade.chunk(strange + samples(0, 9))))
        self.check(drive, 9)
        self.assertEqual(said, [])

    def test_sources_that_overlap_in_time_are_sorted_by_time(self):
        later = b"".join(handmade.message(4, 1000 * i + 2, gaze(-i)) for i in range(20))
        earlier = b"".join(handmade.message(3, 1000 * i, gaze(i)) for i in range(20))
        topic = self.open(handmade.mcap(b"".join(definitions()) + later + earlier))[0]["lab/gaze"]
        self.assertTrue((np.diff(topic.time_ns) > 0).all())
        self.assertEqual(topic["number"].tolist(), [n for i in range(20) for n in (i, -i)])

    def test_cut_anywhere(self):
        """All chunks that are whole are read, the cut is told with its byte, and nothing is invented."""
        head = b"".join(definitions())
        parts = [handmade.chunk(head + samples(10 * i, 10 * i + 10), "", True) for i in range(3)]
        whole = handmade.mcap(b"".join(parts), head)
        begin = whole.index(parts[0])
        ends = [begin + sum(map(len, parts[:i])) for i in range(4)]
        chunk_ends = [end + len(handmade.chunk(head + samples(10 * i, 10 * i + 10)))
                      for i, end in enumerate(ends[:3])]
        for size in [*range(8, len(whole) - 8, 97), *ends, *chunk_ends]:
            with self.subTest(size=size):
                drive, said = self.open(whole[:size])
                complete = sum(size >= end for end in chunk_ends)
                self.assertTrue(any("the file is cut or damaged here" in sentence for sentence in said), said)
                if complete:
                    self.check(drive, 10 * complete)
                else:
                    self.assertEqual(drive.topics, ())

    def test_a_damaged_chunk_costs_its_own_messages(self):
        head = b"".join(definitions())
        for indexes in (False, True):
            data = (head + handmade.chunk(samples(0, 10), "", indexes) +
                    handmade.chunk(samples(50, 60), "", indexes, crc=1) +
                    handmade.chunk(samples(10, 20), "", indexes))
            drive, said = self.open(handmade.mcap(data))
            self.check(drive, 20)
            self.assertRegex(said[0], r"byte \d+: the chunk with the messages from 0.000 s to 0.000 s is lost: "
                                      "its checksum is wrong")
            self.assertEqual(len(said), 1)
            self.assertEqual(len(drive.damage), 1)

    def test_an_index_that_does_not_fit_is_not_used(self):
        head = b"".join(definitions())
        whole = handmade.chunk(head + samples(0, 5), "", True)
        first = handmade.chunk(head + samples(0, 5))
        for shift in (1, 4, 1 << 40, (1 << 64) - 1):
            index = bytearray(whole[len(first):])
            at = 9 + 2 + 4 + 8  # the first offset of the first index
            moved = (int.from_bytes(index[at:at + 8], "little") + shift) % (1 << 64)
            index[at:at + 8] = moved.to_bytes(8, "little")
            drive, said = self.open(handmade.mcap(first + bytes(index)))
            self.check(drive, 5)
            self.assertEqual(said, [])

    def test_a_schema_that_is_not_readable_leaves_its_topic_out(self):
        head = b"".join(definitions())
        more = (handmade.schema(8, "lab::Odd", "module lab { union Odd switch (long) { case 1: long a; }; };") +
                handmade.channel(9, 8, "lab/odd") + handmade.channel(10, 77, "lab/none") +
                handmade.schema(11, "x", "{}", "jsonschema") + handmade.channel(12, 11, "lab/json", encoding="json") +
                handmade.schema(13, "lab::Big", "module lab { struct P { long a; }; struct Big { P p[10001]; }; };") +
                handmade.channel(14, 13, "lab/big"))
        drive, said = self.open(handmade.mcap(head + more + samples(0, 3)))
        self.check(drive, 3)
        self.assertEqual(set(drive.left_out), {"lab/odd", "lab/none", "lab/json", "lab/big"})
        self.assertEqual(len(said), 4)
        for name, sentence in (("lab/odd", "lab::Odd:1: 'union' is not read"),
                               ("lab/none", "its schema 77 is not in the file"),
                               ("lab/json", "'cdr' with 'omgidl' was expected"),
                               ("lab/big", "it has 10001 columns; at most 10000 were expected")):
            with self.assertRaisesRegex(rodeira.Error, sentence.replace("(", r"\(")):
                drive[name]

    def test_two_types_of_one_topic_are_two_topics(self):
        head = b"".join(definitions()) + handmade.channel(20, 2, "lab/gaze", "third")
        drive, _ = self.open(handmade.mcap(head + samples(0, 2) + handmade.message(20, 5, Cdr().put("d", 8).payload())))
        self.check(drive, 2)
        self.assertEqual(drive["lab/gaze_2"]["beat_hz"].tolist(), [8])

    def test_a_message_that_is_not_of_its_type(self):
        head = b"".join(definitions())
        drive = rodeira.open(self.path(handmade.mcap(head + samples(0, 3) + handmade.message(4, 1500, b"\0\1\0\0abc"))))
        with self.assertRaisesRegex(rodeira.Error, "lab/gaze of 'right' at 1.5e-06 s: byte 4 .'number'.: the message "
                                                   "ends after 3 bytes; at least 4 more were expected"):
            drive["lab/gaze"]["x_m"]

    def test_not_a_recording(self):
        with self.assertRaisesRegex(rodeira.Error, "nothing_like_it.mcap: there is no such file$"):
            rodeira.open(os.path.join(self.folder.name, "nothing_like_it.mcap"))
        pathlib.Path(self.folder.name, "lap_one.mcap").touch()
        with self.assertRaisesRegex(rodeira.Error, "no such file.*'lap_one.mcap'"):
            rodeira.open(os.path.join(self.folder.name, "lap_on.mcap"))
        with self.assertRaisesRegex(rodeira.Error, "a recording was expected"):
            rodeira.open(self.folder.name)
        for data in (b"", b"time_s,step\n1,2\n", handmade.MAGIC[:5]):
            with self.assertRaisesRegex(rodeira.Error, "no MCAP recording"):
                rodeira.open(self.path(data))

    def test_names_that_do_not_exist(self):
        drive, _ = self.open(handmade.mcap(b"".join(definitions()) + samples(0, 3)))
        with self.assertRaisesRegex(rodeira.Error, "unknown topic 'lab/gase'; did you mean 'lab/gaze'"):
            drive["lab/gase"]
        for name, nearest in (("x", "x_m"), ("nunber", "number"), ("word.x", "word"), ("number[0]", "number")):
            with self.assertRaisesRegex(rodeira.Error, f"did you mean '{nearest}'"):
                drive["lab/gaze"][name]
            with self.assertRaisesRegex(rodeira.Error, f"did you mean '{nearest}'"):
                drive["lab/gaze"].read(["word", name])
        with self.assertRaisesRegex(rodeira.Error, r"unknown column 'speed'; known are number, x_m, word"):
            drive["lab/gaze"]["speed"]
        for name in ("", ".", "a..b", "[0]", "number.", " number"):
            with self.assertRaises(rodeira.Error):
                drive["lab/gaze"][name]
        with self.assertRaisesRegex(rodeira.Error, "is not one array"):
            drive["lab/gaze"].array()

    def test_attachments_and_metadata(self):
        data = (b"".join(definitions()) + handmade.attachment("launch.yaml", b"seed: 1\n") +
                handmade.attachment("override", b"seed=2") + handmade.attachment("override", b"pace=max") +
                handmade.metadata("rodeira.meta", {"participant": "P07", "condition": "dry"}))
        drive, said = self.open(handmade.mcap(data))
        self.assertEqual(drive.files, {"launch.yaml": b"seed: 1\n"})
        self.assertEqual(drive.overrides, ("seed=2", "pace=max"))
        self.assertEqual(drive.meta, {"participant": "P07", "condition": "dry"})
        self.assertEqual((len(drive["lab/gaze"]), drive["lab/gaze"]["word"].tolist(), said), (0, [], []))
        broken = data.replace(b"seed: 1\n", b"seed: 3\n")
        drive, said = self.open(handmade.mcap(broken))
        self.assertEqual(drive.files, {})
        self.assertIn("the attachment 'launch.yaml' is damaged", said[0])

    def test_marks_of_the_operator_and_of_the_scenario_by_time(self):
        folder = pathlib.Path(__file__).parents[2] / "idl"
        text = (folder / "sample_header.idl").read_text() + (folder / "run_log.idl").read_text() + (
            folder / "scenario.idl").read_text()
        idl = "".join(line for line in text.splitlines(True) if not line.startswith("#"))
        data = [handmade.schema(1, "rodeira::msg::Remark", idl), handmade.channel(1, 1, "rodeira/remarks", "clock"),
                handmade.schema(2, "rodeira::msg::ScenarioEvents", idl),
                handmade.channel(2, 2, "rodeira/scenario_events", "story")]
        for time_ns, kind, words in ((0, "start", ""), (2_500_000_000, "mark", "calibrated"),
                                     (9_000_000_000, "mark", "")):
            cdr = Cdr().put("q", time_ns // 1_000_000, time_ns, 17, 18).put("d", 1)
            cdr = cdr.text(kind).text(words).put("I", 1, 0)
            data.append(handmade.message(1, time_ns, cdr.payload()))
        for time_ns, name in ((1_000_000_000, "mark"), (4_000_000_000, "weather"), (5_000_000_000, "mark")):
            cdr = Cdr().put("q", time_ns // 1_000_000, time_ns).put("I", 0, 0).put("Q", 5).put("I", 1)
            cdr.text(name).text("a word").put("d", 0.5).put("I", 0, 0, 0)
            data.append(handmade.message(2, time_ns, cdr.payload()))
        drive, said = self.open(handmade.mcap(b"".join(data)))
        self.assertEqual(said, [])
        self.assertEqual(drive.marks, [(1.0, "a word", "story"), (2.5, "calibrated", "clock"), (5.0, "a word", "story"),
                                       (9.0, "", "clock")])
        self.assertEqual(drive.remarks[1], (2.5, 2500, "mark", "calibrated", 17, 1.0))
        self.assertEqual(drive.events[1], (4.0, "story", "weather", "a word", 0.5))

    def test_flipped_bytes_never_crash(self):
        head = b"".join(definitions())
        whole = handmade.mcap(handmade.chunk(head + samples(0, 4), "", True) + samples(4, 6), head)
        for at in range(8, len(whole), 3):
            data = bytearray(whole)
            data[at] ^= 0x55
            try:
                self.open(bytes(data))
            except rodeira.Error:
                pass


if __name__ == "__main__":
    unittest.main()
