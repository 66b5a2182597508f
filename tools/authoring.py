# SPDX-License-Identifier: Apache-2.0
"""Random numbers and texts of numbers for the tools that write worlds."""


class Draw:
    """A small generator of its own (SplitMix64), so that the file never depends on a library's version."""

    def __init__(self, seed):
        self.state = seed

    def bits(self):
        self.state = (self.state + 0x9E3779B97F4A7C15) % 2**64
        z = self.state
        z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9 % 2**64
        z = (z ^ (z >> 27)) * 0x94D049BB133111EB % 2**64
        return z ^ (z >> 31)

    def uniform(self, low, high):
        return low + (high - low) * (self.bits() >> 11) / 2**53


def number(value):
    return f"{value:.3f}".rstrip("0").rstrip(".")
