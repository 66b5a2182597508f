# SPDX-License-Identifier: Apache-2.0
"""What an agent sees of a run at one instant."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from .env_process import Reader, Source
from .errors import Error, did_you_mean
from .idl import find_type
from .layout import Layouts
from .sample_decoder import SampleDecoder


class Topics:
    """The streams of a run, by name, with their decoders."""

    def __init__(self, sources: dict[int, Source]) -> None:
        self._decoders: dict[int, SampleDecoder] = {}
        self._sources = sources
        self._layouts = Layouts()
        self.numbers: dict[str, int] = {}  # 'ego.vehicle_state' and, where there is one of a topic, 'vehicle_state'
        names: dict[str, list[int]] = {}
        for number, source in sources.items():
            short = source.topic.removeprefix("rodeira/")
            names.setdefault(short, []).append(number)
            self.numbers[f"{source.node}.{short}"] = number
        self.numbers.update((short, found[0]) for short, found in names.items() if len(found) == 1)

    def number(self, name: str) -> int:
        found = self.numbers.get(name.replace("rodeira/", ""))
        if found is None:
            raise Error(f"unknown topic '{name}'{did_you_mean(name, self.numbers)}")
        return found

    def decode(self, number: int, payload: bytes) -> Any:
        if number not in self._decoders:
            source = self._sources[number]
            kind = find_type(source.idl, source.type, source.topic)
            self._decoders[number] = SampleDecoder(kind, self._layouts)
        return self._decoders[number].decode(payload)


class Samples:
    """`now["vehicle_state"]` is the newest sample of a topic: a record, or a dict by member for a type with texts or
    sequences. With several nodes that publish it, the name is `"ego.vehicle_state"`."""

    def __init__(self, topics: Topics, step: int, time_s: float, payloads: dict[int, list[bytes]]) -> None:
        self.step = step      # base steps since the start
        self.time_s = time_s  # simulated
        self._topics = topics
        self._payloads = payloads
        self._decoded: dict[str, list[Any]] = {}

    @property
    def topics(self) -> tuple[str, ...]:
        """Names of what is seen."""
        return tuple(sorted(name for name, number in self._topics.numbers.items() if number in self._payloads))

    def __contains__(self, name: object) -> bool:
        return name in self.topics

    def __getitem__(self, name: str) -> Any:
        return self.all(name)[-1]

    def all(self, name: str) -> Sequence[Any]:
        """Of collisions and scenario events all samples since the last step, by time; of other topics the newest."""
        if name not in self._decoded:
            number = self._topics.number(name)
            self._decoded[name] = [self._topics.decode(number, one) for one in self._payloads.get(number, [])]
        return self._decoded[name]

    def payload(self, name: str) -> bytes:
        """The newest sample's CDR bytes."""
        return self._payloads[self._topics.number(name)][-1]

    def __repr__(self) -> str:
        return f"<rodeira.Samples at {self.time_s:.3f} s: {', '.join(self.topics)}>"


def read_samples(topics: Topics, content: bytes, base_step_s: float) -> Samples:
    """The observation that `rodeira env` has sent."""
    reader = Reader(content)
    step, count = reader.numbers("qI")
    payloads: dict[int, list[bytes]] = {}
    for _ in range(count):
        number, size = reader.numbers("II")
        payloads.setdefault(number, []).append(reader.raw(size))
    return Samples(topics, step, step * base_step_s, payloads)
