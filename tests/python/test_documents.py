# SPDX-License-Identifier: Apache-2.0
"""The tables of docs/reference/python.md have every public name of the package and no other. Those of
docs/reference/wire.md are compared with idl/topics.cpp and idl/aliases.cpp."""

import inspect
import pathlib
import re
import unittest

import rodeira
from rodeira import aliases

ROOT = pathlib.Path(__file__).parents[2]
MARK = "tests/python/test_documents.py"


def marked(page):
    """The rows of tables between the marks: lists of cells, by the heading above."""
    rows, heading, inside = {}, "", False
    for line in (ROOT / "docs/reference" / page).read_text(encoding="utf-8").splitlines():
        if line.startswith("## "):
            heading = line[3:]
        if line.startswith(f"<!-- {MARK}"):
            inside = line.endswith(" begins -->")
        if inside and line.startswith("|") and not line.startswith("|---"):
            rows.setdefault(heading, []).append([cell.strip() for cell in line.strip("|").split("|")])
    return {heading: lines[1:] for heading, lines in rows.items()}


def code(cell):
    return re.findall(r"`([^`]+)`", cell)


def public(kind):
    """Names of a class: methods, properties, and what `__init__` sets."""
    made = re.findall(r"self\.([a-z]\w*)\b(?=[^=\n]* = )", inspect.getsource(kind.__init__))
    return {name for name in (*vars(kind), *made) if not name.startswith("_")}


class PythonPage(unittest.TestCase):
    def setUp(self):
        self.tables = marked("python.md")

    def names(self, heading):
        """The first word of each name: `read(["time_s"])` is read, `topic["x"]` is no name."""
        words = [word for row in self.tables[heading] for word in code(row[0])]
        return [re.match(r"\w+", word)[0] for word in words if not re.match(r"\w+\[", word)]

    def test_each_public_name_has_a_row_and_each_row_a_name(self):
        for heading, kind in (("Recording", rodeira.Recording), ("Topic", rodeira.Topic), ("Ragged", rodeira.Ragged),
                              ("Agents", rodeira.Samples)):
            with self.subTest(heading):
                names = self.names(heading)
                self.assertEqual(set(names), public(kind))
                self.assertEqual(len(names), len(set(names)))

    def test_rows_name_the_members_of_their_values(self):
        told = {name: code(row[1]) for row in self.tables["Recording"] for name in code(row[0])}
        for name, kind in (("events", rodeira.Event), ("marks", rodeira.Mark), ("remarks", rodeira.Remark)):
            self.assertEqual(told[name], [kind.__name__, *kind._fields])

    def test_each_name_of_the_package_stands_on_the_page(self):
        page = (ROOT / "docs/reference/python.md").read_text(encoding="utf-8")
        for name in rodeira.__all__:
            self.assertRegex(page, rf"\b{name}\b")


class WirePage(unittest.TestCase):
    def setUp(self):
        self.tables = marked("wire.md")

    def test_each_topic_stands_on_the_page_with_its_type_and_file(self):
        names = dict(re.findall(r'(k\w+) =\s*"rodeira/([^"]+)"', (ROOT / "idl/topics.hpp").read_text()))
        rows = re.findall(r'\{topics::(k\w+), "rodeira::msg::(\w+)", "(\w+)", (true|false)\}',
                          (ROOT / "idl/topics.cpp").read_text())
        self.assertEqual(len(rows), len(names))
        wanted = {names[constant].rstrip("/"): (kind, f"{file}.idl")
                  for constant, kind, file, lockstep in rows if lockstep == "false"}
        told = {}
        for topics, types, _ in self.tables["Topics"]:
            *kinds, file = code(types)
            told |= {topic.partition("/")[0]: (kind, file) for topic, kind in zip(code(topics), kinds, strict=True)}
        self.assertEqual(told, wanted)
        page = (ROOT / "docs/reference/wire.md").read_text(encoding="utf-8")
        listed = code(" ".join(re.findall(r"^> .*", page, re.MULTILINE)))
        self.assertEqual(listed, [names[constant] for constant, _, _, lockstep in rows if lockstep == "true"])

    def test_each_earlier_name_has_a_row(self):
        short = {**aliases.TOPICS}
        short |= {old.rpartition("::")[2]: new.rpartition("::")[2] for old, new in aliases.TYPES.items()}
        before = {new: old for old, new in aliases.TYPES.items()}
        short |= {f"{before.get(kind, kind).rpartition('::')[2]}.{old}": f"{kind.rpartition('::')[2]}.{new}"
                  for (kind, old), new in aliases.MEMBERS.items()}
        rows = self.tables["Recordings of other versions"]
        told = {code(old)[0]: code(new)[0] for old, new in rows}
        self.assertEqual(told, short)
        self.assertEqual(len(rows), len(told))

    def test_aliases_are_those_of_the_programs(self):
        text = (ROOT / "idl/aliases.cpp").read_text()
        pairs = re.findall(r'\{"(rodeira[^"]+)", "(rodeira[^"]+)"\}', text)
        self.assertEqual(dict(pairs), {**aliases.TOPICS, **aliases.TYPES})
        members = re.findall(r'\{\{"([^"]+)", "([^"]+)"\}, "([^"]+)"\}', text)
        self.assertEqual({(kind, old): new for kind, old, new in members}, aliases.MEMBERS)


if __name__ == "__main__":
    unittest.main()
