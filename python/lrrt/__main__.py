# SPDX-License-Identifier: BSD-3-Clause
"""``python -m lrrt`` is the command ``lrrt``."""

from lrrt.cli import main

main()
