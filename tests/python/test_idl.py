# SPDX-License-Identifier: Apache-2.0
"""IDL texts: types by the grammar of OMG IDL 4.2, and sentences for what is not read."""

import pathlib
import re
import unittest

import rodeira
from rodeira import aliases
from rodeira.idl import find_type, read_types
from rodeira.idl_types import Array, Plain, Sequence, Text


class Types(unittest.TestCase):
    def test_members_of_each_kind(self):
        kind = find_type("""
            module lab { const unsigned short kN = 3;
              enum Colour { RED, @default_literal GREEN };
              module inner { struct Point { double x, y; }; };
              typedef float Row[2];
              @final struct All {
                boolean b; octet o; char c; short s; unsigned short us; long l; unsigned long ul;
                long long ll; unsigned long long ull; int8 i; uint64 u; float f; double d;
                string text; string<8> short_text; sequence<inner::Point, 4> points; Row rows[kN];
                Colour colour; @unit("bar") double pressure;
              }; };""", "lab::All", "all")
        of = {member.name: member.type for member in kind.members}
        codes = [of[name].code for name in "b o c s us l ul ll ull i u f d".split()]
        self.assertEqual(codes, "b1 u1 u1 i2 u2 i4 u4 i8 u8 i1 u8 f4 f8".split())
        self.assertEqual((of["text"], of["short_text"]), (Text(0), Text(8)))
        self.assertEqual(of["points"].bound, 4)
        self.assertIsInstance(of["points"], Sequence)
        self.assertEqual(of["rows"], Array(Array(Plain("f4", 4), 2), 3))
        self.assertEqual(of["colour"].enumerators, ("RED", "GREEN"))
        self.assertEqual(kind.members[-1].unit, "bar")

    def test_names_are_searched_from_the_innermost_module_outwards(self):
        kind = find_type("struct T { long a; }; module m { struct T { short b; }; struct U { T inner; ::T outer; }; };",
                         "m::U", "x")
        self.assertEqual([member.type.members[0].name for member in kind.members], ["b", "a"])

    def test_what_is_not_read_is_refused_with_its_line(self):
        for text, sentence in (
                ("struct A {\n  wstring s;\n};", "x:2: 'wstring' is not read"),
                ("struct A { long a; long a; };", "x:1: the member 'a' is there twice"),
                ("struct A { };", "x:1: the structure 'A' has no members"),
                ("struct A;", "x:1: forward declarations are not read"),
                ("struct A : B { long a; };", "x:1: structures that inherit are not read"),
                ("struct A { @optional long a; };", "x:1: '@optional' is not read: it makes another encoding"),
                ("@extensibility(MUTABLE) struct A { long a; };",
                 "x:1: '@extensibility(MUTABLE)' is not read: it makes another encoding"),
                ("struct Point { long a; }; struct B { Poimt p; };",
                 "x:1: the type 'Poimt' is not defined before this line; did you mean 'Point'?"),
                ("#include <a.idl>", "x:1: a preprocessor line was found; the text must be complete in itself"),
                ("struct A { long a[0]; };", "x:1: a length of 0 was found; 1 to 4294967296 was expected"),
                ("struct A { long a[010]; };", "x:1: '010' is not a whole number that is defined before this line"),
                ("struct A { long double a; };", "x:1: 'long double' is not read"),
                ("struct A { long a }", "x:1: '}' was found; ';' was expected"),
                ("struct A { $ };", "x:1: the character '$' has no meaning here"),
                ("struct A { long a; };\nstruct A { long a; };", "x:2: 'A' is defined twice")):
            with self.assertRaises(rodeira.Error) as caught:
                read_types(text, "x")
            self.assertEqual(str(caught.exception), sentence)

    def test_nesting_has_a_limit_and_doubled_structures_take_no_time(self):
        deep = "struct S0 { double a; };" + "".join(
            f"struct S{i} {{ S{i - 1} a; S{i - 1} b; }};" for i in range(1, 60))
        self.assertEqual(find_type(deep, "S59", "x").columns, 2 ** 59)
        with self.assertRaisesRegex(rodeira.Error, "nested more than 64 deep"):
            read_types(deep + "".join(f"struct S{i} {{ S{i - 1} a; }};" for i in range(60, 70)), "x")

    def test_unknown_type_of_a_schema(self):
        with self.assertRaisesRegex(rodeira.Error, "did you mean 'lab::Gaze'"):
            find_type("module lab { struct Gaze { long a; }; };", "lab::Gase", "x")

    def test_aliases_are_those_of_the_program(self):
        source = (pathlib.Path(__file__).parents[2] / "idl/aliases.cpp").read_text()
        rows = re.findall(r'\{(?:\{"([^"]+)", "([^"]+)"\}|"([^"]+)"), "([^"]+)"\}', source)
        pairs = {(kind, old): new for kind, old, _, new in rows if kind}
        singles = {old: new for _, _, old, new in rows if old}
        self.assertGreater(len(pairs), 5)
        self.assertEqual(pairs, aliases.MEMBERS)
        self.assertEqual({old: new for old, new in singles.items()}, {**aliases.TOPICS, **aliases.TYPES})


if __name__ == "__main__":
    unittest.main()
