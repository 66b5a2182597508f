# SPDX-License-Identifier: Apache-2.0
"""What a type of an IDL text is: numbers, texts, arrays, sequences and structures."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import ClassVar

MAX_DEPTH = 64


@dataclass(frozen=True)
class Plain:
    """A number, a truth value or an enumeration; `code` is NumPy's type without byte order."""
    code: str
    size: int
    enumerators: tuple[str, ...] = ()
    name: str = ""
    depth: ClassVar[int] = 0    # how deep structures, arrays and sequences are nested
    columns: ClassVar[int] = 1  # values that make columns of their own


@dataclass(frozen=True)
class Text:
    """A string; `bound` is the most bytes, 0 without a limit."""
    bound: int = 0
    depth: ClassVar[int] = 0
    columns: ClassVar[int] = 1


@dataclass(frozen=True)
class Array:
    element: "Type"
    length: int
    depth: int = field(init=False, repr=False, compare=False)
    columns: int = field(init=False, repr=False, compare=False)

    def __post_init__(self) -> None:
        object.__setattr__(self, "depth", 1 + self.element.depth)
        object.__setattr__(self, "columns", self.element.columns * (
            1 if isinstance(self.element, Plain) else self.length))


@dataclass(frozen=True)
class Sequence:
    element: "Type"
    bound: int = 0
    depth: int = field(init=False, repr=False, compare=False)
    columns: int = field(init=False, repr=False, compare=False)

    def __post_init__(self) -> None:
        object.__setattr__(self, "depth", 1 + self.element.depth)
        object.__setattr__(self, "columns", self.element.columns)


@dataclass(frozen=True)
class Member:
    name: str
    type: "Type"
    unit: str = ""


@dataclass(frozen=True)
class Struct:
    name: str
    members: tuple[Member, ...]
    depth: int = field(init=False, repr=False, compare=False)
    columns: int = field(init=False, repr=False, compare=False)

    def __post_init__(self) -> None:
        object.__setattr__(self, "depth", 1 + max(member.type.depth for member in self.members))
        object.__setattr__(self, "columns", sum(member.type.columns for member in self.members))


Type = Plain | Text | Array | Sequence | Struct

OCTET = Plain("u1", 1, name="octet")
