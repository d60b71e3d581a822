# SPDX-License-Identifier: BSD-3-Clause
"""``python leash.py PARENT PROGRAM WORDS...``: becomes a program that ends when the process that began it ends.

A worker that is killed leaves its program running otherwise, beside the one that does the same work again.
"""

import ctypes
import os
import signal
import sys

_SET_SIGNAL_AT_PARENTS_DEATH = 1  # PR_SET_PDEATHSIG of Linux


def main() -> None:
    """Becomes the program; stops where the parent is gone already."""
    parent, program = int(sys.argv[1]), sys.argv[2:]
    if sys.platform == "linux":
        ctypes.CDLL(None).prctl(_SET_SIGNAL_AT_PARENTS_DEATH, signal.SIGTERM)
    if os.getppid() != parent:
        sys.exit(128 + signal.SIGTERM)
    os.execvp(program[0], program)


if __name__ == "__main__":
    main()
