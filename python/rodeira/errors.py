# SPDX-License-Identifier: Apache-2.0
"""The exception and the warning of this package."""

from __future__ import annotations

import os
from collections.abc import Iterable


class Error(Exception):
    """Wrong input or damaged data: one sentence with place, what was found and what was expected."""

    id = ""  # of an error that `rodeira env` has found (docs/reference/errors.md)


class RecordingWarning(UserWarning):
    """Part of a recording cannot be read; the rest can."""


def _distance(a: str, b: str) -> int:
    """The edit distance: insert, delete, replace, swap of neighbours."""
    rows = [list(range(len(b) + 1))]
    for i, left in enumerate(a, 1):
        row = [i]
        for j, right in enumerate(b, 1):
            best = min(rows[-1][j - 1] + (left != right), rows[-1][j] + 1, row[-1] + 1)
            if i > 1 and j > 1 and left == b[j - 2] and a[i - 2] == right:
                best = min(best, rows[-2][j - 2] + 1)
            row.append(best)
        rows.append(row)
    return rows[-1][-1]


_LONGEST_COMPARED = 80
_SHOWN = 12


def did_you_mean(name: str, known: Iterable[str]) -> str:
    """The end of a sentence, by the rule of the program's messages: the nearest of the known names; where none is near,
    those that have a word in common with it, or else the first ones."""
    names = list(dict.fromkeys(known))
    if len(name) <= _LONGEST_COMPARED:
        near = [(_distance(name, other), i) for i, other in enumerate(names)
                if 3 * abs(len(name) - len(other)) <= max(len(name), len(other))]
        near = [(far, i) for far, i in near if 3 * far <= max(len(name), len(names[i]))]
        if near:
            return f"; did you mean '{names[min(near)[1]]}'?"
    with_unit = [other for other in names if other.startswith(name + "_")]
    if len(with_unit) == 1:
        return f"; did you mean '{with_unit[0]}'?"
    words = {word for word in name.split("_")[:-1] if len(word) > 2}
    alike = [other for other in names if words & set(other.replace(".", "_").split("_"))] or names
    if not alike:
        return ""
    return f"; known are {', '.join(alike[:_SHOWN])}" + (", …" if len(names) > min(len(alike), _SHOWN) else "")


def nearest_file(path: str) -> str:
    """The same of a file that is not there: names of the same kind, or of the same stem, in its folder; empty if none
    is near."""
    stem, ending = os.path.splitext(os.path.basename(path))
    try:
        names = sorted(entry.name for entry in os.scandir(os.path.dirname(path) or ".") if entry.is_file())
    except OSError:
        return ""
    said = did_you_mean(stem + ending, [name for name in names if os.path.splitext(name)[1] == ending
                                        or os.path.splitext(name)[0] == stem])
    return said if "did you mean" in said else ""
