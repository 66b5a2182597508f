# SPDX-License-Identifier: Apache-2.0
"""Recordings of the driving simulator Rodeira as NumPy arrays.

    import rodeira
    drive = rodeira.open("drive.mcap")
    state = drive["vehicle_state"]
    print(state.time_s, state["velocity_w_mps.x"], drive.marks)

`rodeira.measures`, `rodeira.World`, `rodeira.run` and `rodeira.Env` need more than NumPy (docs/reference/python.md).
"""

from importlib.util import find_spec as _find_spec

if _find_spec("numpy") is None:
    raise ImportError("rodeira needs NumPy, which this Python does not have; Debian's package python3-numpy is for "
                      "/usr/bin/python3")

from .env import Box, Env
from .errors import Error, RecordingWarning
from .functions import Path, correct_changes, mean_deviation, pet, raff_gap, troutbeck_gap
from .highd import highd
from .mcap import Attachment
from .measured import Measure, Measures, Row, measure_names, measures, series, series_names
from .nodes import Ragged
from .recording import Event, Mark, Recording, Remark, open
from .running import run
from .samples import Samples
from .topic import Topic
from .world import Lane, Next, Place, World

__all__ = ["Attachment", "Box", "Env", "Error", "Event", "Lane", "Mark", "Measure", "Measures", "Next", "Path",
           "Place", "Ragged", "Recording", "RecordingWarning", "Remark", "Row", "Samples", "Topic", "World",
           "correct_changes", "highd", "mean_deviation", "measure_names", "measures", "open", "pet", "raff_gap", "run",
           "series", "series_names", "troutbeck_gap"]
