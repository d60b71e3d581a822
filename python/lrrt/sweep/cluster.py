# SPDX-License-Identifier: BSD-3-Clause
"""One function on many items, on the machines of a Ray cluster."""

from __future__ import annotations

import importlib
import os
import socket
from collections.abc import Callable, Iterable, Iterator
from contextlib import contextmanager
from typing import Any, TypeVar

from lrrt._core import Error

RAY_RETRIES = 2  #: Ray itself starts a task again when its worker dies, at once
RESUBMISSIONS = 2  #: after that the task is handed in anew, behind the others, perhaps to another machine
_NOT_IMPORTED = "failed to import on the worker"  # how Ray begins to say it

T = TypeVar("T")
R = TypeVar("R")


class ClusterError(Error):
    """Ray is not there, or the cluster cannot do what was asked for; says what to do."""


class WorkerLostError(ClusterError):
    """The workers of one item died again and again."""


def map_on_ray(
    function: Callable[[T], R],
    items: Iterable[T],
    address: str | None = None,
    *,
    cpus: int = 1,
    exclusive: bool = False,
    again_on: tuple[type[Exception], ...] = (),
) -> Iterator[tuple[T, R]]:
    """Calls a function on every item, in processes of a Ray cluster, and yields what is finished as it comes.

    An item whose worker dies is tried again, nine times in all, and three times where the function asks for it. What
    the function raises otherwise ends the map. Ray is shut down
    at the end, however the map ends, if it was started here; a session that is open already is used and stays.

    Args:
        function: of a module that every machine can import.
        items: what it is called on; travels to the workers, as the results travel back.
        address: ``auto`` (the cluster that this machine is part of) or ``HOST:PORT``; by default, or ``local``, Ray
            is started on this machine alone.
        cpus: CPUs that a call reserves; so many calls run at a time as the cluster has room for.
        exclusive: reserve all CPUs of a machine for a call instead.
        again_on: what the function raises where it should be tried again, as if its worker had died.

    Yields:
        Item and result, in the order in which they are finished.

    Raises:
        ClusterError: Ray is not installed, no cluster answers, or no machine has as many CPUs.
        WorkerLostError: the workers of an item died again and again.
    """
    ray = _imported_ray()
    with _session(ray, address):
        reserved = _whole_machine(ray) if exclusive else _checked(ray, cpus)
        task = ray.remote(function).options(num_cpus=reserved, max_retries=RAY_RETRIES)
        pending = {task.remote(item): (item, 0) for item in items}
        try:
            while pending:
                (done,), _ = ray.wait(list(pending), num_returns=1)
                item, losses = pending.pop(done)
                try:
                    result = ray.get(done)
                except ray.exceptions.RayError as error:
                    _raise_unless_lost(ray, error, again_on, item, losses)
                    pending[task.remote(item)] = (item, losses + 1)
                else:
                    yield item, result
        finally:
            for reference in pending:
                ray.cancel(reference, force=True)


def _imported_ray() -> Any:
    try:
        return importlib.import_module("ray")
    except ImportError as error:
        raise ClusterError(
            f'Ray cannot be imported ({error}); pip install "lrrt[sweep]" installs it, on every machine that takes part'
        ) from error


@contextmanager
def _session(ray: Any, address: str | None) -> Iterator[None]:
    """An open session of Ray; closed at the end if it was opened here."""
    if ray.is_initialized():
        yield
        return
    os.environ.setdefault("RAY_USAGE_STATS_ENABLED", "0")  # Ray would tell its makers about every start
    quiet = {"log_to_driver": False, "logging_level": "ERROR"}
    try:
        if address is None or address == "local":
            ray.init(address="local", include_dashboard=False, **quiet)
        else:
            _knock(address)
            ray.init(address=address, **quiet)
    except (OSError, RuntimeError, ValueError) as error:
        raise ClusterError(
            f"Ray address '{address or 'local'}': no session could be opened ({error}); expected 'local', or 'auto' or "
            "HOST:PORT of a cluster that 'ray start --head' began, with the same versions of Python and Ray"
        ) from error
    try:
        yield
    finally:
        ray.shutdown()


def _knock(address: str) -> None:
    """Raises OSError where nobody answers; Ray would try for minutes."""
    host, _, port = address.removeprefix("ray://").rpartition(":")
    if host and port.isdigit():
        socket.create_connection((host, int(port)), timeout=10).close()


def _machines(ray: Any) -> list[int]:
    """CPUs of every machine that has some."""
    found = [int(node["Resources"].get("CPU", 0)) for node in ray.nodes() if node["Alive"]]
    machines = [count for count in found if count > 0]
    if not machines:
        raise ClusterError("no machine of the cluster offers a CPU; 'ray start --num-cpus' sets how many")
    return machines


def _checked(ray: Any, cpus: int) -> int:
    """Ray would wait for ever for a machine that is larger than all."""
    most = max(_machines(ray))
    if not 1 <= cpus <= most:
        raise ClusterError(f"{cpus} CPUs a task: expected 1 to {most}, what the largest machine has")
    return cpus


def _whole_machine(ray: Any) -> int:
    """So many CPUs that every machine has room for one task, and none for two."""
    machines = _machines(ray)
    if max(machines) >= 2 * min(machines):
        raise ClusterError(
            f"a machine for each task alone: the machines have {min(machines)} to {max(machines)} CPUs; expected none "
            "with twice as many as another ('ray start --num-cpus' sets what Ray believes)"
        )
    return _checked(ray, min(machines))


def _raise_unless_lost(
    ray: Any, error: Exception, again_on: tuple[type[Exception], ...], item: object, losses: int
) -> None:
    """Raises what the function raised, or that its workers die too often."""
    cause = error.cause if isinstance(error, ray.exceptions.RayTaskError) else None
    if isinstance(cause, RuntimeError) and _NOT_IMPORTED in str(cause):
        raise ClusterError(
            f"a worker cannot import what it is to run: {str(cause).strip().splitlines()[-1]}; expected it on every "
            "machine, installed for the Python that Ray runs there"
        ) from error
    if cause is not None and not isinstance(cause, again_on):
        raise cause from error
    if losses == RESUBMISSIONS:
        why = str(cause or error).strip().splitlines()
        raise WorkerLostError(
            f"{item}: its worker was lost again and again ({why[0] if why else type(error).__name__}); is there memory "
            "enough, and do the machines stay up?"
        ) from error
