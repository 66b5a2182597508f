# SPDX-License-Identifier: Apache-2.0
"""The parts of a Markdown page that the checks need: lines of prose, sentences, headings, links, pictures, code."""

import re

FENCE = re.compile(r"^\s*(```|~~~)")
LINK = re.compile(r"(!?)\[((?:[^\[\]]|\[[^\]]*\])*)\]\(([^()\s]+)\)")


class Page:
    """One page. `lines` has (number, text, code): `code` is True within a block of code."""

    def __init__(self, path):
        self.path = path
        self.text = path.read_text(encoding="utf-8")
        self.lines = []
        code = False
        for number, line in enumerate(self.text.splitlines(), 1):
            if FENCE.match(line):
                code = not code
                self.lines.append((number, line, True))
            else:
                self.lines.append((number, line, code))

    def prose(self):
        """(number, text) of the lines outside of blocks of code."""
        return [(number, text) for number, text, code in self.lines if not code]

    def links(self):
        """(number, is_picture, target) of every link and picture."""
        text = "\n".join("" if code else re.sub(r"`[^`]*`", lambda quote: "x" * len(quote[0]), line)
                         for _, line, code in self.lines)
        return [(text.count("\n", 0, match.start()) + 1, match[1] == "!", match[3]) for match in LINK.finditer(text)]

    def anchors(self):
        """The anchors of the headings, as GitHub and mkdocs make them: lower case, punctuation out, blanks as '-'."""
        anchors, seen = set(), {}
        for _, text in self.prose():
            heading = re.match(r"#{1,6} +(.*)", text)
            if not heading:
                continue
            words = re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", heading[1])
            anchor = re.sub(r"[^\w\- ]", "", words.lower()).strip().replace(" ", "-")
            count = seen.get(anchor, 0)
            seen[anchor] = count + 1
            anchors.add(f"{anchor}-{count}" if count else anchor)
        return anchors

    def commands(self):
        """(number, text) of every command of `rodeira` in a block of code, or between backticks."""
        found = []
        joined, start = "", 0
        for number, text, code in self.lines:
            if not code:
                found += [(number, inline) for inline in re.findall(r"`(rodeira [^`]*)`", text)]
                joined = ""
                continue
            if FENCE.match(text):
                joined = ""
                continue
            start = start if joined else number
            joined += text.rstrip().removesuffix("\\") + " "
            if text.rstrip().endswith("\\"):
                continue
            command = re.match(r"\s*(?:\S*\$\s+)?(?:\S*/)?(rodeira [a-z].*)$", joined)
            if command:
                found.append((start, re.sub(r"\s#.*", "", command[1]).strip()))
            joined = ""
        return found

    def table_rows(self):
        """(number, cells) of the rows of tables, without the lines under the headings."""
        rows = []
        for number, text in self.prose():
            if text.lstrip().startswith("|"):
                cells = [cell.strip() for cell in re.split(r"(?<!\\)\|", text.strip().strip("|"))]
                if not all(re.fullmatch(r":?-+:?", cell) for cell in cells):
                    rows.append((number, cells))
        return rows

    def sentences(self):
        """(number, words) of every sentence of paragraphs, lists and cells of tables."""
        found = []
        for number, cells in self.table_rows():
            for cell in cells:
                found += [(number, words) for words in split_sentences(cell)]
        for number, paragraph in self.paragraphs():
            found += [(number, words) for words in split_sentences(paragraph)]
        return found

    def paragraphs(self):
        """(number of the first line, text) of paragraphs and items of lists."""
        found, text, start = [], "", 0
        for number, line, code in [*self.lines, (0, "", False)]:
            stops = code or not line.strip() or re.match(r"\s*(\||#|<!--|!\[|>)", line)
            item = re.match(r"\s*(?:[-*]|\d+\.) +(.*)", line)
            if (stops or item) and text:
                found.append((start, text))
                text = ""
            if stops:
                continue
            if not text:
                start = number
            text += (item[1] if item else line.strip()) + " "
        return found


def split_sentences(text):
    """The sentences of a text, each as a list of its words. A piece of code counts as one word."""
    text = re.sub(r"!?\[((?:[^\[\]]|\[[^\]]*\])*)\]\([^)]*\)", r"\1", text)
    text = re.sub(r"`[^`]*`", "CODE", text).replace("**", "")
    sentences = re.split(r"(?<=[.!?:;])\s+(?=[^a-z]|$)|(?<=[.!?])\s+", text)
    return [words for sentence in sentences if (words := re.findall(r"[\w'’.°%/-]*\w[\w'’.°%/-]*", sentence))]
