# SPDX-License-Identifier: Apache-2.0
"""An agent at the wheel: episodes of a launch file in the shape of Gymnasium's environments."""

from __future__ import annotations

import math
import numbers
import os
import struct
from collections.abc import Callable, Mapping, Sequence
from typing import Any, NamedTuple

import numpy as np

from .env_process import EnvProcess, Reader, Source, text
from .errors import Error, did_you_mean
from .samples import Samples, Topics, read_samples
from .running import override

_MAX_SEED = 2**63 - 1


class _Control(NamedTuple):
    low: float
    high: float
    default: float
    is_whole: bool


# The members of rodeira/controls, in the order of the wire.
_CONTROLS = {
    "steering_wheel_rad": _Control(-10 * math.pi, 10 * math.pi, 0.0, False),
    "throttle": _Control(0.0, 1.0, 0.0, False),
    "brake": _Control(0.0, 1.0, 0.0, False),
    "clutch": _Control(0.0, 1.0, 0.0, False),
    "handbrake": _Control(0.0, 1.0, 0.0, False),
    "gear": _Control(-1, 20, 1, True),
    "gearbox_mode": _Control(0, 1, 0, True),
    "starter": _Control(0, 1, 0, True),
    "indicators": _Control(0, 3, 0, True),
    "headlights": _Control(0, 2, 0, True),
    "horn": _Control(0, 1, 0, True),
}
_WIRE = struct.Struct("<5d i 5I")


class Box:
    """Bounds of an array, with the names of Gymnasium's `spaces.Box`."""

    def __init__(self, low: Sequence[float], high: Sequence[float]) -> None:
        self.low = np.asarray(low, dtype=np.float64)
        self.high = np.asarray(high, dtype=np.float64)
        self.shape = self.low.shape
        self.dtype = self.low.dtype
        self._random = np.random.default_rng(0)

    def seed(self, seed: int | None = None) -> None:
        """Begins the samples anew."""
        self._random = np.random.default_rng(seed)

    def sample(self) -> np.ndarray:
        """An array within the bounds, uniformly distributed."""
        return self._random.uniform(self.low, self.high)

    def contains(self, value: Any) -> bool:
        """Whether it is an array of this shape within the bounds."""
        found = np.asarray(value)
        return found.shape == self.shape and bool(np.all((found >= self.low) & (found <= self.high)))

    def __repr__(self) -> str:
        return f"Box({self.low}, {self.high}, {self.shape}, {self.dtype})"


class Env:
    """Episodes of a launch file in which `agent`, an input node, is driven from here.

    observation(now), reward(now, action) and terminated(now) take `Samples`. By default the observation is the samples
    themselves, the reward is 0, and no episode terminates. controls: what an action holds, members of
    `rodeira/controls`; the others keep their defaults. for_s: simulated seconds after which an episode is truncated;
    otherwise the launch file's `duration_s`. set: values of the launch file, as `--set`. timeout_s: wall time within
    which each answer must come. Raises Error.

    An action is decided on the observation at an activation of the node. It is in effect from the next activation on,
    or later with a larger delay in the launch file.
    """

    metadata: dict[str, Any] = {"render_modes": []}
    render_mode = None
    spec = None

    def __init__(self, launch: str | os.PathLike[str], agent: str = "driver", *,
                 observation: Callable[[Samples], Any] | None = None,
                 reward: Callable[[Samples, Any], float] | None = None,
                 terminated: Callable[[Samples], bool] | None = None,
                 controls: Sequence[str] = ("steering_wheel_rad", "throttle", "brake"),
                 observation_space: Any = None, for_s: float | None = None,
                 set: Mapping[str, object] | None = None,  # noqa: A002
                 timeout_s: float = 60.0) -> None:
        self._controls = _known_controls(controls)
        self._observation = observation or (lambda now: now)
        self._reward = reward or (lambda now, action: 0.0)
        self._terminated = terminated or (lambda now: False)
        self.action_space = Box([_CONTROLS[name].low for name in controls],
                                [_CONTROLS[name].high for name in controls])
        self.observation_space = observation_space
        words = [os.fspath(launch), "--agent", agent]
        for key, value in (set or {}).items():
            words += ["--set", override(key, value)]
        self._process = EnvProcess(words, timeout_s)
        reader = Reader(self._process.hello)
        self.launch = reader.text()
        base_step_ns, period, self._seed, duration_s, count = reader.numbers("qqQdI")
        sources = {reader.numbers("I")[0]: Source(reader.text(), reader.text(), reader.text(), reader.text())
                   for _ in range(count)}
        self._topics = Topics(sources)
        self._base_step_s = base_step_ns / 1e9
        self.step_s = period * self._base_step_s  # simulated seconds of a step
        self.for_s = for_s if for_s is not None else duration_s or None
        self._now: Samples | None = None
        self._ended = ""  # why no step may follow

    @property
    def now(self) -> Samples:
        """What is seen now, as the functions take it. Raises Error before a reset."""
        self._check_begun()
        assert self._now is not None
        return self._now

    @property
    def topics(self) -> tuple[str, ...]:
        """Names of what `Samples` hold."""
        return tuple(sorted(self._topics.numbers))

    @property
    def digest(self) -> str:
        """Digest of all samples of the episode so far, of all nodes. It is the same for the same seed and actions."""
        self._check_begun()
        return self._process.ask("D").decode()

    @property
    def unwrapped(self) -> "Env":
        return self

    def reset(self, seed: int | None = None, options: Mapping[str, Any] | None = None, *,
              record: str | os.PathLike[str] | None = None) -> tuple[Any, dict[str, Any]]:
        """Ends the episode and begins another one; gives its first observation and its facts.

        seed: of the launch file; without it that of the episode before, which then begins again. record, or "record"
        among the options: a new recording; it is whole after the next reset or close.
        """
        for key in options or {}:
            if key != "record":
                raise Error(f"unknown option '{key}'{did_you_mean(key, ['record'])}")
        record = record if record is not None else (options or {}).get("record")
        if seed is not None:
            self._seed = _whole(seed, "seed", 0, _MAX_SEED)
        self._now = None
        content = struct.pack("<BQ", 1, self._seed) + text(os.path.abspath(record) if record is not None else "")
        self._now = self._samples(self._process.ask("R", content, "O"))
        self._ended = ""
        return self._observation(self._now), self._info()

    def step(self, action: Any) -> tuple[Any, float, bool, bool, dict[str, Any]]:
        """One period of the node with this action: an array with a value for each of the controls, or a dict by name.
        Gives observation, reward, terminated, truncated and facts."""
        self._check_begun()
        if self._ended:
            raise Error(f"the episode has {self._ended}; reset() was expected")
        values = {name: control.default for name, control in _CONTROLS.items()} | self._values(action)
        wire = [int(value) if _CONTROLS[name].is_whole else value for name, value in values.items()]
        try:
            self._now = self._samples(self._process.ask("A", _WIRE.pack(*wire), "O"))
        except Error:
            self._now = None
            raise
        terminated = bool(self._terminated(self._now))
        truncated = self.for_s is not None and self._now.time_s > self.for_s - 0.5 * self._base_step_s
        self._ended = "terminated" if terminated else "been truncated" if truncated else ""
        return (self._observation(self._now), float(self._reward(self._now, action)), terminated, truncated,
                self._info())

    def close(self) -> None:
        """Ends the episode and the process behind the environment."""
        self._process.close()
        self._now = None

    def __enter__(self) -> "Env":
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    def _check_begun(self) -> None:
        if not self._process.is_open:
            raise Error("the environment is closed")
        if self._now is None:
            raise Error("there is no episode; reset() was expected")

    def _samples(self, content: bytes) -> Samples:
        return read_samples(self._topics, content, self._base_step_s)

    def _info(self) -> dict[str, Any]:
        assert self._now is not None
        return {"time_s": self._now.time_s, "step": self._now.step, "seed": self._seed}

    def _values(self, action: Any) -> dict[str, float]:
        """The controls that the action names, each within its bounds."""
        wanted = ", ".join(self._controls)
        if isinstance(action, Mapping):
            for name in action:
                if name not in self._controls:
                    raise Error(f"action: unknown control '{name}'{did_you_mean(str(name), self._controls)}")
            given = dict(action)
        else:
            try:
                array = np.asarray(action, dtype=np.float64)
            except (TypeError, ValueError):
                raise Error(f"action: {action!r} was found; numbers were expected: {wanted}") from None
            if array.shape != self.action_space.shape:
                raise Error(f"action: an array of shape {array.shape} was found; {self.action_space.shape} was "
                            f"expected: {wanted}")
            given = dict(zip(self._controls, array.tolist()))
        for name, value in given.items():
            control = _CONTROLS[name]
            kind = "a whole number" if control.is_whole else "a number"
            number = float(value) if isinstance(value, (numbers.Real, np.bool_)) else math.nan
            if not control.low <= number <= control.high or (control.is_whole and number != math.floor(number)):
                raise Error(f"action: {name} is {value!r}; {kind} from {control.low:g} to {control.high:g} was "
                            "expected")
        return {name: float(value) for name, value in given.items()}


def _known_controls(controls: Sequence[str]) -> tuple[str, ...]:
    if isinstance(controls, str) or not controls:
        raise Error(f"controls: {controls!r} was found; a list of names was expected")
    for name in controls:
        if name not in _CONTROLS:
            raise Error(f"controls: unknown control '{name}'{did_you_mean(str(name), _CONTROLS)}")
    if len(frozenset(controls)) < len(controls):
        raise Error("controls: a name stands twice")
    return tuple(controls)


def _whole(value: Any, name: str, low: int, high: int) -> int:
    if isinstance(value, bool) or not isinstance(value, numbers.Integral) or not low <= int(value) <= high:
        raise Error(f"{name} is {value!r}; a whole number from {low} to {high} was expected")
    return int(value)
