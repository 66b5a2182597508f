# SPDX-License-Identifier: Apache-2.0
"""Compressed data by each library that can read it, and sentences where none is there."""

import contextlib
import importlib.util
import unittest
import zlib
from unittest import mock

import handmade
import rodeira
from rodeira import checksum, compression

TEXT = b"the same words again and again, " * 400


def without(*names):
    """The package as it is where these libraries are not installed."""
    return mock.patch.multiple(compression, **dict.fromkeys(names)) if names else contextlib.nullcontext()


class Compression(unittest.TestCase):
    @unittest.skipUnless(importlib.util.find_spec("zstandard"), "the Python package zstandard is not installed")
    def test_zstd_by_either_library(self):
        stored = handmade.compressed("zstd", TEXT)
        self.assertLess(len(stored), len(TEXT) // 4)
        for names in ((), ("_libzstd",), ("_zstandard",)):
            with without(*names):
                self.assertEqual(bytes(compression.decompress("zstd", stored, len(TEXT))), TEXT)
                for data, size in ((stored[:-5], len(TEXT)), (b"no zstd", len(TEXT)), (stored, len(TEXT) + 1),
                                   (stored, len(TEXT) - 1), (stored, 1 << 40)):
                    with self.assertRaises(rodeira.Error):
                        compression.decompress("zstd", data, size)

    def test_a_missing_library_is_named_with_its_package(self):
        for kind, names, sentence in (("zstd", ("_libzstd", "_zstandard"), "Debian: python3-zstandard"),
                                      ("lz4", ("_lz4",), "Debian: python3-lz4")):
            with without(*names), self.assertRaisesRegex(rodeira.Error, sentence):
                compression.decompress(kind, b"anything", 10)

    def test_the_checksum_is_zlibs_with_libdeflate_and_without(self):
        self.assertEqual(zlib.crc32(b"123456789"), 0xCBF43926)  # the check value of CRC-32
        for library in {checksum._libdeflate, None}:
            with mock.patch.object(checksum, "_libdeflate", library):
                for data in (b"", b"1", b"123456789", TEXT, memoryview(TEXT)[3:]):
                    self.assertEqual(checksum.crc32(data), zlib.crc32(data))

    def test_no_compression_and_an_unknown_one(self):
        self.assertEqual(compression.decompress("", TEXT, len(TEXT)), TEXT)
        with self.assertRaisesRegex(rodeira.Error, "12800 bytes were found; 3 were expected"):
            compression.decompress("", TEXT, 3)
        with self.assertRaisesRegex(rodeira.Error, "the compression is 'brotli'; '', 'zstd' or 'lz4' was expected"):
            compression.decompress("brotli", TEXT, len(TEXT))


if __name__ == "__main__":
    unittest.main()
