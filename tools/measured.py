# SPDX-License-Identifier: Apache-2.0
"""What tools that measure share: the machine in words, and tables between two marks of a Markdown page."""

import os
import pathlib
import re
import subprocess


class Failure(Exception):
    """A sentence for the person at the keyboard."""


def machine():
    models = re.findall(r"^model name\s*: (.*)$", pathlib.Path("/proc/cpuinfo").read_text(), re.M)
    memory_kB = int(re.search(r"MemTotal:\s*(\d+)", pathlib.Path("/proc/meminfo").read_text())[1])
    return f"{os.cpu_count()} cores, {models[0] if models else 'unknown processor'}, {memory_kB / 2**20:.0f} GB"


def run(command, **options):
    if subprocess.run(command, **options).returncode != 0:
        raise Failure(f"failed: {' '.join(map(str, command))}")


def revision(root, name):
    """The short hash of a revision of the repository at `root`."""
    command = ["git", "-C", root, "rev-parse", "--short", name + "^{commit}"]
    sha = subprocess.run(command, capture_output=True, text=True)
    if sha.returncode != 0:
        raise Failure(f"{name}: no such revision")
    return sha.stdout.strip()


def write_between_marks(page, tool, text):
    """Replaces what stands between the lines `<!-- TOOL begins -->` and `<!-- TOOL ends -->` of `page` by `text`."""
    begin, end = f"<!-- {tool} begins -->\n", f"<!-- {tool} ends -->\n"
    whole = pathlib.Path(page).read_text()
    if whole.count(begin) != 1 or whole.count(end) != 1 or whole.index(begin) > whole.index(end):
        raise Failure(f"{page}: needs one line '{begin.strip()}' and below it one line '{end.strip()}'")
    before, rest = whole.split(begin)
    pathlib.Path(page).write_text(before + begin + "\n" + text + "\n" + end + rest.split(end)[1])
