# SPDX-License-Identifier: BSD-3-Clause
"""``lrrt sweep``: merging of shards, shards on their own, and sweeps on a cluster whose workers die."""

from __future__ import annotations

import copy
import importlib
import json
import os
import shutil
import signal
import socket
import subprocess
import sys
import threading
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from fake_bench import shard_of
from hypothesis import given
from hypothesis import strategies as some
from typer.testing import CliRunner
from worker_tasks import always_dies, dies_once, refuses, square

from lrrt import cli
from lrrt.report import load, terminal_report
from lrrt.report.writing import document_text
from lrrt.sweep import ClusterError, Sweep, SweepError, WorkerLostError, cluster, map_on_ray, merge, run_sweep, running
from lrrt.sweep.errors import ShardInterruptedError
from lrrt.sweep.shards import Shard, ledger_of, run_shard

ROOT = Path(__file__).parents[2]
FAKE = Path(__file__).with_name("fake_bench.py")
PLANNERS = ("RRT*", "guided")
NO_RAY = 'Ray is not installed: pip install "lrrt[sweep]"'
TIMES = ("times_ms", "first_ms", "search_ms", "within_ms", "history")


def row(pair: int, planner: str) -> dict[str, Any]:
    where = {
        "group": "mazes",
        "map": f"maze {pair // 3}",
        "query": "farthest",
        "planner": planner,
        "seed": pair % 3 + 1,
    }
    times = {"prepare": 1.0, "encode": 0.0, "infer": 0.0, "region": 0.0, "plan": 9.0, "total": 10.0}
    counts = {"solved": False, "iterations": 100 + pair, "nodes": 50, "times_ms": times}
    return {"id": f"{pair} {planner}", **where, **counts}


def whole(pairs: int = 7) -> dict[str, Any]:
    """A result of a run that is not sharded, as small as a report takes it."""
    settings = {"planner": "RRTstar", "strategy": "uniform", "alpha": 0.8, "model": "default", "range": 6.0}
    planners = [{"name": name, **settings, "stop": "first", "time_limit": 20.0} for name in PLANNERS]
    maps = [{"kind": "file", "name": "mazes", "path": "mazes.map"}]
    return {
        "format": "lrrt_bench 1",
        "suite": {"title": "A suite", "kind": "plan", "baseline": "RRT*", "maps": maps, "planners": planners},
        "folder": "suites",
        "inputs": {"models": {"default": "ab12"}, "maps": {"maze 0": "cd34"}},
        "versions": {"lrrt": "0.1.0", "ompl": "1.5.2"},
        "machine": {"processor": "A processor", "cores": 2, "system": "Linux"},
        "started": "2026-11-22 11:53:08",
        "rows": [row(pair, planner) for pair in range(pairs) for planner in PLANNERS],
    }


def shards_of(document: dict[str, Any], of: int) -> dict[str, dict[str, Any]]:
    return {f"{k}.json": copy.deepcopy(shard_of(document, k, of, len(PLANNERS))) for k in range(1, of + 1)}


@pytest.fixture(scope="session")
def bench() -> str:
    """The benchmark program: LRRT_BENCH, the one that was built last, or that of PATH."""
    built = sorted(ROOT.glob("build/*/bench/lrrt_bench"), key=lambda path: path.stat().st_mtime)
    found = os.environ.get("LRRT_BENCH") or (str(built[-1]) if built else shutil.which("lrrt_bench"))
    return found or pytest.skip("there is no lrrt_bench: 'make build' makes it, or set LRRT_BENCH to it")


@pytest.fixture
def fake(tmp_path) -> Path:
    """A folder with a program that stands in for lrrt_bench, see fake_bench.py."""
    program = tmp_path / "fake_bench.py"
    program.write_text(f"#!{sys.executable}\n{FAKE.read_text(encoding='utf-8')}", encoding="utf-8")
    program.chmod(0o755)
    (tmp_path / "whole.json").write_text(json.dumps(whole()), encoding="utf-8")
    return tmp_path


def sweep_of(folder: Path, shards: int = 3, **changes: Any) -> Sweep:
    return Sweep("suite", folder / "out.json", shards, str(folder / "fake_bench.py"), **changes)


def calls(folder: Path) -> list[str]:
    return sorted((folder / "log").read_text().split())


def files(folder: Path) -> list[str]:
    return sorted(path.name for path in folder.iterdir() if path.name.startswith("out.json"))


# Merging


@given(pairs=some.integers(0, 20), of=some.integers(1, 9), order=some.randoms())
def test_merged_shards_are_the_whole(pairs, of, order):
    shards = list(shards_of(whole(pairs), of).items())
    order.shuffle(shards)
    merged = merge(dict(shards))
    assert merged.pop("shards") == [
        {"number": k, "machine": whole()["machine"], "started": whole()["started"]} for k in range(1, of + 1)
    ]
    assert merged == whole(pairs)


def test_merged_predictions_keep_their_order():
    document = whole() | {"suite": {"title": "", "kind": "predict"}, "rows": [{"id": str(i)} for i in range(7)]}
    shards = {str(k): copy.deepcopy(shard_of(document, k, 3, 1)) for k in (1, 2, 3)}
    assert merge(shards)["rows"] == document["rows"]


def test_every_shard_keeps_its_machine_and_the_whole_what_all_share():
    shards = shards_of(whole(), 2)
    shards["2.json"]["machine"] = {"processor": "Another", "cores": 64, "system": "Linux"}
    shards["1.json"]["started"] = "2026-11-23 00:00:00"
    merged = merge(shards)
    assert merged["machine"] == {"processor": "A processor and Another", "system": "Linux"}
    assert merged["started"] == whole()["started"]
    assert [shard["machine"]["cores"] for shard in merged["shards"]] == [2, 64]


def test_the_merged_file_is_a_result(tmp_path):
    file = tmp_path / "merged.json"
    file.write_text(document_text(merge(shards_of(whole(), 3))), encoding="utf-8")
    assert json.loads(file.read_text(encoding="utf-8"))["rows"] == whole()["rows"]
    assert [run.iterations for run in load(file).runs[::2]] == list(range(100, 107))
    assert "A processor, 2 cores" in terminal_report(file)
    lines = file.read_text(encoding="utf-8").splitlines()
    assert sum('"id"' in line for line in lines) == len(whole()["rows"]), "a line for every row"


def broken(change: Any) -> dict[str, dict[str, Any]]:
    shards = shards_of(whole(), 3)
    change(shards)
    return shards


@pytest.mark.parametrize(
    ("change", "words"),
    [
        (lambda s: s.clear(), ["no shards"]),
        (lambda s: s.pop("2.json"), ["shard 2 of 3 is missing"]),
        (lambda s: s.update({"b.json": s["2.json"]}), ["b.json", "shard 2 of 3", "as is 2.json"]),
        (lambda s: s["3.json"].update(shard={"number": 3, "of": 4}), ["3.json", "3 of 4", "one of 3"]),
        (lambda s: s["1.json"].pop("shard"), ["2.json", "2 of 3", "one of 1"]),
        (lambda s: s["2.json"]["suite"].update(baseline="guided"), ["2.json", 'suite.baseline is "guided"', '"RRT*"']),
        (
            lambda s: s["3.json"]["suite"]["planners"][1].update(alpha=0.5),
            ["suite.planners[1].alpha is 0.5, there 0.8"],
        ),
        (lambda s: s["2.json"]["inputs"]["maps"].update({"maze 0": "ee"}), ["2.json", 'inputs.maps.maze 0 is "ee"']),
        (lambda s: s["2.json"]["versions"].update(ompl="2.0.0"), ["2.json", 'versions.ompl is "2.0.0", there "1.5.2"']),
        (lambda s: s["2.json"].update(format="lrrt_bench 2"), ["2.json", "is no result file"]),
        (lambda s: s["2.json"].pop("machine"), ["2.json", "'machine' is missing"]),
        (lambda s: s["2.json"].update(machine=5), ["2.json", "'machine' is 5", "an object"]),
        (lambda s: s["2.json"].update(started=None), ["2.json", "'started' is null", "a text"]),
        (lambda s: s["2.json"].update(shard=[]), ["2.json", "'shard' is []", "an object"]),
        (lambda s: s["2.json"]["shard"].update(number="2"), ["2.json", "'shard.number'", "a whole number"]),
        (lambda s: s["2.json"]["shard"].update(number=4), ["2.json", "'shard.number' is 4", "1 to 3"]),
        (lambda s: s["2.json"]["shard"].update(of=10**18), ["2.json", "'shard.of'", "1 to 999999"]),
        (lambda s: s["2.json"].update(suite={}), ["2.json", "'suite.kind' is missing"]),
        (lambda s: s["2.json"]["suite"]["planners"][0].pop("name"), ["2.json", "'suite.planners[0].name' is missing"]),
        (lambda s: s["2.json"].update(rows=5), ["2.json", "'rows' is 5", "a list of runs"]),
        (lambda s: s["2.json"]["rows"].insert(0, 5), ["2.json", "'rows[0]' is 5", "an object"]),
        (lambda s: s["2.json"]["rows"][1].pop("planner"), ["2.json", "'rows[1].planner' is missing"]),
        (lambda s: s["2.json"]["rows"][1].update(map=[]), ["2.json", "'rows[1].map' is []", "a text"]),
        (lambda s: s["1.json"]["rows"].pop(3), ["1.json", "rows[2]", "each of RRT*, guided"]),
        (lambda s: s["1.json"]["rows"][2].update(seed=9), ["1.json", "rows[2]", "one problem and seed"]),
        (lambda s: s.update({"1.json": s["1.json"] | {"rows": s["1.json"]["rows"][:2]}}), ["1.json", "holds 1 of 5"]),
    ],
)
def test_what_does_not_fit_together_is_refused_by_name(change, words):
    with pytest.raises(SweepError) as error:
        merge(broken(change))
    assert all(word in str(error.value) for word in words), error.value


def untimed(document: dict[str, Any]) -> list[dict[str, Any]]:
    return [{key: value for key, value in row.items() if key not in TIMES} for row in document["rows"]]


def test_the_program_shards_what_is_merged_again(bench, tmp_path):
    def run(file: Path, *words: str) -> str:
        command = [bench, *words, "--json", file]
        return subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=True).stdout

    def written(file: Path) -> dict[str, Any]:
        return json.loads(file.read_text(encoding="utf-8"))

    suite = ("--suite", "bench/suites/smoke.yaml")
    assert run(tmp_path / "whole.json", *suite) == terminal_report(tmp_path / "whole.json")
    for k in (1, 2, 3):
        run(tmp_path / f"{k}.json", *suite, "--shard", f"{k}/3")
    merged = merge({f"{k}.json": written(tmp_path / f"{k}.json") for k in (3, 1, 2)})
    single = written(tmp_path / "whole.json")
    assert untimed(merged) == untimed(single)
    assert all(merged[key] == single[key] for key in ("suite", "folder", "inputs", "versions", "machine"))
    (tmp_path / "merged.json").write_text(document_text(merged), encoding="utf-8")
    assert "40 of 40 rows are the same" in run(tmp_path / "again.json", "--replay", str(tmp_path / "merged.json"))


@pytest.mark.parametrize(
    "content",
    [b"\xff\xfe", b"[" * 100_000, b"{", b"5", b"{}", b'{"format": "lrrt_bench 1"}'],
    ids=["bytes", "deep", "cut", "number", "empty", "head"],
)
def test_a_shard_that_was_damaged_is_named_with_what_to_do(fake, content):
    shard = fake / "out.json.shard-2-of-3.json"
    running._token(sweep_of(fake))  # begins the sweep
    shard.write_bytes(content)
    with pytest.raises(SweepError, match=r"shard-2-of-3\.json.*remove .*shard-2-of-3\.json to run this shard again"):
        run_sweep(sweep_of(fake))
    assert shard.read_bytes() == content


# A shard on its own


def shard_in(place: Path, **changes: Any) -> Shard:
    fields = {"suite": "suite", "program": str(place / "fake_bench.py"), "options": (), "token": "here"}
    result = place / "out.json"
    ledger_of(result).write_text('{"token": "here"}')
    return Shard(**{"number": 2, "of": 3, "result": result, "folder": place, **fields, **changes})


def test_a_shard_lies_beside_the_result_only_where_the_folder_is_the_same(fake):
    elsewhere = shard_in(fake, token="there")
    assert len(json.loads(run_shard(elsewhere))["rows"]) == 4
    assert files(fake) == ["out.json.sweep"]
    assert json.loads(run_shard(shard_in(fake))) == shard_of(whole(), 2, 3, 2)
    assert files(fake) == ["out.json.shard-2-of-3.json", "out.json.sweep"]


def test_relative_programs_and_suites_count_from_where_the_command_was_given(fake, monkeypatch, tmp_path_factory):
    monkeypatch.chdir(tmp_path_factory.mktemp("elsewhere"))
    assert len(json.loads(run_shard(shard_in(fake, program="./fake_bench.py")))["rows"]) == 4


def test_a_shard_that_fails_says_where_and_what_the_program_said(fake):
    (fake / "fail-2").touch()
    with pytest.raises(SweepError, match=r"^shard 2 of 3 on .*fake_bench.py failed: no such map$"):
        run_shard(shard_in(fake))
    with pytest.raises(SweepError, match=r"no program 'none_such'; .*make build"):
        run_shard(shard_in(fake, program="none_such"))


def test_a_program_that_is_ended_may_be_tried_again(fake):
    (fake / "stop-2").touch()
    with pytest.raises(ShardInterruptedError):
        run_shard(shard_in(fake))


@pytest.mark.parametrize(("machine", "kept"), [({}, True), ({"processor": "Another"}, False)])
def test_a_shard_is_gone_on_with_on_the_same_kind_of_machine_only(bench, tmp_path, machine, kept):
    shard = shard_in(tmp_path, suite="bench/suites/smoke.yaml", program=bench, folder=ROOT)
    document = json.loads(run_shard(shard))
    shard.file.unlink()
    head = {key: value for key, value in document.items() if key not in ("format", "rows")}
    head["machine"] |= machine
    marked = document["rows"][0] | {"nodes": 12345}
    shard.part.write_text(f"{json.dumps(head)}\n{json.dumps(marked)}\n", encoding="utf-8")
    rows = json.loads(run_shard(shard))["rows"]
    assert (rows[0]["nodes"] == 12345) == kept and len(rows) == len(document["rows"])


# On a cluster


@pytest.fixture(scope="module")
def machines():
    """A cluster of two machines with one CPU each, as far as Ray can tell."""
    pytest.importorskip("ray", reason=NO_RAY)
    import ray
    from ray.cluster_utils import Cluster

    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("PYTHONPATH", str(Path(__file__).parent), prepend=os.pathsep)  # workers import worker_tasks
        made = Cluster(initialize_head=True, head_node_args={"num_cpus": 1, "include_dashboard": False})
        made.add_node(num_cpus=1)
    ray.init(address=made.address, log_to_driver=False, logging_level="ERROR")
    yield made
    ray.shutdown()
    made.shutdown()


@pytest.fixture
def two_workers(machines) -> str:
    """The address of that cluster."""
    return machines.address


def test_a_function_is_mapped_and_an_open_session_stays(two_workers):
    import ray

    assert sorted(map_on_ray(square, range(5))) == [(i, i * i) for i in range(5)]
    assert list(map_on_ray(square, [3], exclusive=True)) == [(3, 9)]
    assert ray.is_initialized()


@pytest.mark.parametrize("ray_retries", [cluster.RAY_RETRIES, 0])
def test_an_item_whose_worker_dies_is_tried_again(two_workers, tmp_path, monkeypatch, ray_retries):
    monkeypatch.setattr(cluster, "RAY_RETRIES", ray_retries)
    markers = [str(tmp_path / name) for name in "abc"]
    Path(markers[1]).touch()
    assert sorted(map_on_ray(dies_once, markers)) == [(marker, "alive") for marker in markers]


def test_workers_that_always_die_end_the_map(two_workers, monkeypatch):
    monkeypatch.setattr(cluster, "RAY_RETRIES", 0)
    monkeypatch.setattr(cluster, "RESUBMISSIONS", 1)
    with pytest.raises(WorkerLostError, match="an item: its worker was lost again and again"):
        list(map_on_ray(always_dies, ["an item"]))


def test_what_the_function_raises_is_raised(two_workers):
    with pytest.raises(SweepError, match=r"^no 7$") as error:
        list(map_on_ray(refuses, [7]))
    assert type(error.value) is SweepError
    with pytest.raises(WorkerLostError, match="no 7"):
        list(map_on_ray(refuses, [7], again_on=(SweepError,)))


def test_a_module_that_workers_lack_is_named(two_workers, tmp_path, monkeypatch):
    (tmp_path / "only_here.py").write_text("def double(number):\n    return 2 * number\n")
    monkeypatch.syspath_prepend(tmp_path)
    double = importlib.import_module("only_here").double
    with pytest.raises(ClusterError, match="No module named 'only_here'; expected it on every machine"):
        list(map_on_ray(double, [1]))


@pytest.mark.parametrize("cpus", [0, 2])
def test_more_cpus_than_any_machine_has_are_refused(two_workers, cpus):
    with pytest.raises(ClusterError, match=rf"{cpus} CPUs a task: expected 1 to 1"):
        list(map_on_ray(square, [1], cpus=cpus))


def test_a_sweep_survives_lost_workers(two_workers, fake):
    (fake / "kill-2").touch()
    (fake / "stop-3").touch()
    seen: list[int] = []
    document = run_sweep(sweep_of(fake), progress=seen.append)
    assert document["rows"] == whole()["rows"] and seen == [0, 1, 2, 3]
    assert calls(fake) == ["1", "2", "2", "3", "3"]
    assert files(fake) == ["out.json"], "nothing else stays"
    assert json.loads((fake / "out.json").read_text(encoding="utf-8")) == document


def test_a_sweep_survives_a_lost_machine(machines, fake):
    lost = machines.add_node(num_cpus=1)
    waits = [fake / f"wait-{k}" for k in (1, 2, 3)]
    for wait in waits:
        wait.touch()

    def lose() -> None:
        until(lambda: (fake / "log").exists() and len(calls(fake)) == 3)
        machines.remove_node(lost, allow_graceful=False)
        for wait in waits:
            wait.unlink()

    thief = threading.Thread(target=lose)
    thief.start()
    document = run_sweep(sweep_of(fake))
    thief.join()
    assert document["rows"] == whole()["rows"] and files(fake) == ["out.json"]


def until(condition: Callable[[], bool]) -> None:
    """Waits for something that does come."""
    deadline = time.monotonic() + 60
    while not condition():
        assert time.monotonic() < deadline
        time.sleep(0.05)


def test_a_program_does_not_outlive_its_worker(two_workers, fake):
    (fake / "kill-1").touch()
    run_sweep(sweep_of(fake, 1))
    time.sleep(1.5)
    assert not (fake / "outlived").exists()


def test_a_sweep_that_failed_goes_on_with_what_is_there(two_workers, fake):
    (fake / "fail-3").touch()
    with pytest.raises(SweepError, match=r"shard 3 of 3 .* no such map"):
        run_sweep(sweep_of(fake, seed=5))
    left = files(fake)
    (fake / "log").unlink()
    assert run_sweep(sweep_of(fake, seed=5))["rows"] == whole()["rows"]
    assert calls(fake) == [str(k) for k in (1, 2, 3) if f"out.json.shard-{k}-of-3.json" not in left]


def test_a_shard_of_another_version_is_not_kept(two_workers, fake):
    (fake / "wait-2").touch()
    with pytest.raises(SweepError, match=r"versions\.lrrt"):
        run_sweep(sweep_of(fake, 2), progress=lambda done: other_version(fake) if done else None)
    assert [name for name in files(fake) if name.endswith("2-of-2.json")] == []


def other_version(folder: Path) -> None:
    """From now on the stand-in is of another version."""
    (folder / "whole.json").write_text(json.dumps(whole() | {"versions": {"lrrt": "9.9.9"}}))
    (folder / "wait-2").unlink(missing_ok=True)


def lrrt_sweep(folder: Path, address: str) -> subprocess.Popen[str]:
    words = ["suite", "--shards", "3", "--json", "out.json", "--bench", "./fake_bench.py", "--ray", address]
    return subprocess.Popen(
        [sys.executable, "-m", "lrrt", "sweep", *words],
        cwd=folder,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        # a parent that runs in the background may have handed down that Ctrl-C is ignored
        preexec_fn=lambda: signal.signal(signal.SIGINT, signal.SIG_DFL),
    )


def test_ctrl_c_leaves_finished_shards_and_the_same_command_goes_on(two_workers, fake):
    (fake / "wait-3").touch()
    run = lrrt_sweep(fake, two_workers)
    wanted = [fake / f"out.json.shard-{k}-of-3.json" for k in (1, 2)]
    until(lambda: all(path.exists() for path in wanted))
    run.send_signal(signal.SIGINT)
    _, said = run.communicate(timeout=60)
    # Ray itself may fall over when a task ends as it is interrupted; what is asked of us holds even then
    ray_fell_over = "likely discovered a bug in Ray" in said
    assert ray_fell_over or (run.returncode == 130 and "interrupted after 2 of 3 shards" in said), said
    with pytest.raises(SweepError, match=r"out\.json\.sweep: was begun with another suite.*remove it and"):
        run_sweep(sweep_of(fake, 4))

    (fake / "wait-3").unlink()
    (fake / "log").unlink()
    run = lrrt_sweep(fake, two_workers)
    printed, said = run.communicate(timeout=60)
    assert run.returncode == 0, said
    assert calls(fake) == ["3"]
    assert printed == terminal_report(fake / "out.json")
    assert files(fake) == ["out.json"]


# Refusals before anything runs


@pytest.mark.parametrize(("cpus", "reserved"), [([8, 8, 0], 8), ([8, 12, 15], 8), ([8, 16], None), ([0], None)])
def test_a_machine_is_a_shards_own_only_where_no_second_has_room(cpus, reserved):
    class Ray:
        @staticmethod
        def nodes() -> list[dict[str, Any]]:
            gone = {"Alive": False, "Resources": {"CPU": 1.0}}
            return [gone, *({"Alive": True, "Resources": {"CPU": float(n)} if n else {}} for n in cpus)]

    if reserved:
        assert cluster._whole_machine(Ray) == reserved
        return
    with pytest.raises(ClusterError, match=r"twice as many|offers a CPU"):
        cluster._whole_machine(Ray)


def invoke(*words: object):
    return CliRunner().invoke(cli.app, ["sweep", *(str(word) for word in words)])


def test_without_ray_the_error_says_what_to_install(fake, monkeypatch):
    monkeypatch.setitem(sys.modules, "ray", None)
    run = invoke("suite", "--shards", 2, "--json", fake / "out.json")
    assert run.exit_code == 2 and 'pip install "lrrt[sweep]"' in run.stderr and "Traceback" not in run.stderr
    assert files(fake) == [], "nothing was begun"


def test_a_cluster_that_does_not_answer_is_named_at_once(fake):
    pytest.importorskip("ray", reason=NO_RAY)
    with socket.create_server(("127.0.0.1", 0)) as free:
        address = f"127.0.0.1:{free.getsockname()[1]}"
    words = [sys.executable, "-m", "lrrt", "sweep", "suite", "--shards", "2", "--json", "out.json", "--ray", address]
    run = subprocess.run(words, cwd=fake, capture_output=True, text=True, timeout=60)
    assert run.returncode == 2 and address in run.stderr and "ray start --head" in run.stderr, run.stderr
    assert files(fake) == [], "nothing was begun"


def test_shards_of_an_unknown_sweep_are_not_taken_over(fake):
    (fake / "out.json.shard-1-of-2.json").write_text("{}")
    with pytest.raises(SweepError, match=r"shard-1-of-2\.json: was left by another sweep; remove"):
        run_sweep(sweep_of(fake, 2))


def test_a_result_that_cannot_be_written_exits_with_2(tmp_path):
    run = invoke("suite", "--shards", 2, "--json", tmp_path / "no" / "out.json")
    assert run.exit_code == 2 and "cannot be written" in run.stderr


def test_help_teaches():
    run = invoke("--help")
    words = " ".join(run.stdout.split())
    assert run.exit_code == 0
    assert all(word in words for word in ("lrrt_bench", "Ctrl-C", "--exclusive", "lrrt[sweep]", "ray start --head"))
