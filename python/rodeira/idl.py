# SPDX-License-Identifier: Apache-2.0
"""The types that an OMG IDL text defines: the parts of IDL that docs/reference/recordings.md lists."""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping
from typing import TypeVar

from .errors import Error, did_you_mean
from .idl_types import MAX_DEPTH, OCTET, Array, Member, Plain, Sequence, Struct, Text, Type

_Known = TypeVar("_Known")

_PLAIN = {"boolean": "b1", "char": "u1", "octet": "u1", "short": "i2", "float": "f4", "double": "f8", "int8": "i1",
          "uint8": "u1", "int16": "i2", "uint16": "u2", "int32": "i4", "uint32": "u4", "int64": "i8", "uint64": "u8"}
_NOT_READ = {"union", "map", "bitmask", "bitset", "interface", "valuetype", "wstring", "wchar", "fixed", "any",
             "Object", "native", "exception", "switch", "typeid", "import"}
_OTHER_ENCODING = {"mutable", "optional", "value", "bit_bound"}
_TOKEN = re.compile(r"(?P<space>\s+|//[^\n]*|/\*.*?\*/)|(?P<name>[A-Za-z_]\w*)|(?P<number>\d[\w.]*)"
                    r"|(?P<text>\"(?:\\.|[^\"\\\n])*\"|'(?:\\.|[^'\\\n])*')|(?P<sign>::|[{}\[\]()<>;,:=@+\-|&^~*/%])",
                    re.DOTALL | re.ASCII)


def read_types(text: str, place: str) -> dict[str, Type]:
    """All types of the text by full name ('module::Type'). Raises Error, 'PLACE:LINE: …'."""
    return _Parser(text, place).run()


def find_type(text: str, name: str, place: str) -> Struct:
    """The structure of that full name. Raises Error with the nearest name."""
    types = read_types(text, place)
    found = types.get(name)
    if found is None:
        raise Error(f"{place}: the type '{name}' is not defined in the IDL text{did_you_mean(name, types)}")
    if not isinstance(found, Struct):
        raise Error(f"{place}: '{name}' is not a structure")
    return found


class _Parser:
    """Recursive descent over the tokens (kind, text, line)."""

    def __init__(self, text: str, place: str) -> None:
        self.place = place
        self.tokens: list[tuple[str, str, int]] = []
        self.at = 0
        self.scope: list[str] = []
        self.types: dict[str, Type] = {}
        self.constants: dict[str, int] = {}
        self.unit = ""
        at = 0
        line = 1
        while at < len(text):
            match = _TOKEN.match(text, at)
            if match is None:
                what = "a preprocessor line was found; the text must be complete in itself" if text[at] == "#" else (
                    f"the character '{text[at]}' has no meaning here")
                raise Error(f"{place}:{line}: {what}")
            if match.lastgroup != "space":
                self.tokens.append((match.lastgroup or "", match.group(), line))
            line += match.group().count("\n")
            at = match.end()
        self.tokens.append(("end", "the end of the text", line))

    def run(self) -> dict[str, Type]:
        while self.tokens[self.at][0] != "end":
            self._definition()
        return self.types

    # Tokens.
    def _refuse(self, what: str) -> Error:
        return Error(f"{self.place}:{self.tokens[self.at][2]}: {what}")

    def _expected(self, what: str) -> Error:
        kind, text, _ = self.tokens[self.at]
        if kind == "name" and text in _NOT_READ:
            return self._refuse(f"'{text}' is not read")
        return self._refuse(f"'{text}' was found; {what} was expected")

    def _is(self, text: str) -> bool:
        kind, found, _ = self.tokens[self.at]
        return kind in ("name", "sign") and found == text

    def _skip(self) -> str:
        text = self.tokens[self.at][1]
        self.at = min(self.at + 1, len(self.tokens) - 1)
        return text

    def _take(self, text: str) -> bool:
        found = self._is(text)
        if found:
            self._skip()
        return found

    def _sign(self, text: str) -> None:
        if not self._take(text):
            raise self._expected(f"'{text}'")

    def _name(self) -> str:
        if self.tokens[self.at][0] != "name":
            raise self._expected("a name")
        return self._skip()

    def _scoped_name(self) -> str:
        name = "::" if self._take("::") else ""
        name += self._name()
        while self._take("::"):
            name += "::" + self._name()
        return name

    # Names: from the innermost module outwards.
    def _lookup(self, known: Mapping[str, _Known], name: str) -> _Known | None:
        if name.startswith("::"):
            return known.get(name[2:])
        for count in range(len(self.scope), -1, -1):
            found = known.get("::".join([*self.scope[:count], name]))
            if found is not None:
                return found
        return None

    def _define(self, name: str, kind: Type) -> None:
        full = "::".join([*self.scope, name])
        if full in self.types:
            raise self._refuse(f"'{full}' is defined twice")
        if kind.depth > MAX_DEPTH:
            raise self._refuse(f"'{name}' is nested more than {MAX_DEPTH} deep")
        self.types[full] = kind

    # Definitions.
    def _definition(self) -> None:
        self._annotations()
        if self._take(";"):
            return
        for word, read in (("module", self._module), ("struct", self._struct), ("enum", self._enum),
                           ("typedef", self._typedef), ("const", self._const)):
            if self._take(word):
                read()
                return
        raise self._expected("module, struct, enum, typedef or const")

    def _module(self) -> None:
        if len(self.scope) >= MAX_DEPTH:
            raise self._refuse(f"modules are nested more than {MAX_DEPTH} deep")
        self.scope.append(self._name())
        self._sign("{")
        while not self._take("}"):
            self._definition()
        self.scope.pop()

    def _struct(self) -> None:
        name = self._name()
        if self._is(":"):
            raise self._refuse("structures that inherit are not read")
        if self._is(";"):
            raise self._refuse("forward declarations are not read")
        self._sign("{")
        members: dict[str, Member] = {}

        def add(member: str, kind: Type) -> None:
            if member in members:
                raise self._refuse(f"the member '{member}' is there twice")
            members[member] = Member(member, kind, self.unit)

        while not self._take("}"):
            self._annotations()
            self._declarators(add)
        if not members:
            raise self._refuse(f"the structure '{name}' has no members")
        self._define(name, Struct("::".join([*self.scope, name]), tuple(members.values())))

    def _enum(self) -> None:
        name = self._name()
        self._sign("{")
        names: list[str] = []
        while not names or self._take(","):
            self._annotations()
            names.append(self._name())
        self._sign("}")
        self._define(name, Plain("u4", 4, tuple(names), "::".join([*self.scope, name])))

    def _typedef(self) -> None:
        self._declarators(self._define)

    def _const(self) -> None:
        self._type(0)
        name = self._name()
        self._sign("=")
        kind, text, _ = self.tokens[self.at]
        while not self._take(";"):
            if self.tokens[self.at][0] == "end" or self._is("{") or self._is("}"):
                raise self._expected("';'")
            self._skip()
        if kind == "number" and re.fullmatch(r"0|[1-9]\d*", text):
            self.constants["::".join([*self.scope, name])] = int(text)

    def _declarators(self, use: Callable[[str, Type], None]) -> None:
        base = self._type(0)
        while True:
            name = self._name()
            lengths = []
            while self._take("["):
                lengths.append(self._length())
                self._sign("]")
            kind = base
            for length in reversed(lengths):
                kind = Array(kind, length)
            if kind.depth > MAX_DEPTH:
                raise self._refuse(f"'{name}' is nested more than {MAX_DEPTH} deep")
            use(name, kind)
            if not self._take(","):
                self._sign(";")
                return

    # Types.
    def _type(self, depth: int) -> Type:
        if depth > MAX_DEPTH:
            raise self._refuse(f"sequences are nested more than {MAX_DEPTH} deep")
        kind, text, _ = self.tokens[self.at]
        if kind == "name" and text in _NOT_READ:
            raise self._refuse(f"'{text}' is not read")
        if self._is("unsigned") or self._is("long"):
            return self._long()
        if self._take("sequence"):
            self._sign("<")
            element = self._type(depth + 1)
            bound = self._length() if self._take(",") else 0
            self._sign(">")
            return Sequence(element, bound)
        if self._take("string"):
            bound = 0
            if self._take("<"):
                bound = self._length()
                self._sign(">")
            return Text(bound)
        if kind == "name" and text in _PLAIN:
            self._skip()
            return OCTET if text == "octet" else Plain(_PLAIN[text], int(_PLAIN[text][1]))
        if kind != "name" and not self._is("::"):
            raise self._expected("a type")
        name = self._scoped_name()
        found = self._lookup(self.types, name)
        if found is None:
            raise self._refuse(f"the type '{name}' is not defined before this line{did_you_mean(name, self.types)}")
        return found

    def _long(self) -> Plain:
        code = "u" if self._take("unsigned") else "i"
        if self._take("short"):
            return Plain(code + "2", 2)
        if not self._take("long"):
            raise self._expected("'short' or 'long'")
        if self._is("double"):
            raise self._refuse("'long double' is not read")
        return Plain(code + "8", 8) if self._take("long") else Plain(code + "4", 4)

    def _length(self) -> int:
        if self.tokens[self.at][0] == "number":
            text = self._skip()
            length: int | None = int(text) if re.fullmatch(r"0|[1-9]\d*", text) else None
        else:
            text = self._scoped_name()
            length = self._lookup(self.constants, text)
        if length is None:
            raise self._refuse(f"'{text}' is not a whole number that is defined before this line")
        if not 1 <= length <= 1 << 32:
            raise self._refuse(f"a length of {length} was found; 1 to {1 << 32} was expected")
        return length

    # Annotations that leave the encoding as it is are ignored, except for the unit.
    def _annotations(self) -> None:
        self.unit = ""
        while self._take("@"):
            name = self.tokens[self.at][1]
            if name in _OTHER_ENCODING:
                raise self._refuse(f"'@{name}' is not read: it makes another encoding")
            self._scoped_name()
            words = []
            if self._is("("):
                depth = 0
                while True:
                    if self.tokens[self.at][0] == "end":
                        raise self._expected("')'")
                    depth += self._is("(") - self._is(")")
                    words.append(self._skip())
                    if depth == 0:
                        break
            if name == "extensibility" and "MUTABLE" in words:
                raise self._refuse("'@extensibility(MUTABLE)' is not read: it makes another encoding")
            if name == "unit":
                self.unit = next((word[1:-1] for word in words if word[0] == '"'), "")
