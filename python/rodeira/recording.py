# SPDX-License-Identifier: Apache-2.0
"""A recording: topics, events, marks, metadata and embedded files."""

from __future__ import annotations

import os
import warnings
from collections.abc import Iterator
from typing import NamedTuple

from . import aliases
from .columns import MAX_COLUMNS
from .errors import Error, RecordingWarning, did_you_mean
from .idl import find_type
from .mcap import Attachment, McapFile
from .mcap_records import Channel
from .topic import Topic


class Event(NamedTuple):
    """An event of the scenario."""
    time_s: float
    source: str
    name: str
    argument: str
    value: float


class Remark(NamedTuple):
    """An action of the operator or the clock, or a fault: start, end, mark, pause, resume, step, pace, stop, fault."""
    time_s: float
    step: int
    kind: str
    text: str
    utc_ns: int
    pace: float


class Mark(NamedTuple):
    """A mark of the operator ('clock' is the source) or of the scenario."""
    time_s: float
    text: str
    source: str


class Recording:
    """`recording["vehicle_state"]` is a topic; iterating gives the names of the topics."""

    def __init__(self, path: str | os.PathLike[str]) -> None:
        self._file = McapFile(path)
        self.path = self._file.path
        self._topics: dict[str, Topic] = {}
        self.left_out: dict[str, str] = {}
        self._find_topics()
        for sentence in (*self._file.damage, *self.left_out.values()):
            warnings.warn(sentence, RecordingWarning, stacklevel=3)

    def _find_topics(self) -> None:
        groups: dict[tuple[str, int], list[Channel]] = {}
        for _, channel in sorted(self._file.channels.items()):
            groups.setdefault((channel.topic, channel.schema), []).append(channel)
        for (topic, schema), channels in groups.items():
            full = aliases.TOPICS.get(topic, topic)
            short = full.removeprefix("rodeira/")
            name, number = short, 1
            while name in self._topics or name in self.left_out:
                number += 1
                name = f"{short}_{number}"
            try:
                self._topics[name] = self._topic(name, full, schema, channels)
            except Error as problem:
                self.left_out[name] = f"{self.path}: topic '{full}' is left out: {problem}"

    def _topic(self, name: str, full: str, schema_id: int, channels: list[Channel]) -> Topic:
        schema = self._file.schemas.get(schema_id)
        if schema is None:
            raise Error(f"its schema {schema_id} is not in the file")
        encodings = {channel.encoding for channel in channels}
        if schema.encoding != "omgidl" or encodings != {"cdr"}:
            raise Error(f"its messages are '{', '.join(sorted(encodings))}' with a schema in '{schema.encoding}'; "
                        "'cdr' with 'omgidl' was expected")
        kind = aliases.renamed(find_type(schema.text, schema.name, schema.name))
        if kind.columns > MAX_COLUMNS:
            raise Error(f"it has {kind.columns} columns; at most {MAX_COLUMNS} were expected")
        return Topic(self._file, name, full, kind, channels)  # type: ignore[arg-type]

    # Topics.
    @property
    def topics(self) -> tuple[str, ...]:
        """Names of the topics, 'vehicle_state' for 'rodeira/vehicle_state'."""
        return tuple(sorted(self._topics))

    def __iter__(self) -> Iterator[str]:
        return iter(self.topics)

    def __len__(self) -> int:
        return len(self._topics)

    def __contains__(self, name: object) -> bool:
        return isinstance(name, str) and name.removeprefix("rodeira/") in self._topics

    def __getitem__(self, name: str) -> Topic:
        short = name.removeprefix("rodeira/")
        if short in self._topics:
            return self._topics[short]
        if short in self.left_out:
            raise Error(self.left_out[short])
        raise Error(f"{self.path}: unknown topic '{name}'{did_you_mean(short, self._topics)}")

    def __repr__(self) -> str:
        return f"<rodeira.Recording '{self.path}': {len(self._topics)} topics>"

    # What was noted beside the samples.
    @property
    def damage(self) -> tuple[str, ...]:
        """What of the file cannot be read, as far as it has been read; empty for a whole file."""
        return tuple(self._file.damage)

    @property
    def metadata(self) -> dict[str, dict[str, str]]:
        """All metadata by name: 'rodeira', 'rodeira.end', …"""
        found: dict[str, dict[str, str]] = {}
        for name, entries in self._file.metadata:
            found.setdefault(name, {}).update(entries)
        return found

    @property
    def meta(self) -> dict[str, str]:
        """What `rodeira run --meta KEY=VALUE` was given: participant, condition …"""
        return self.metadata.get("rodeira.meta", {})

    @property
    def attachments(self) -> tuple[Attachment, ...]:
        """All attachments in the order of the file."""
        return tuple(self._file.attachments)

    @property
    def files(self) -> dict[str, bytes]:
        """The embedded files by name: 'launch.yaml', 'files/…'."""
        return {one.name: one.data() for one in self._file.attachments if one.name != "override"}

    @property
    def overrides(self) -> tuple[str, ...]:
        """Each `--set KEY=VALUE` of the run, in order."""
        return tuple(one.data().decode("utf-8", "backslashreplace") for one in self._file.attachments
                     if one.name == "override")

    @property
    def events(self) -> list[Event]:
        """The events of the scenario, by time."""
        if "scenario_events" not in self:
            return []
        table = self["scenario_events"].table()
        columns = ("time_s", "source", "events.name", "events.argument", "events.value")
        return [Event(*row) for row in zip(*(table[name].tolist() for name in columns))]

    @property
    def remarks(self) -> list[Remark]:
        """Start, end, marks, pauses and faults of the run, by time."""
        if "remarks" not in self:
            return []
        table = self["remarks"].table()
        columns = ("step", "kind", "text", "utc_ns", "pace")
        rows = zip((table["time_ns"] / 1e9).tolist(), *(table[name].tolist() for name in columns))
        return [Remark(*row) for row in rows]

    @property
    def marks(self) -> list[Mark]:
        """The marks that the operator set during the run, and those of the scenario, by time."""
        marks = [Mark(remark.time_s, remark.text, "clock") for remark in self.remarks if remark.kind == "mark"]
        marks += [Mark(event.time_s, event.argument, event.source) for event in self.events if event.name == "mark"]
        return sorted(marks, key=lambda mark: mark.time_s)


def open(path: str | os.PathLike[str]) -> Recording:  # noqa: A001
    """Opens a recording of Rodeira, or another MCAP file with CDR messages and OMG IDL schemas.

    Raises rodeira.Error if the file cannot be opened or is not MCAP. Damage, and topics that cannot be read, are
    warnings (rodeira.RecordingWarning); everything else is read.
    """
    return Recording(path)
