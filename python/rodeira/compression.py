# SPDX-License-Identifier: Apache-2.0
"""Decompression of chunks and attachments: zstd and lz4."""

from __future__ import annotations

import ctypes
import ctypes.util
import threading
from typing import Any

import numpy as np

from .errors import Error

try:
    import lz4.frame as _lz4
except ImportError:
    _lz4 = None

MAX_BYTES = 1 << 30  # no chunk or attachment that claims more is decompressed
_local = threading.local()


def _find_libzstd() -> Any:
    try:
        library = ctypes.CDLL(ctypes.util.find_library("zstd") or "libzstd.so.1")
        library.ZSTD_decompress.restype = ctypes.c_size_t
        library.ZSTD_decompress.argtypes = [ctypes.c_void_p, ctypes.c_size_t, ctypes.c_void_p, ctypes.c_size_t]
        return library
    except (OSError, AttributeError):
        return None


def _find_zstandard() -> Any:
    try:
        import zstandard
        return zstandard
    except ImportError:
        return None


_libzstd = _find_libzstd()
_zstandard = _find_zstandard()


def _address(array: np.ndarray) -> int:
    return int(array.__array_interface__["data"][0])


def _by_libzstd(data: bytes | memoryview, size: int) -> memoryview:
    """Into the thread's own buffer, which the next call overwrites."""
    if not hasattr(_local, "room") or len(_local.room) < size:
        _local.room = np.empty(max(size, 1 << 20), dtype=np.uint8)
    stored = np.frombuffer(data, dtype=np.uint8)
    room = _local.room
    if _libzstd.ZSTD_decompress(_address(room), size, _address(stored), len(stored)) != size:
        raise Error("the zstd data is damaged")
    return memoryview(room)[:size]


def _by_zstandard(data: bytes | memoryview, size: int) -> bytes:
    if not hasattr(_local, "zstd"):
        _local.zstd = _zstandard.ZstdDecompressor()  # one a thread
    try:
        return bytes(_local.zstd.decompress(data, max_output_size=size))
    except _zstandard.ZstdError as problem:
        raise Error(f"the zstd data is damaged: {problem}") from None


def _zstd(data: bytes | memoryview, size: int) -> bytes | memoryview:
    if size == 0:
        return b""
    if _libzstd is not None:
        return _by_libzstd(data, size)
    if _zstandard is not None:
        return _by_zstandard(data, size)
    raise Error("the data is compressed with zstd; the library libzstd or the Python package zstandard was expected "
                "(Debian: python3-zstandard)")


def _lz4_frame(data: bytes | memoryview) -> bytes:
    if _lz4 is None:
        raise Error("the data is compressed with lz4; the Python package lz4 was expected (Debian: python3-lz4)")
    try:
        return bytes(_lz4.decompress(bytes(data)))
    except (RuntimeError, MemoryError) as problem:
        raise Error(f"the lz4 data is damaged: {problem}") from None


def decompress(kind: str, data: bytes | memoryview, size: int) -> bytes | memoryview:
    """The `size` bytes of `data`; `kind` is '', 'zstd' or 'lz4', as in a chunk of MCAP. Raises Error.

    They are valid until the thread's next call.
    """
    if size > MAX_BYTES:
        raise Error(f"{size} uncompressed bytes are named; at most {MAX_BYTES} were expected")
    if kind == "":
        out: bytes | memoryview = data
    elif kind == "zstd":
        out = _zstd(data, size)
    elif kind == "lz4":
        out = _lz4_frame(data)
    else:
        raise Error(f"the compression is '{kind}'; '', 'zstd' or 'lz4' was expected")
    if len(out) != size:
        raise Error(f"{len(out)} bytes were found; {size} were expected")
    return out
