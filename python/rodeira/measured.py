# SPDX-License-Identifier: Apache-2.0
"""Measures of recordings and of other tables, by the code of `rodeira measures`."""

from __future__ import annotations

import os
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

import numpy as np

from .errors import Error, did_you_mean
from .native import extension
from .recording import Recording

if TYPE_CHECKING:
    import pandas

Columns = Mapping[str, "str | tuple[str, float]"]
_UNEVEN = 0.01  # of the period


@dataclass(frozen=True)
class Measure:
    """A value with what is needed to judge it; `value` is nan where it is missing, and `reason` says why."""
    name: str
    value: float
    unit: str
    n: int
    valid_share: float
    reason: str
    options: Mapping[str, str] = field(hash=False)


@dataclass(frozen=True)
class Row:
    """The measures of an interval of a recording. `row["sdlp_m"]` is the value."""
    file: str
    participant: str
    condition: str
    run: str
    interval: str
    from_s: float
    to_s: float
    measures: Mapping[str, Measure] = field(hash=False)

    def __getitem__(self, name: str) -> float:
        if name not in self.measures:
            raise KeyError(f"no measure '{name}'{did_you_mean(name, self.measures)}")
        return self.measures[name].value


class Measures:
    """A table: a row an interval. `table["sdlp_m"]` are the values of all rows as an array."""

    def __init__(self, rows: list[Row]) -> None:
        self.rows = rows

    def __len__(self) -> int:
        return len(self.rows)

    def __iter__(self) -> Iterator[Row]:
        return iter(self.rows)

    @property
    def names(self) -> tuple[str, ...]:
        """Names of the measures."""
        return tuple(self.rows[0].measures) if self.rows else ()

    def __getitem__(self, name: str) -> np.ndarray:
        return np.array([row[name] for row in self.rows])

    def frame(self) -> "pandas.DataFrame":
        """A column a measure, as `rodeira measures -o table.csv`."""
        records = [{**_head(row), **{name: one.value for name, one in row.measures.items()}} for row in self.rows]
        frame = _pandas().DataFrame(records)
        frame.attrs["units"] = {name: one.unit for row in self.rows for name, one in row.measures.items()}
        return frame

    def long(self) -> "pandas.DataFrame":
        """A row a value, as `rodeira measures --long`."""
        return _pandas().DataFrame([
            {**_head(row), "measure": one.name, "value": one.value, "unit": one.unit, "n": one.n,
             "valid_share": one.valid_share, "reason": one.reason,
             "options": "; ".join(f"{name}={value}" for name, value in one.options.items())}
            for row in self.rows for one in row.measures.values()])

    def __repr__(self) -> str:
        return f"<rodeira.Measures: {len(self.rows)} rows of {len(self.names)} measures>"


def _head(row: Row) -> dict[str, Any]:
    return {name: getattr(row, name)
            for name in ("file", "participant", "condition", "run", "interval", "from_s", "to_s")}


def _pandas() -> Any:
    try:
        import pandas
    except ImportError:
        raise Error("frames need the Python package pandas (Debian: python3-pandas)") from None
    return pandas


def _rows(found: list[dict[str, Any]]) -> Measures:
    rows = []
    for one in found:
        values = {v["name"]: Measure(v["name"], float("nan") if v["value"] is None else v["value"], v["unit"], v["n"],
                                     v["valid_share"], v["reason"], v["options"]) for v in one["values"]}
        rows.append(Row(one["file"], one["participant"], one["condition"], one["run"], one["interval"],
                        one["from_s"], one["to_s"], values))
    return Measures(rows)


def _texts(given: str | Iterable[str]) -> list[str]:
    return [given] if isinstance(given, str) else list(given)


def measures(source: Any, measures: str | Iterable[str] = (), *, intervals: str | Iterable[str] = (),
             baseline: str = "", subject: str = "", options: Mapping[str, Mapping[str, float]] | None = None,
             spec: str | os.PathLike[str] = "", columns: Columns | None = None, rate_hz: float | None = None,
             time: str = "time_s", events: Iterable[tuple[float, str]] = (), marks: Iterable[tuple[float, str]] = (),
             length_m: float = float("nan"), front_m: float = float("nan"),
             width_m: float = float("nan")) -> Measures:
    """Computes measures; without names all of them (`rodeira.measure_names()`). One name or interval may be a text.

    source: a recording, its path or several of either; or a table of another program: a pandas frame, or a mapping from
    names of columns to arrays.
    intervals, baseline, subject, spec: as the options of `rodeira measures`. options: by measure, its options.

    Of tables only: `columns` maps Rodeira's names (`rodeira.series_names()`) to those of the table, or to a pair of
    name and factor: {"speed_mps": ("v_kmh", 1 / 3.6)}; without it the table's columns have Rodeira's names. `time` is
    its column of seconds; the samples must have one period, or `rate_hz` is given, and values are interpolated.
    `events` and `marks`: pairs of seconds and name. length_m, front_m (from the reference point) and width_m of the
    vehicle. Missing values are nan. Raises Error.
    """
    native = extension("rodeira.measures")
    question = {"spec": os.fspath(spec), "intervals": _texts(intervals), "baseline": baseline, "subject": subject,
                "measures": _texts(measures), "options": {k: dict(v) for k, v in (options or {}).items()}}
    files = _files(source)
    if files is not None:
        if columns is not None or rate_hz is not None:
            raise Error("columns and rate_hz are for tables; a recording has its own")
        found, _ = native.measures_of_recordings(files, question)
        return _rows(found)
    given, rate = _columns_of(source, columns, time, rate_hz, native.columns())
    vehicle = {"length_m": length_m, "front_m": front_m, "width_m": width_m}
    happened = [(float(at), name, "", False) for at, name in events] + [(float(at), name, "", True)
                                                                        for at, name in marks]
    return _rows(native.measures_of_columns(given, rate, vehicle, sorted(happened), question))


def measure_names() -> dict[str, str]:
    """The measures: name and definition."""
    return dict(extension("rodeira.measure_names").catalogue())


def series_names() -> tuple[str, ...]:
    """The columns that measures are computed from."""
    return tuple(extension("rodeira.series_names").columns())


def series(recording: Recording | str | os.PathLike[str], subject: str = "") -> dict[str, np.ndarray]:
    """Lane, gaps, TTC and the like of one road user at 100 Hz, by column, as `rodeira measures --series`."""
    return dict(extension("rodeira.series").series(_file(recording), subject))


def _file(recording: Any) -> str:
    return recording.path if isinstance(recording, Recording) else os.fspath(recording)


def _files(source: Any) -> list[str] | None:
    """The paths of recordings; nothing for a table."""
    if isinstance(source, (str, os.PathLike, Recording)):
        return [_file(source)]
    if isinstance(source, Mapping) or hasattr(source, "columns"):
        return None
    return [_file(one) for one in source]


def _columns_of(table: Any, columns: Columns | None, time: str, rate_hz: float | None,
                known: list[str]) -> tuple[dict[str, np.ndarray], float]:
    names = list(table.keys())
    if columns is None:
        columns = {name: name for name in names if name in known}
        if not columns and "dhw" in names:
            raise Error("the table has columns of highD; rodeira.measures(rodeira.highd(table, vehicle)[0]) was "
                        "expected")
        if not columns:
            raise Error(f"no column has a name of Rodeira ({', '.join(known[:5])} …); columns={{…}} was expected")

    def column(name: str) -> np.ndarray:
        if name not in names:
            raise Error(f"the table has no column '{name}'{did_you_mean(name, map(str, names))}")
        return np.asarray(table[name], dtype=np.float64)

    given = {}
    for own, theirs in columns.items():
        name, factor = (theirs, 1.0) if isinstance(theirs, str) else theirs
        given[own] = column(name) * factor
    return _on_one_period(given, column(time), rate_hz)


def _on_one_period(given: dict[str, np.ndarray], time_s: np.ndarray,
                   rate_hz: float | None) -> tuple[dict[str, np.ndarray], float]:
    """The columns at a uniform rate from the first sample on."""
    periods = np.diff(time_s)
    if len(time_s) < 2 or not (periods > 0.0).all():
        raise Error("the time of a table must grow from sample to sample, and have two samples at least")
    if rate_hz is None:
        period = float(np.median(periods))
        worst = float(np.max(np.abs(periods - period)))
        if worst > _UNEVEN * period:
            raise Error(f"the samples are {periods.min():.6g} to {periods.max():.6g} s apart; one period was expected, "
                        "or rate_hz=…, at which the values are interpolated")
        return given, float((len(time_s) - 1) / (time_s[-1] - time_s[0]))
    even = time_s[0] + np.arange(int((time_s[-1] - time_s[0]) * rate_hz + 1e-6) + 1) / rate_hz
    return {name: np.interp(even, time_s, values) for name, values in given.items()}, rate_hz
