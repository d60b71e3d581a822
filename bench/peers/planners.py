# SPDX-License-Identifier: BSD-3-Clause
"""Which planners of the wheel are run: those that sample uniformly and search for a first or a shorter path."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Peer:
    """A planner of ``ompl.geometric``."""

    kind: str  #: its class, which is also what suites call it
    name: str  #: what tables call it
    shortens: bool = True  #: goes on after its first path to shorten it
    heeds_threshold: bool = True  #: ends by itself at a path that is no longer than the objective's threshold
    has_range: bool = True  #: has a longest extension
    has_goal_bias: bool = False
    is_rrt_star: bool = False  #: rewires its tree within a disc or among the k nearest


PEERS = {
    peer.kind: peer
    for peer in (
        Peer("RRTstar", "RRT*", has_goal_bias=True, is_rrt_star=True),
        Peer("InformedRRTstar", "Informed RRT*", has_goal_bias=True, is_rrt_star=True),
        Peer("SORRTstar", "SORRT*", has_goal_bias=True, is_rrt_star=True),
        Peer("BITstar", "BIT*", has_range=False),
        Peer("AORRTC", "AORRTC", heeds_threshold=False),
        Peer("RRTConnect", "RRT-Connect", shortens=False),
    )
}
