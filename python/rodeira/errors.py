# SPDX-License-Identifier: Apache-2.0
"""The exception and the warning of this package."""

from __future__ import annotations

import difflib
from collections.abc import Iterable


class Error(Exception):
    """Wrong input or damaged data: one sentence with place, what was found and what was expected."""

    id = ""  # of an error that `rodeira env` has found (docs/reference/errors.md)


class RecordingWarning(UserWarning):
    """Part of a recording cannot be read; the rest can."""


def did_you_mean(name: str, known: Iterable[str]) -> str:
    """The nearest of the known names as the end of a sentence; empty if none is near."""
    near = difflib.get_close_matches(name, list(known), n=1, cutoff=0.5)
    return f"; did you mean '{near[0]}'?" if near else ""
