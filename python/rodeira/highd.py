# SPDX-License-Identifier: Apache-2.0
"""Vehicles of the data set highD (www.highd-dataset.com/format), with the names, signs and gaps that measures want."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from .errors import Error, did_you_mean

_NEEDED = ("frame", "id", "x", "y", "width", "height", "xVelocity", "yVelocity", "dhw", "precedingXVelocity",
           "precedingId")
_SIDES = ("left", "right")  # of the driver, also in highD


def highd(tracks: Any, vehicle: int | None = None, *, rate_hz: float = 25.0,
          markings: str | Sequence[float] = ()) -> tuple[dict[str, np.ndarray], dict[str, float]]:
    """The columns of one vehicle for `rodeira.measures`, and its size: `rodeira.measures(columns, ["minTTC"], **size)`.

    tracks: highD's `XX_tracks.csv` as a pandas frame, or as a mapping from names to arrays. With several vehicles,
    `vehicle` is the id of the one that is wanted; gaps to followers and to neighbours need the others' rows. rate_hz:
    `frameRate` of `XX_recordingMeta.csv`. markings: y of the lane markings of the vehicle's carriageway
    (`upperLaneMarkings` or `lowerLaneMarkings`); without them there is no position in the lane.

    Image coordinates become x_m to the right and y_m upward; speeds are along the driving direction. `dhw` is the gap
    from bumper to bumper. Where highD says 0 for a vehicle that is not there, the value is nan. Raises Error.
    """
    table = _columns(tracks)
    ids = np.unique(table["id"])
    if vehicle is None:
        if len(ids) != 1:
            raise Error(f"the table has {len(ids)} vehicles; vehicle=… was expected, one of their ids")
        vehicle = int(ids[0])
    own = _rows(table, vehicle)
    if not len(own["frame"]):
        raise Error(f"the table has no vehicle {vehicle}; its ids go from {ids.min():g} to {ids.max():g}")
    direction = float(np.sign(own["xVelocity"].sum()))  # 1 to the right of the image, -1 to its left
    if direction == 0.0:
        raise Error(f"vehicle {vehicle} does not move, so that its driving direction is not known")
    columns = _motion(own, direction, rate_hz)
    columns |= _lane(own, direction, markings)
    leads = own["precedingId"] != 0.0
    columns["leader_id"] = np.where(leads, own["precedingId"], np.nan)
    columns["leader_gap_m"] = np.where(leads, own["dhw"], np.nan)
    columns["leader_speed_mps"] = np.where(leads, direction * own["precedingXVelocity"], np.nan)
    columns["leader_length_m"] = _others(table, own, own["precedingId"])["width"]
    columns |= _neighbours(table, own, direction)
    length, width = float(np.median(own["width"])), float(np.median(own["height"]))
    return columns, {"length_m": length, "front_m": 0.5 * length, "width_m": width}


def _columns(tracks: Any) -> dict[str, np.ndarray]:
    names = [str(name) for name in tracks.keys()]
    for name in _NEEDED:
        if name not in names:
            raise Error(f"the table has no column '{name}' of highD{did_you_mean(name, names)}")
    return {name: np.asarray(tracks[name], dtype=np.float64) for name in names
            if name in _NEEDED or name.endswith("Id")}


def _rows(table: Mapping[str, np.ndarray], vehicle: float) -> dict[str, np.ndarray]:
    chosen = np.flatnonzero(table["id"] == vehicle)
    chosen = chosen[np.argsort(table["frame"][chosen], kind="stable")]
    return {name: values[chosen] for name, values in table.items()}


def _motion(own: Mapping[str, np.ndarray], direction: float, rate_hz: float) -> dict[str, np.ndarray]:
    return {"time_s": (own["frame"] - own["frame"][0]) / rate_hz,
            "x_m": own["x"] + 0.5 * own["width"], "y_m": -(own["y"] + 0.5 * own["height"]),
            "heading_rad": np.arctan2(-own["yVelocity"], own["xVelocity"]),
            "heading_error_rad": np.arctan2(-direction * own["yVelocity"], direction * own["xVelocity"]),
            "speed_mps": direction * own["xVelocity"], "road": np.zeros(len(own["frame"]))}


def _lane(own: Mapping[str, np.ndarray], direction: float, markings: str | Sequence[float]) -> dict[str, np.ndarray]:
    lines = np.sort(np.array(markings.split(";") if isinstance(markings, str) else markings, dtype=np.float64))
    if len(lines) < 2:
        return {"lane": own["laneId"]} if "laneId" in own else {}
    middle = own["y"] + 0.5 * own["height"]
    lane = np.searchsorted(lines, middle, side="right")
    on_lane = (lane > 0) & (lane < len(lines))
    low, high = lines[np.clip(lane - 1, 0, len(lines) - 2)], lines[np.clip(lane, 1, len(lines) - 1)]

    def where_on_lane(values: np.ndarray) -> np.ndarray:
        return np.where(on_lane, values, np.nan)

    # The image's y points down: to the driver's right where x grows.
    return {"lane": where_on_lane(lane), "lane_width_m": where_on_lane(high - low),
            "lane_position_m": where_on_lane(-direction * (middle - 0.5 * (low + high))),
            "lane_curvature_1pm": where_on_lane(np.zeros(len(lane)))}


def _others(table: Mapping[str, np.ndarray], own: Mapping[str, np.ndarray],
            ids: np.ndarray) -> dict[str, np.ndarray]:
    """Box and speed of another vehicle in each frame of the own one; nan where it is not in the table, or has id 0."""
    found = {name: np.full(len(ids), np.nan) for name in ("x", "width", "xVelocity")}
    for other in np.unique(ids[ids != 0.0]):
        rows = _rows(table, other)
        if not len(rows["frame"]):
            continue
        at = np.clip(np.searchsorted(rows["frame"], own["frame"]), 0, len(rows["frame"]) - 1)
        there = (ids == other) & (rows["frame"][at] == own["frame"])
        for name, values in found.items():
            values[there] = rows[name][at[there]]
    return found


def _neighbours(table: Mapping[str, np.ndarray], own: Mapping[str, np.ndarray],
                direction: float) -> dict[str, np.ndarray]:
    columns: dict[str, np.ndarray] = {}
    middle = own["x"] + 0.5 * own["width"]

    def put(name: str, id_column: str) -> None:
        """Gap and speed of the vehicles of a column with ids; those beside are ahead or behind by their middles."""
        if id_column not in own:
            return
        ids = own[id_column]
        other = _others(table, own, ids)
        ahead = direction * (other["x"] + 0.5 * other["width"] - middle)
        gap = np.abs(ahead) - 0.5 * (own["width"] + other["width"])
        for part, chosen in (("leader", ahead > 0.0), ("follower", ahead <= 0.0)):
            for column, values in ((f"{name}{part}_gap_m", gap),
                                   (f"{name}{part}_speed_mps", direction * other["xVelocity"])):
                before = columns.get(column, np.full(len(ids), np.nan))
                columns[column] = np.where(chosen, values, before)

    put("", "followingId")
    for side in _SIDES:
        for part in ("Preceding", "Following", "Alongside"):  # a vehicle beside is nearer
            put(f"{side}_", f"{side}{part}Id")
    wanted = {"follower_gap_m", "follower_speed_mps"} | {
        f"{side}_{part}" for side in _SIDES for part in ("leader_gap_m", "follower_gap_m", "follower_speed_mps")}
    found = {name: values for name, values in columns.items() if name in wanted}
    if "followingId" in own:
        found["follower_id"] = np.where(own["followingId"] != 0.0, own["followingId"], np.nan)
    return found
