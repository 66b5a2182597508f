# SPDX-License-Identifier: Apache-2.0
"""Decompression of chunks and attachments: zstd and lz4."""

from __future__ import annotations

import ctypes
import ctypes.util
import threading
from typing import Any

from .errors import Error

try:
    import zstandard as _zstandard
except ImportError:  # libzstd itself serves then
    _zstandard = None
try:
    import lz4.frame as _lz4
except ImportError:
    _lz4 = None

_local = threading.local()
MAX_BYTES = 1 << 30  # no chunk or attachment that claims more is decompressed


def _libzstd() -> Any:
    if not hasattr(_libzstd, "library"):
        name = ctypes.util.find_library("zstd") or "libzstd.so.1"
        library = ctypes.CDLL(name)
        library.ZSTD_decompress.restype = ctypes.c_size_t
        library.ZSTD_decompress.argtypes = [ctypes.c_void_p, ctypes.c_size_t, ctypes.c_char_p, ctypes.c_size_t]
        _libzstd.library = library  # type: ignore[attr-defined]
    return _libzstd.library  # type: ignore[attr-defined]


def _zstd(data: bytes | memoryview, size: int) -> bytes:
    if _zstandard is not None:
        if not hasattr(_local, "zstd"):
            _local.zstd = _zstandard.ZstdDecompressor()  # one a thread
        try:
            return bytes(_local.zstd.decompress(data, max_output_size=size))
        except _zstandard.ZstdError as problem:
            raise Error(f"the zstd data is damaged: {problem}") from None
    try:
        library = _libzstd()
    except OSError:
        raise Error("the data is compressed with zstd; the Python package zstandard was expected "
                    "(Debian: python3-zstandard)") from None
    out = ctypes.create_string_buffer(max(size, 1))
    if library.ZSTD_decompress(out, size, bytes(data), len(data)) != size:
        raise Error("the zstd data is damaged")
    return out.raw[:size]


def _lz4_frame(data: bytes | memoryview) -> bytes:
    if _lz4 is None:
        raise Error("the data is compressed with lz4; the Python package lz4 was expected (Debian: python3-lz4)")
    try:
        return bytes(_lz4.decompress(bytes(data)))
    except (RuntimeError, MemoryError) as problem:
        raise Error(f"the lz4 data is damaged: {problem}") from None


def decompress(kind: str, data: bytes | memoryview, size: int) -> bytes | memoryview:
    """The `size` bytes of `data`; `kind` is '', 'zstd' or 'lz4', as in a chunk of MCAP. Raises Error."""
    if size > MAX_BYTES:
        raise Error(f"{size} uncompressed bytes are named; at most {MAX_BYTES} were expected")
    if kind == "":
        out: bytes | memoryview = data
    elif kind == "zstd":
        out = _zstd(data, size) if size else b""
    elif kind == "lz4":
        out = _lz4_frame(data)
    else:
        raise Error(f"the compression is '{kind}'; '', 'zstd' or 'lz4' was expected")
    if len(out) != size:
        raise Error(f"{len(out)} bytes were found; {size} were expected")
    return out
