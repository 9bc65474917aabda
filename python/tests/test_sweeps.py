"""Sweeps: the same results, bit for bit, in this process, by shards, and on a cluster whose workers are killed."""
import json
import os
import pathlib
import signal
import subprocess
import sys
import threading
import time

import numpy
import pytest

import cuticle

distributed = pytest.importorskip("distributed")
HERE = pathlib.Path(__file__).parent
sys.path.insert(0, str(HERE))
import sweep_tasks  # noqa: E402

PROGRAM = os.environ.get("CUTICLE_PROGRAM") or HERE.parents[1] / "build/release/bin/cuticle"
MODELS = {"task": "eval", "fixed": {"quantity": "S", "theta_i_deg": 20.0, "theta_o_deg": numpy.linspace(-80, 80, 41).tolist(), "phi_deg": 100.0, "h": 0.2},
          "vary": {"model": ["marschner", "deon"], "set.sigma_a": {"from": 0.01, "to": 1, "count": 5, "spacing": "log"}}}
NUMBERS = {"task": sweep_tasks.slow, "vary": {"number": "0:199"}}


def content(results, folder):
    results.write(folder / "table.parquet")
    return (folder / "table.parquet").read_bytes()


@pytest.fixture(scope="module")
def serial(tmp_path_factory):
    folder = tmp_path_factory.mktemp("serial")
    results = cuticle.sweep(NUMBERS, folder / "store")
    assert results.computed == 200 and not results.failed
    return content(results, folder)


@pytest.fixture(scope="module")
def cluster():
    environment = {"PYTHONPATH": os.pathsep.join([str(HERE), *sys.path])}
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("PYTHONPATH", environment["PYTHONPATH"])
        with distributed.LocalCluster(n_workers=4, threads_per_worker=1, dashboard_address=None) as made, distributed.Client(made) as client:
            yield client


def test_Sweep_OfAModel_HoldsWhatEvalGives(tmp_path):
    results = cuticle.sweep(MODELS, tmp_path)
    table = results.table().to_pydict()
    assert results.computed == 10 and table["index"] == list(range(10)) and table["model"] == ["marschner"] * 5 + ["deon"] * 5
    expected = cuticle.eval("deon", "S", set={"sigma_a": 1.0}, **{key: value for key, value in MODELS["fixed"].items() if key != "quantity"})
    assert numpy.array_equal(results.array("value", 9), expected)


def test_Sweep_OnFourWorkersOfWhichTwoAreKilled_IsTheSerialRunBitForBit(tmp_path, cluster, serial):
    processes = [pid for pid in cluster.run(os.getpid).values()]
    killer = threading.Timer(0.6, lambda: [os.kill(pid, signal.SIGKILL) for pid in processes[:2]])
    killer.start()
    results = cuticle.sweep(NUMBERS, tmp_path / "store", client=cluster)
    killer.join()
    survivors = {pid for pid in results.table(runs=True)["run_pid"].to_pylist()}
    assert not results.failed and results.computed == 200 and content(results, tmp_path) == serial
    assert not set(processes[:2]) >= survivors and set(cluster.run(os.getpid).values()) != set(processes), "no worker was killed"


def test_Sweep_ByShards_IsTheSerialRunBitForBit(tmp_path, serial):
    for part in (3, 1, 2):
        results = cuticle.sweep(NUMBERS, tmp_path / "store", shard=f"{part}/3")
    assert content(results, tmp_path) == serial


class Counted:
    """A sweep of 60 items in a process of its own, whose calls a file counts."""

    def __init__(self, folder):
        self.log, self.command = folder / "calls", [sys.executable, HERE / "sweep_tasks.py", folder / "store"]

    def calls(self):
        return self.log.stat().st_size if self.log.exists() else 0

    def run(self, seconds, **more):
        environment = {**os.environ, "PYTHONPATH": os.pathsep.join([str(HERE), *sys.path]), "SWEEP_LOG": str(self.log), "SWEEP_SECONDS": str(seconds)}
        return subprocess.run(self.command, capture_output=True, text=True, env={**environment, **more})

    def end_by(self, number, at, seconds):
        """A signal comes in the call of this number."""
        assert self.run(seconds, SWEEP_END_AT=str(at), SWEEP_SIGNAL=str(int(number))).returncode != 0
        assert self.calls() == at

    def finish(self):
        """How many items were computed again or anew."""
        return int(self.run(0).stdout.split()[1])


def test_Sweep_StoppedHalfWay_GoesOnWithoutRepeatingWork(tmp_path):
    """Ended by Ctrl-C: what was computed is kept, and computed once."""
    sweep = Counted(tmp_path)
    sweep.end_by(signal.SIGINT, 20, 0.01)
    assert sweep.finish() == 41 and sweep.calls() == 61, "only the item in work is computed again"


def test_Sweep_KilledOutright_LosesAtMostTheLastSecond(tmp_path):
    sweep = Counted(tmp_path)
    sweep.end_by(signal.SIGKILL, 30, 0.1)
    assert 60 - 29 <= sweep.finish() <= 60 - 29 + 15, "of three seconds' work, what is older than one is kept"


def test_Sweep_OtherPlanOverTheSameStore_ReusesEqualItems(tmp_path):
    cuticle.sweep({**NUMBERS, "vary": {"number": [1, 2, 3]}}, tmp_path)
    more = cuticle.sweep({**NUMBERS, "vary": {"number": [3, 4, 1]}}, tmp_path)
    assert (more.computed, more.reused) == (1, 2)
    assert more.table()["number"].to_pylist() == [3, 4, 1] and more.table()["square"].to_pylist() == [9, 16, 1]


def test_Sweep_AFileThatChanged_IsAnotherItem(tmp_path):
    def text_of(path):
        return {"text": pathlib.Path(path).read_text()}

    plan = {"task": text_of, "fixed": {"path": str(tmp_path / "in.txt")}}
    (tmp_path / "in.txt").write_text("a")
    cuticle.sweep(plan, tmp_path / "store")
    (tmp_path / "in.txt").write_text("b")
    assert cuticle.sweep(plan, tmp_path / "store").table()["text"].to_pylist() == ["b"]


def test_Sweep_ByAnotherBuildOfTheSameVersion_IsComputedAgain(tmp_path, monkeypatch):
    plan = {"task": sweep_tasks.slow, "vary": {"number": [1, 2]}}
    cuticle.sweep(plan, tmp_path)
    assert cuticle.sweep(plan, tmp_path).computed == 0
    monkeypatch.setattr(cuticle.sweeps.plan, "toolkit", lambda: "another")
    assert cuticle.sweep(plan, tmp_path).computed == 2


@pytest.mark.parametrize("on_cluster", [False, True])
def test_Sweep_FailingItems_AreRetriedUnlessTheInputIsBad(tmp_path, request, on_cluster):
    marks = tmp_path / "marks"
    marks.mkdir()
    plan = {"task": sweep_tasks.fails_at_first, "fixed": {"folder_of_marks": str(marks)}, "vary": {"number": "0:7"}}
    client = request.getfixturevalue("cluster") if on_cluster else None
    results = cuticle.sweep(plan, tmp_path / "store", client=client)
    assert results.table()["number"].to_pylist() == [0, 1, 2, 3, 4, 6, 7]
    (failure,) = results.failed
    assert failure.index == 5 and "number: 5" in failure.message and failure.tries == 1
    assert (marks / "3").read_text() == "xxx" and results.store.failures(results.plan)[0]["index"] == 5


def test_Sweep_AnItemThatEndsItsWorkers_IsFoundAndTheOthersAreComputed(tmp_path, cluster):
    results = cuticle.sweep({"task": sweep_tasks.ends_its_process, "vary": {"number": "0:7"}}, tmp_path, client=cluster)
    assert [failure.index for failure in results.failed] == [4]
    assert results.table()["number"].to_pylist() == [0, 1, 2, 3, 5, 6, 7]


def test_Sweep_ADamagedPart_IsComputedAgain(tmp_path):
    first = cuticle.sweep({**NUMBERS, "vary": {"number": "0:4"}}, tmp_path / "store")
    before = content(first, tmp_path)
    part = first.store.parts()[0]
    part.write_bytes(part.read_bytes()[:100])
    assert first.store.damaged() == [part]
    again = cuticle.sweep(first.plan, tmp_path / "store")
    assert again.computed > 0 and content(again, tmp_path) == before


def test_Store_Compacted_HoldsTheSame(tmp_path):
    results = cuticle.sweep({**NUMBERS, "vary": {"number": "0:9"}}, tmp_path / "store")
    cuticle.sweep({**NUMBERS, "vary": {"number": "5:14"}}, tmp_path / "store")
    before = content(results, tmp_path)
    results.store.compact()
    assert len(results.store.parts()) == 1 and content(results, tmp_path) == before


def test_Sweep_LargeArrays_LieInFilesNamedByTheirContent(tmp_path):
    def picture(number):
        return {"picture": numpy.full((100, 100, 4), number, numpy.float32)}

    results = cuticle.sweep({"task": picture, "vary": {"number": [1, 2]}}, tmp_path)
    assert results.array("picture", 1).shape == (100, 100, 4) and (results.array("picture", 1) == 2).all()


@pytest.mark.parametrize("plan, words", [
    ({"task": "evall"}, ["evall", "eval"]), ({"task": "eval", "varry": {}}, ["varry", "vary"]), ({"vary": {}}, ["task"]),
    ({"task": "shadow", "vary": {"methodd": ["truth"]}}, ["methodd", "method"]), ({"task": "shadow", "vary": {"method": ["truth"]}}, ["groom"]),
    ({"task": "eval", "vary": {"set.beta": "0-1"}}, ["set.beta", "0-1"]), ({"task": "eval", "vary": {"model": []}}, ["model", "no values"]),
    ({"task": "eval", "schema_version": 2}, ["schema_version", "2"]), ({"task": "eval", "vary": {"a,b": [[1, 2, 3]]}}, ["a,b", "2 names"]),
    ({"task": "eval", "fixed": {"set": "eta=1"}, "vary": {"set.beta": [1]}}, ["set.beta", "eta=1"]),
])
def test_Plan_BadInput_SaysWhat(tmp_path, plan, words):
    with pytest.raises(cuticle.Error) as error:
        results = cuticle.sweep(plan, tmp_path)
        raise cuticle.Error(results.failed[0].message)
    assert all(word in str(error.value) for word in words)


def test_Plan_BlocksAndZippedNames_GiveTheItemsMeant():
    plan = cuticle.sweeps.Plan({"task": "eval", "vary": [{"model": ["karis"], "theta_i_deg,phi_deg": [[1, 2], [3, 4]]}, {"model": ["marschner"], "set.beta": "0:1:3"}]})
    assert len(plan) == 5 and plan.changes(1) == {"model": "karis", "theta_i_deg": 3, "phi_deg": 4}
    assert plan.columns(range(5))["set.beta"] == [None, None, 0.0, 0.5, 1.0] and plan.parameters(4)["set"] == {"beta": 1.0}


def program(*words):
    return subprocess.run([PROGRAM, "sweep", *map(str, words)], capture_output=True, text=True)


def test_Program_ShardsAndCommands_MakeOneTable(tmp_path):
    (tmp_path / "plan.json").write_text(json.dumps({**MODELS, "name": "models"}))
    emitted = program(tmp_path / "plan.json", "--out", tmp_path / "store", "--emit-commands", 2)
    commands = emitted.stdout.splitlines()
    assert emitted.returncode == 0 and len(commands) == 2 and commands[1].endswith("--shard 2/2")
    for command in commands:
        done = program(*command.split()[2:], "--json")
        assert done.returncode == 0 and json.loads(done.stdout)["computed"] == 5, done.stderr
    last = program(tmp_path / "plan.json", "--out", tmp_path / "store", "--table", tmp_path / "all.csv")
    assert last.returncode == 0 and "0 computed" in last.stdout and (tmp_path / "all.csv").read_text().count("\n") == 11


@pytest.mark.parametrize("words, code", [(["--shard", "3/2"], 2), (["--retries", "-1"], 2), (["--dry-run"], 0)])
def test_Program_ItsOptions_EndWithTheRightCode(tmp_path, words, code):
    (tmp_path / "plan.json").write_text(json.dumps(MODELS))
    assert program(tmp_path / "plan.json", "--out", tmp_path / "store", *words).returncode == code


def test_Program_APlanThatIsNone_IsBadInput(tmp_path):
    (tmp_path / "plan.json").write_text("[1")
    done = program(tmp_path / "plan.json", "--out", tmp_path / "store")
    assert done.returncode == 3 and "plan.json" in done.stderr
