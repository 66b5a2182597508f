# SPDX-License-Identifier: Apache-2.0
"""Runs of Rodeira, started from Python."""

from __future__ import annotations

import os
import pathlib
import shutil
import subprocess
import tempfile
import weakref
from collections.abc import Mapping

from .errors import Error
from .recording import Recording

_BUILD = pathlib.Path(__file__).parents[2] / "build/bin/rodeira"


def program() -> str:
    """The program `rodeira`: what the environment's RODEIRA names, that of PATH, or that of the build beside this
    package. Raises Error."""
    named = os.environ.get("RODEIRA", "")
    found = shutil.which(named or "rodeira") or (str(_BUILD) if not named and _BUILD.is_file() else None)
    if found is None:
        raise Error(f"the program '{named or 'rodeira'}' is not found; the Debian package rodeira-headless has it, and "
                    "RODEIRA may name it")
    return found


def run(launch: str | os.PathLike[str], *, seed: int | None = None, for_s: float | None = None,
        set: Mapping[str, object] | None = None, meta: Mapping[str, object] | None = None,  # noqa: A002
        record: str | os.PathLike[str] | None = None, in_process: bool = False) -> Recording:
    """Runs a launch file, or one that is named ("demo"), as fast as it goes and without a window, and opens its
    recording.

    for_s: simulated seconds. set: values of the launch file, as `--set`; None takes a key out. meta: written into the
    recording. record: the new file; without it the recording is removed when it is no longer used. Raises Error with
    what Rodeira says if the run fails.
    """
    folder = None
    if record is None:
        folder = tempfile.mkdtemp(prefix="rodeira-")
        record = os.path.join(folder, "run.mcap")
    words = [program(), "run", os.fspath(launch), "--headless", "--quiet", "--record", os.fspath(record)]
    words += ["--in-process"] if in_process else []
    words += ["--seed", str(seed)] if seed is not None else []
    words += ["--for", repr(float(for_s))] if for_s is not None else []
    for option, pairs in (("--set", set), ("--meta", meta)):
        for key, value in (pairs or {}).items():
            words += [option, override(key, value)]
    done = subprocess.run(words, capture_output=True, text=True, errors="backslashreplace", check=False)
    if done.returncode != 0:
        if folder is not None:
            shutil.rmtree(folder, ignore_errors=True)
        said = (done.stderr or done.stdout).strip().splitlines()
        raise Error(said[-1] if said else f"rodeira run ended with status {done.returncode}")
    recording = Recording(record)
    if folder is not None:
        weakref.finalize(recording, shutil.rmtree, folder, True)
    return recording


def override(key: str, value: object) -> str:
    """KEY=VALUE as `--set` takes it; None takes the key out."""
    return f"{key}={_text(value)}"


def _text(value: object) -> str:
    if value is None:
        return "~"
    if isinstance(value, bool):
        return "true" if value else "false"
    return str(value)
