# SPDX-License-Identifier: Apache-2.0
"""Values: what the encoder of cdr.py has written, by hand and value by value, is what the decoder gives."""

import random
import unittest

import numpy as np
from cdr import Cdr
from rodeira.decode import BadMessage, Decoder
from rodeira.idl import find_type
from rodeira.layout import Layouts
from rodeira.nodes import finished


def decode(idl, name, payloads, gap=b"\xff\xff\xff"):
    """The messages with other bytes between them, so that they begin anywhere."""
    data, start, end = b"", [], []
    for payload in payloads:
        data += gap
        start.append(len(data))
        data += payload
        end.append(len(data))
    kind = find_type(idl, name, "test")
    return finished(Decoder(kind, Layouts()).decode(data, np.array(start, dtype=np.int64),
                                                    np.array(end, dtype=np.int64)))


class Values(unittest.TestCase):
    def test_numbers_of_each_kind_in_both_byte_orders(self):
        idl = """enum E { A, B }; struct T { boolean b; octet o; int8 i; short s; unsigned short us; long l;
            unsigned long ul; long long ll; unsigned long long ull; float f; double d; E e; char c; };"""
        rows = [(1, 255, -128, -2 ** 15, 2 ** 16 - 1, -2 ** 31, 2 ** 32 - 1, -2 ** 63, 2 ** 64 - 1, 0.5, 1 / 3, 1, 65),
                (0, 0, 127, 7, 8, 9, 10, 11, 2 ** 63 + 1, -0.0, 1e300, 0, 0)]
        codes = "?BbhHiIqQfdIB"
        for order in ("<", ">"):
            payloads = []
            for row in rows:
                cdr = Cdr(order)
                for code, value in zip(codes, row):
                    cdr.put(code, value)
                payloads.append(cdr.payload())
            values = decode(idl, "T", payloads)
            for i, row in enumerate(rows):
                self.assertEqual(values[i].item(), row)

    def test_both_byte_orders_in_one_topic_keep_their_order(self):
        payloads = [Cdr(order).put("i", i).text(f"n{i}").payload() for i, order in enumerate("<><>>")]
        values = decode("struct T { long a; string s; };", "T", payloads)
        self.assertEqual(values["a"].tolist(), [0, 1, 2, 3, 4])
        self.assertEqual(values["s"].tolist(), ["n0", "n1", "n2", "n3", "n4"])

    def test_arrays_keep_their_axes(self):
        idl = "struct P { double x; float y; }; struct T { octet o; float m[2][3]; P p[2]; };"
        cdr = Cdr().put("B", 1).put("f", *range(6)).put("d", 10).put("f", 11).put("d", 12).put("f", 13)
        values = decode(idl, "T", [cdr.payload()])
        self.assertEqual(values["m"].tolist(), [[[0, 1, 2], [3, 4, 5]]])
        self.assertEqual(values["p"]["x"].tolist(), [[10, 12]])  # 12 bytes, then 4 of padding: no single stride
        self.assertEqual(values["p"]["y"].tolist(), [[11, 13]])

    def test_padding_of_elements_depends_on_where_they_begin(self):
        idl = "struct P { octet a; double x; octet b; }; struct T { string name; sequence<P> points; octet end; };"
        payloads, expected = [], []
        for name in ("", "a", "ab", "abcdefg"):
            for count in (0, 1, 2, 5, 11):
                cdr = Cdr().text(name).put("I", count)
                for i in range(count):
                    cdr.put("B", i).put("d", i + 0.5).put("B", 100 + i)
                payloads.append(cdr.put("B", 99).payload())
                expected.append((name, [(i, i + 0.5, 100 + i) for i in range(count)]))
        values = decode(idl, "T", payloads)
        self.assertEqual(values["end"].tolist(), [99] * len(expected))
        self.assertEqual([(str(values["name"][i]), values["points"][i].tolist()) for i in range(len(expected))],
                         expected)

    def test_sequences_of_texts_and_of_structures_with_texts(self):
        idl = """struct E { string name; sequence<double> v; string tail; };
            struct T { sequence<string> words; sequence<E> events; unsigned long end; };"""
        rng = random.Random(4)
        payloads, expected = [], []
        for _ in range(40):
            words = ["ü" * rng.randrange(4) for _ in range(rng.randrange(4))]
            events = [("n" * rng.randrange(9), [rng.random() for _ in range(rng.randrange(3))], "t" * rng.randrange(3))
                      for _ in range(rng.randrange(5))]
            cdr = Cdr().put("I", len(words))
            for word in words:
                cdr.text(word)
            cdr.put("I", len(events))
            for name, v, tail in events:
                cdr.text(name).put("I", len(v)).put("d", *v).text(tail)
            payloads.append(cdr.put("I", 7).payload())
            expected.append((words, events))
        values = decode(idl, "T", payloads)
        self.assertTrue((values["end"] == 7).all())
        for i, (words, events) in enumerate(expected):
            self.assertEqual(values["words"][i].tolist(), words)
            got = values["events"][i]
            self.assertEqual([(str(n), v.tolist(), str(t)) for n, v, t in zip(got["name"], got["v"], got["tail"])],
                             events)

    def test_an_empty_sequence_of_doubles_has_no_padding(self):
        values = decode("struct T { sequence<double> v; long end; };", "T", [Cdr().put("I", 0).put("i", 5).payload()])
        self.assertEqual(values["end"].tolist(), [5])

    def test_texts_as_fast_cdr_reads_them(self):
        payloads = [Cdr().text(raw).payload() for raw in (b"\0", b"", b"ab", b"ab\0", b"ab\0\0", b"\xe4\0")]
        values = decode("struct T { string s; };", "T", payloads)
        self.assertEqual(values["s"].tolist(), ["", "", "ab", "ab", "ab\0", "\\xe4"])

    def test_wrong_messages_name_byte_member_and_message(self):
        idl = "struct P { long n; sequence<double, 2> v; }; struct T { long a; P p; };"
        good = Cdr().put("i", 1, 2).put("I", 1).put("d", 0.5).payload()
        for bad, sentence in (
                (good[:-1], "byte 20 ('p.v'): the message ends after 7 bytes; at least 8 more were expected"),
                (good[:-9], "byte 16 ('p.v'): a sequence of 1 elements was found, but only 3 bytes are left"),
                (good[:9], "byte 8 ('p.n'): the message ends after 1 bytes; at least 4 more were expected"),
                (good + b"1234", "byte 28: 4 bytes are left behind the last value"),
                (Cdr().put("i", 1, 2).put("I", 3).put("d", 1, 2, 3).payload(),
                 "byte 16 ('p.v'): a sequence of 3 elements was found; at most 2 were expected"),
                (b"\0\7" + good[2:], "the encapsulation is 00 07; 00 00 or 00 01 (CDR version 1) was expected"),
                (b"\0\1", "the message has 2 bytes; the four of its encapsulation were expected")):
            with self.assertRaises(BadMessage) as caught:
                decode(idl, "T", [good, bad, good])
            self.assertEqual(caught.exception.sentence, sentence)
            self.assertEqual(caught.exception.message, 1)
        with self.assertRaises(BadMessage) as caught:
            decode("struct T { boolean b[3]; };", "T", [Cdr().put("B", 0, 1, 2).payload()])
        self.assertEqual(caught.exception.sentence, "byte 4: a boolean of 2 was found; 0 or 1 was expected")

    def test_transport_padding_is_passed_over(self):
        for left in (1, 2, 3):
            values = decode("struct T { long a; };", "T", [Cdr().put("i", 6).payload() + bytes(left)])
            self.assertEqual(values["a"].tolist(), [6])

    def test_cut_anywhere_is_a_sentence_and_never_a_value(self):
        idl = "struct E { string s; octet o; }; struct T { sequence<E> e; double d[2]; sequence<octet> raw; };"
        whole = Cdr().put("I", 2).text("ab").put("B", 1).text("").put("B", 2).put("d", 1, 2).put("I", 3).put(
            "B", 7, 8, 9).payload()
        for size in range(len(whole)):
            with self.assertRaises(BadMessage):
                decode(idl, "T", [whole[:size]])


if __name__ == "__main__":
    unittest.main()
