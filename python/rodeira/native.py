# SPDX-License-Identifier: Apache-2.0
"""The extension module `_rodeira`, which holds what calls C++. Reading recordings does without it."""

from __future__ import annotations

import importlib
from typing import Any

from .errors import Error


def extension(what: str) -> Any:
    """The module; Error where it is not installed. `what` needs it."""
    for name in ("rodeira._rodeira", "_rodeira"):  # of the package, or beside a build of Rodeira
        try:
            return importlib.import_module(name)
        except ModuleNotFoundError:
            continue
        except ImportError as problem:
            raise Error(f"{what} needs the extension module _rodeira, which cannot be loaded: {problem}") from None
    raise Error(f"{what} needs the extension module _rodeira; the Debian package python3-rodeira has it; in the source "
                "tree, `ninja -C build rodeira_python_extension` puts it into build/python (PYTHONPATH)")
