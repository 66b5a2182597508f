# SPDX-License-Identifier: Apache-2.0
"""The process behind `rodeira.Env`, and the messages to and from it (launch/rodeira/env/env_command.hpp)."""

from __future__ import annotations

import os
import select
import struct
import subprocess
import time
import weakref
from collections.abc import Iterable
from typing import NamedTuple, NoReturn

from .errors import Error
from .running import program

_END_S = 10.0  # for what is still to be written when the environment is closed


class Source(NamedTuple):
    """A stream of samples: its node, its topic, its type's name and the IDL text that defines it."""
    node: str
    topic: str
    type: str
    idl: str


class Reader:
    """Reads numbers and texts of a message, one after the other."""

    def __init__(self, data: bytes) -> None:
        self._data = data
        self._at = 0

    def numbers(self, code: str) -> tuple:
        found = struct.unpack_from("<" + code, self._data, self._at)
        self._at += struct.calcsize("<" + code)
        return found

    def raw(self, size: int) -> bytes:
        self._at += size
        return self._data[self._at - size:self._at]

    def text(self) -> str:
        return self.raw(self.numbers("I")[0]).decode("utf-8", "backslashreplace")


def text(value: str) -> bytes:
    """A text as the process reads it."""
    data = os.fsencode(value)
    return struct.pack("<I", len(data)) + data


class EnvProcess:
    """`rodeira env`; every answer comes within `timeout_s`, or the process is ended and Error is raised."""

    def __init__(self, arguments: Iterable[str], timeout_s: float) -> None:
        self._timeout_s = timeout_s
        command = [program(), "env", *arguments]
        self._process = subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, bufsize=0,
                                         start_new_session=True)  # so that Ctrl-C in a terminal is Python's
        assert self._process.stdin is not None and self._process.stdout is not None
        self._to, self._from = self._process.stdin.fileno(), self._process.stdout.fileno()
        self._poll = select.poll()
        self._poll.register(self._from, select.POLLIN)
        self.close = weakref.finalize(self, _end, self._process)
        try:
            self.hello = self._answer("H")
        except BaseException:
            self.close()
            raise

    @property
    def is_open(self) -> bool:
        return self.close.alive

    def ask(self, kind: str, content: bytes = b"", answer: str = "") -> bytes:
        """Sends a request and gives the content of the answer. Raises Error with the process's sentence."""
        if not self.is_open:
            raise Error("the environment is closed")
        try:
            os.write(self._to, struct.pack("<Ic", len(content) + 1, kind.encode()) + content)
            return self._answer(answer or kind)
        except BrokenPipeError:
            self._gone()
        except Error:
            raise
        except BaseException:  # such as Ctrl-C: the answer would be taken for that of the next request
            self.close()
            raise

    def _answer(self, wanted: str) -> bytes:
        deadline = time.monotonic() + self._timeout_s
        size, kind = struct.unpack("<Ic", self._read(5, deadline))
        content = self._read(size - 1, deadline)
        if kind == b"E":
            reader = Reader(content)
            reader.numbers("I")
            name = reader.text()
            problem = Error(reader.text())
            problem.id = name
            raise problem
        if kind != wanted.encode():
            self.close()
            raise Error(f"{program()}: an answer '{kind.decode('latin-1')}' was found; '{wanted}' was expected; is the "
                        "program of another version than this package?")
        return content

    def _read(self, size: int, deadline: float) -> bytes:
        data = bytearray(size)
        left = memoryview(data)
        while left:
            wait_s = deadline - time.monotonic()
            if wait_s <= 0 or not self._poll.poll(1000 * wait_s):
                self._process.kill()
                self.close()
                raise Error(f"{program()} has not answered within {self._timeout_s:g} s; it was ended")
            got = os.readv(self._from, [left])
            if got == 0:
                self._gone()
            left = left[got:]
        return bytes(data)

    def _gone(self) -> NoReturn:
        self.close()
        raise Error(f"{program()} has ended with status {self._process.returncode}; what it said is on standard error")


def _end(process: subprocess.Popen) -> None:
    """Closes the pipes, at which the process ends itself."""
    for pipe in (process.stdin, process.stdout):
        if pipe is not None:
            pipe.close()
    try:
        process.wait(_END_S)
    except subprocess.TimeoutExpired:
        process.kill()
        process.wait()
