# SPDX-License-Identifier: Apache-2.0
"""Runs the named tests of this folder, or all: exit status 1 if one fails, 77 if one is skipped; the last line says
why, for tests/skips."""

import pathlib
import sys
import unittest

HERE = str(pathlib.Path(__file__).parent)


def main(names):
    sys.path.insert(0, HERE)
    loader = unittest.TestLoader()
    suite = loader.loadTestsFromNames(names) if names else loader.discover(HERE, top_level_dir=HERE)
    result = unittest.TextTestRunner(stream=sys.stdout, verbosity=2).run(suite)
    if not result.wasSuccessful() or result.testsRun == 0:
        return 1
    reasons = dict.fromkeys(reason for _, reason in result.skipped)
    if reasons:
        print(f"python: skipped: {'; '.join(reasons)} ({len(result.skipped)} of {result.testsRun} tests)")
    return 77 if reasons else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
