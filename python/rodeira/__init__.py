# SPDX-License-Identifier: Apache-2.0
"""Recordings of the driving simulator Rodeira as NumPy arrays.

    import rodeira
    drive = rodeira.open("drive.mcap")
    state = drive["vehicle_state"]
    print(state.time_s, state["velocity_w_mps.x"], drive.marks)

docs/how-to/export.md shows more.
"""

from .errors import Error, RecordingWarning
from .mcap import Attachment
from .nodes import Ragged
from .recording import Event, Mark, Recording, Remark, open
from .topic import Topic

__all__ = ["Attachment", "Error", "Event", "Mark", "Ragged", "Recording", "RecordingWarning", "Remark", "Topic", "open"]
