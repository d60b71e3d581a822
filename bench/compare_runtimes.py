# SPDX-License-Identifier: BSD-3-Clause
"""One model, several runtimes and settings: how long one inference takes on this machine.

    .venv/bin/python bench/compare_runtimes.py models/default.onnx runs/default.fp32.onnx

Two ways of calling are timed, since idle threads fall asleep: one call after the other, and a call every 20 ms, as a
robot that replans makes them. Every setting runs in a process of its own, so that no idle thread of one disturbs the
other, and all of them in turn, several rounds, of which the quickest median counts. OpenVINO is measured where
`pip install openvino` has put it.
"""

from __future__ import annotations

import argparse
import json
import statistics
import subprocess
import sys
import time
from collections.abc import Callable
from pathlib import Path

import numpy as np
from rich.console import Console
from rich.progress import track
from rich.table import Table

SETTINGS = {
    "ONNX Runtime, 1 thread": {"runtime": "onnxruntime", "threads": 1, "spinning": False},
    "ONNX Runtime, 2 threads": {"runtime": "onnxruntime", "threads": 2, "spinning": False},
    "ONNX Runtime, 2 threads, spinning": {"runtime": "onnxruntime", "threads": 2, "spinning": True},
    "OpenVINO, 1 thread": {"runtime": "openvino", "threads": 1},
    "OpenVINO, 2 threads": {"runtime": "openvino", "threads": 2},
}
CALLS, PAUSE = 60, 0.02


def onnxruntime_call(model: str, side: int, threads: int, spinning: bool) -> tuple[Callable[[], object], list[int]]:
    """A function that predicts once, as the library does, and the shape of the input."""
    import onnxruntime

    options = onnxruntime.SessionOptions()
    options.intra_op_num_threads, options.inter_op_num_threads = threads, 1
    options.add_session_config_entry("session.intra_op.allow_spinning", str(int(spinning)))
    session = onnxruntime.InferenceSession(model, options, providers=["CPUExecutionProvider"])
    shape = [1, *(n if isinstance(n, int) else side for n in session.get_inputs()[0].shape[1:])]
    picture = pictured(shape)
    return lambda: session.run(None, {"image": picture}), shape


def openvino_call(model: str, side: int, threads: int) -> tuple[Callable[[], object], list[int]]:
    import openvino

    core = openvino.Core()
    graph = core.read_model(model)
    shape = [1, *(side if n.is_dynamic else int(n.get_length()) for n in graph.inputs[0].partial_shape[1:])]
    graph.reshape(shape)
    compiled = core.compile_model(
        graph, "CPU", {"INFERENCE_NUM_THREADS": threads, "PERFORMANCE_HINT": "LATENCY", "NUM_STREAMS": 1}
    )
    request, picture = compiled.create_infer_request(), pictured(shape)
    return lambda: request.infer({0: picture}), shape


def pictured(shape: list[int]) -> np.ndarray:
    """Walls and free space at random: what is in the picture does not change the time."""
    return np.random.default_rng(1).choice(np.array([0, 255], np.uint8), shape)


def measure(model: str, side: int, runtime: str, **settings: object) -> dict[str, object]:
    """Medians in milliseconds: one call after the other, and after a pause."""
    call, shape = (onnxruntime_call if runtime == "onnxruntime" else openvino_call)(model, side, **settings)
    for _ in range(5):
        call()
    medians = {}
    for name, pause in (("busy", 0.0), ("paused", PAUSE)):
        times = []
        for _ in range(CALLS):
            time.sleep(pause)
            begin = time.perf_counter()
            call()
            times.append(1e3 * (time.perf_counter() - begin))
        medians[name] = statistics.median(times)
    return {**medians, "side": shape[-1]}


def in_own_process(model: Path, side: int, settings: dict[str, object]) -> dict[str, float] | str:
    """What measure() finds, or the last words of a runtime that is not installed or refuses the model."""
    job = json.dumps({"model": str(model), "side": side, **settings})
    run = subprocess.run([sys.executable, __file__, "--job", job], capture_output=True, text=True, check=False)
    return json.loads(run.stdout) if run.returncode == 0 else (run.stderr.strip().splitlines() or ["failed"])[-1]


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("models", nargs="*", type=Path, help="ONNX files")
    parser.add_argument(
        "--side", type=int, default=256, help="of the picture, for models that take several (default 256)"
    )
    parser.add_argument("--rounds", type=int, default=5, help="times that every setting is run (default 5)")
    parser.add_argument("--job", help=argparse.SUPPRESS)
    arguments = parser.parse_args()
    if arguments.job:
        print(json.dumps(measure(**json.loads(arguments.job))))
        return
    jobs = [(model, name) for model in arguments.models for name in SETTINGS]
    found: dict[tuple[Path, str], list[dict[str, float]]] = {job: [] for job in jobs}
    failures: dict[tuple[Path, str], str] = {}
    for model, name in track(jobs * arguments.rounds, description="runtimes"):
        result = in_own_process(model, arguments.side, SETTINGS[name])
        if isinstance(result, str):
            failures[model, name] = result
        else:
            found[model, name].append(result)
    table = Table("model", "input", "runtime", "one after the other", "after a pause of 20 ms")
    for (model, name), results in found.items():
        if results:
            busy, paused = (f"{min(r[kind] for r in results):.2f} ms" for kind in ("busy", "paused"))
            table.add_row(model.name, f"{results[0]['side']}²", name, busy, paused)
        else:
            table.add_row(model.name, "", name, failures[model, name], "")
    Console().print(table)


if __name__ == "__main__":
    main()
