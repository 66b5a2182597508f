# SPDX-License-Identifier: Apache-2.0
"""A world's roads and lanes, by the code with which Rodeira drives."""

from __future__ import annotations

import os
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from .native import extension


class Lane(NamedTuple):
    """A lane of a road's section: the road's id, the section's number from 0, the lane's id (left of the reference line
    above 0)."""
    road: str
    section: int
    lane: int


class Place(NamedTuple):
    """Where a point lies. Offsets are positive to the left, seen along the road's stations."""
    lane: Lane
    s_m: float              # station
    t_m: float              # offset from the road's reference line
    z_m: float              # height of the surface
    distance_m: float       # from the nearest lane; 0: on it
    lane_width_m: float
    lane_position_m: float  # from the lane's middle
    heading_rad: float      # of the reference line, from east, counter-clockwise


class Next(NamedTuple):
    """A lane that follows, the station at which it is entered, and the distance to it along the stations."""
    lane: Lane
    s_m: float
    distance_m: float


class World:
    """A world file, an OpenDRIVE file (.xodr) or a traffic map (.motors) with roads. Raises Error."""

    def __init__(self, path: str | os.PathLike[str]) -> None:
        self.path = os.fspath(path)
        self._world = extension("rodeira.World").World(self.path)
        self._roads: list[str] = self._world.road_ids()

    @property
    def name(self) -> str:
        """The world's name."""
        return str(self._world.name)

    @property
    def content_hash(self) -> str:
        """The hash that a recording of a drive in this world names."""
        return str(self._world.content_hash)

    @property
    def lanes(self) -> list[Lane]:
        """All lanes but the centres, by road, section and id."""
        return [Lane(*lane) for lane in self._world.lanes()]

    def locate(self, x: float, y: float, z: float | None = None) -> Place | None:
        """The lane at a point on the level of z (without z: the top one), beside all roads the nearest; nothing where
        there is no road."""
        found = self.locate_all([x], [y], None if z is None else [z])
        road = int(found["road"][0])
        if road < 0:
            return None
        lane = Lane(self._roads[road], int(found["section"][0]), int(found["lane"][0]))
        return Place(lane, *(float(found[name][0]) for name in Place._fields[1:]))

    def locate_all(self, x: ArrayLike, y: ArrayLike, z: ArrayLike | None = None) -> dict[str, np.ndarray]:
        """The same of many points, as columns: `road` (index into `roads`, -1: none), `section`, `lane`, and the fields
        of Place."""
        xs = np.atleast_1d(np.asarray(x, dtype=np.float64))
        zs = np.full(len(xs), np.nan) if z is None else np.atleast_1d(np.asarray(z, dtype=np.float64))
        return dict(self._world.locate(xs, np.atleast_1d(np.asarray(y, dtype=np.float64)), zs))

    @property
    def roads(self) -> list[str]:
        """The ids of the roads."""
        return list(self._roads)

    def stations(self, lane: Lane) -> tuple[float, float]:
        """The stations at which the lane's section begins and ends."""
        begin, end = self._world.stations(tuple(lane))
        return float(begin), float(end)

    def next(self, lane: Lane, s: float | None = None) -> list[Next]:
        """The lanes that follow in the direction of the lane's traffic, and how far they are from station s (without s:
        from where the lane begins)."""
        begin, end = self.stations(lane)
        along = self._world.along(tuple(lane))
        at = s if s is not None else begin if along else end
        distance_m = max(0.0, end - at if along else at - begin)
        return [Next(Lane(*name), float(entered), distance_m) for name, entered in self._world.next(tuple(lane))]

    def polyline(self, lane: Lane, step_m: float = 2.0) -> np.ndarray:
        """The lane's middle along the stations: an array of (n, 3), in m."""
        return np.asarray(self._world.lines(tuple(lane), step_m)[1])

    def edges(self, lane: Lane, step_m: float = 2.0) -> tuple[np.ndarray, np.ndarray]:
        """The lane's left and right edge, seen along the stations."""
        right, _, left = self._world.lines(tuple(lane), step_m)
        return np.asarray(left), np.asarray(right)
