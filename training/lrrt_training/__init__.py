# SPDX-License-Identifier: BSD-3-Clause
"""Training of the promising-region models: mazes, data, network, loss, metrics, export, evaluation."""

__version__ = "0.1.0"
