# SPDX-License-Identifier: Apache-2.0
"""Measures of given paths and decisions, which no recording alone has: lane-change test, encounters, gap acceptance."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from .measured import Measure
from .native import extension


class Path(NamedTuple):
    """The footprint of a vehicle over time: its middle, its heading from east (counter-clockwise), length and width."""
    x_m: ArrayLike
    y_m: ArrayLike
    heading_rad: ArrayLike
    length_m: float
    width_m: float


def _call(name: str, function: str, *words: Any) -> Measure:
    value, unit, n, valid_share, reason, options = getattr(extension(f"rodeira.{name}"), function)(*words)
    return Measure(name, float("nan") if value is None else value, unit, n, valid_share, reason, options)


def _numbers(values: ArrayLike) -> np.ndarray:
    return np.asarray(values, dtype=np.float64)


def mean_deviation(s_m: ArrayLike, t_m: ArrayLike, signs: Iterable[tuple[float, float]], *, from_s_m: float,
                   to_s_m: float, start_t_m: float, before_m: float = 30.0, length_m: float = 10.0) -> Measure:
    """Mean deviation of the lane-change test (ISO 26022): (1/L) ∫ |t − reference| ds from one station to another.

    signs: station and lateral position of the lane that it demands, ascending. The basic reference path begins its
    change 30 m before a sign and is 10 m long; an adaptive one takes both from the person's baseline.
    """
    return _call("mean_deviation", "mean_deviation", _numbers(s_m), _numbers(t_m), from_s_m, to_s_m, list(signs),
                 before_m, length_m, start_t_m)


def correct_changes(s_m: ArrayLike, t_m: ArrayLike, signs: Iterable[tuple[float, float]], *, half_lane_m: float,
                    by_m: float) -> Measure:
    """Share of the signs with a lane that is reached `by_m` behind the sign."""
    return _call("correct_changes", "correct_changes", _numbers(s_m), _numbers(t_m), list(signs), half_lane_m, by_m)


def pet(first: Path, second: Path, rate_hz: float) -> Measure:
    """Post-encroachment time of two paths on one time base: from where one vehicle leaves the area that both sweep, to
    where the other enters it, in s; negative where they collide."""
    words = [word for path in (first, second) for word in (
        (_numbers(path.x_m), _numbers(path.y_m), _numbers(path.heading_rad)), path.length_m, path.width_m)]
    return _call("pet", "post_encroachment", *words, rate_hz)


def raff_gap(accepted_s: ArrayLike, rejected_s: ArrayLike) -> Measure:
    """Critical gap by Raff: as many accepted gaps are shorter as rejected ones are longer."""
    return _call("raff_gap", "raff_gap", _numbers(accepted_s), _numbers(rejected_s))


def troutbeck_gap(drivers: Iterable[tuple[float, float]]) -> Measure:
    """Mean critical gap by maximum likelihood, lognormal (Troutbeck 1992). drivers: accepted gap and largest rejected
    one (0: none) of each; a driver with an accepted gap below a rejected
    one is left out and counted in the options."""
    return _call("troutbeck_gap", "troutbeck_gap", [(float(a), float(r)) for a, r in drivers])
