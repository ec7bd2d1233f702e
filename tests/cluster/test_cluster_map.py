"""Tasks by a scheduler and two workers: what comes back, what is set aside, what is refused."""

from __future__ import annotations

import math
import os
import subprocess
import sys
import time
from contextlib import suppress
from functools import partial
from pathlib import Path

import cluster_tasks as tasks
import pandas as pd
import pytest

from tire_pipeline.cluster.dask_map import check_address, dask_map
from tire_pipeline.cluster.parameters import ClusterParameters
from tire_pipeline.errors import DomainError, TirError
from tire_pipeline.files.packed import as_parquet
from tire_pipeline.retraining import Manifest, Store, difference, ingest
from tire_pipeline.retraining.scan import hash_together
from tire_pipeline.retraining.scan.hash_together import HashTogether
from tire_pipeline.retraining.scan.places import UNREADABLE
from tire_pipeline.retraining.stored_table.read_together import ReadTogether
from tire_pipeline.tasks import Labelled, LostTaskError, all_done, end_processes, in_processes, in_turn
from tire_pipeline.tir import read_tir

EXAMPLE = Path(__file__).resolve().parents[2] / "examples" / "tire.tir"


def test_every_result_comes_back_by_its_name(work):
    wanted = {str(n): partial(tasks.double, n) for n in range(50)}
    assert {n: d.result() for n, d in all_done(work, wanted, "counting").items()} == {
        n: d.result() for n, d in all_done(in_turn, wanted, "counting").items()
    }


@pytest.mark.parametrize("where", ["here", "processes", "cluster"])
def test_an_error_crosses_with_all_that_it_says(where, request):
    how = {"here": in_turn, "processes": in_processes(2)}
    chosen = how[where] if where in how else request.getfixturevalue("work")
    wanted = {"good": partial(tasks.double, 1), "bad": partial(tasks.fails, "a.tir")}
    done = all_done(chosen, wanted, "counting")
    assert done["good"].result() == 2
    error = done["bad"].error
    assert type(error) is TirError
    assert (error.line, str(error)) == (3, "a.tir:3: no tire -> mend it")


@pytest.fixture(params=["processes", "cluster"])
def any_work(request):
    return in_processes(2) if request.param == "processes" else request.getfixturevalue("work")


@pytest.fixture
def tried_once(any_work, monkeypatch):
    """The same, but in a process of its own a task is tried once: the last task left is tried three times."""
    monkeypatch.setattr("tire_pipeline.tasks.DEATHS", 1)
    return any_work


IN_LONG_ON_A_CLUSTER = pytest.mark.parametrize(
    "any_work", ["processes", pytest.param("cluster", marks=pytest.mark.long)], indirect=True
)
"""That a worker's death is found on a cluster, too, is shown by a task of its own."""


def test_a_worker_that_dies_is_replaced_and_all_is_done(any_work, tmp_path):
    wanted = {str(n): partial(tasks.dies_once, tmp_path / "once", n) for n in range(20)}
    assert sorted(d.result() for d in any_work(wanted, "counting")) == list(range(20))
    assert (tmp_path / "once").read_text()


def test_a_task_that_kills_its_worker_is_set_aside_by_its_name(tried_once, tmp_path):
    wanted = {str(n): partial(tasks.double, n) for n in range(20)}
    wanted["killer"] = partial(tasks.dies, tmp_path / "log")
    done = all_done(tried_once, wanted, "counting")
    assert [done[str(n)].result() for n in range(20)] == [2 * n for n in range(20)]
    assert isinstance(done["killer"].error, LostTaskError)
    assert "killer" in str(done["killer"].error)


def test_the_last_task_left_is_set_aside_if_it_kills_its_worker_and_does_not_end_the_run(any_work, tmp_path):
    """What a run before has set aside may be all that is left to do."""
    wanted = {"killer": partial(tasks.dies_elsewhere, tmp_path / "log", os.getpid())}
    done = all_done(any_work, wanted, "counting")
    assert isinstance(done["killer"].error, LostTaskError)
    assert (tmp_path / "log").read_text().startswith("xxx")


def _reading(*names: str) -> dict:
    return {name: partial(read_tir, EXAMPLE) for name in names}


@IN_LONG_ON_A_CLUSTER
def test_the_one_killer_of_a_block_is_found_and_the_others_are_done(tried_once, tmp_path):
    killing = _reading("a", "b") | {"killer": partial(tasks.dies, tmp_path / "log")} | _reading("c")
    wanted = {"one": ReadTogether(killing), "other": ReadTogether(_reading("d", "e"))}
    one, other = (done.result() for done in all_done(tried_once, wanted, "reading").values())
    assert [(each.name, each.value) for each in one.done if not each.error] == [(n, True) for n in "abc"]
    (killer,) = [each for each in one.done if each.error]
    assert killer.name == "killer"
    assert isinstance(killer.error, LostTaskError)
    pd.testing.assert_frame_equal(one.table, ReadTogether(_reading("a", "b", "c"))().table)
    assert list(other.table["file"]) == ["d", "e"]


def test_a_block_is_what_its_files_are():
    more = {"fails": partial(tasks.fails, "b"), "changed": tasks.gone}
    block = ReadTogether(_reading("b") | more | _reading("a"))
    joined, whole = block.join([part() for part in block.split().values()]), block()
    said = [[(each.name, each.value, str(each.error)) for each in read.done] for read in (joined, whole)]
    assert said[0] == said[1]
    assert [value for _, value, _ in said[0]] == [True, None, False, True]
    assert whole.failures == {"fails": "b:3: no tire -> mend it"}
    pd.testing.assert_frame_equal(joined.table, whole.table)
    assert list(whole.table["file"]) == ["a", "b"]


@IN_LONG_ON_A_CLUSTER
def test_the_one_file_that_kills_while_it_is_hashed_is_found(tried_once, tmp_path):
    names = ["a", "b", "killer", "c"]
    block = HashTogether(tasks.KillingPlace(tmp_path / "log"), names)
    (done,) = tried_once({"a": block}, "hashing")
    assert list(done.result()) == names
    assert done.result()["killer"].startswith(UNREADABLE)
    assert [done.result()[name] for name in "abc"] == ["hash of a", "hash of b", "hash of c"]


def test_a_folder_is_taken_up_the_same_wherever_it_is_hashed_and_read(any_work, tmp_path, monkeypatch):
    monkeypatch.setattr(hash_together, "FILES_HASHED", 3)
    content = EXAMPLE.read_bytes()
    for number in range(8):
        (tmp_path / f"{number}.tir").write_bytes(content + b"$ %d\n" % number)
    known, _ = ingest(Store(), tmp_path, difference(tmp_path, Manifest(), settle_seconds=0.0))
    (tmp_path / "1.tir").write_bytes(content)
    (tmp_path / "2.tir").touch()
    (tmp_path / "3.tir").unlink()
    (tmp_path / "new.tir").write_bytes(content + b"$ new\n")
    (tmp_path / "bad.tir").write_bytes(b"no tire")
    taken = []
    for work in (in_turn, any_work):
        found = difference(tmp_path, known.manifest, settle_seconds=0.0, work=work)
        assert (set(found.added), set(found.changed)) == ({"new.tir", "bad.tir"}, {"1.tir"})
        assert (found.removed, set(found.touched)) == (["3.tir"], {"2.tir"})
        store, report = ingest(known, tmp_path, found, work=work)
        taken.append((found, store.manifest.to_json(), as_parquet(store.table), report.to_csv()))
    assert taken[0] == taken[1]


def test_processes_wait_for_more_tasks_until_they_are_ended():
    def used() -> set[int]:
        wanted = {str(number): os.getpid for number in range(4)}
        return {done.result() for done in in_processes(2)(wanted, "asking")}

    first = used()
    assert all(Path(f"/proc/{pid}").exists() for pid in first)
    end_processes()
    assert not any(Path(f"/proc/{pid}").exists() for pid in first)
    assert used().isdisjoint(first)


_RUN = """
import os, time
from functools import partial
from tire_pipeline.tasks import in_processes

work = in_processes(2)
used = {done.result() for done in work({str(n): os.getpid for n in range(8)}, "asking")}
print(*used, flush=True)
list(work({str(n): partial(time.sleep, 60.0) for n in range(2)}, "sleeping"))
"""
_GONE = """
import os, subprocess, sys, time
from tire_pipeline.tasks import _end_with

ended = subprocess.Popen([sys.executable, "-c", ""])
ended.wait()
_end_with(ended.pid)
time.sleep(60.0)
"""


def _lives(pid: str) -> bool:
    with suppress(OSError):
        return Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()[0] != "Z"
    return False


def test_processes_end_with_a_run_that_is_killed():
    """They finished their tasks, then stayed for over six minutes with half a gigabyte each."""
    with subprocess.Popen([sys.executable, "-c", _RUN], stdout=subprocess.PIPE, text=True) as run:
        used = run.stdout.readline().split()
        assert used
        assert all(map(_lives, used))
        run.kill()
    deadline = time.monotonic() + 20.0
    while any(map(_lives, used)) and time.monotonic() < deadline:
        time.sleep(0.1)
    assert not any(map(_lives, used))


def test_a_process_ends_whose_run_was_gone_before_it_began():
    """It waited for ever for its result to be taken."""
    assert subprocess.run([sys.executable, "-c", _GONE], check=False, timeout=30.0).returncode == 1


def test_one_thread_wherever_it_is_done(work):
    wanted = {"sum": partial(math.fsum, [0.1] * 10)}
    assert all_done(work, wanted, "adding")["sum"].result() == 1.0


def test_the_dashboard_has_the_name_of_each_recording_in_one_group(work):
    from dask.utils import key_split

    wanted = {f"{n}.zip": Labelled(name, tasks.key) for n, name in enumerate(["rig-1/run.csv", "rig"])}
    keys = [done.result() for done in all_done(work, wanted, "explaining recordings").values()]
    assert [key.split("-", 2)[2] for key in keys] == ["rig-1/run.csv", "rig"]
    assert {key_split(key) for key in keys} == {"explaining_recordings"}


def test_nothing_listens_but_on_loopback(cluster, work):
    """What listens elsewhere would let others run code here."""
    import psutil

    every = [psutil.Process(each.pid) for each in (cluster.scheduler, cluster.workers)]
    every += [child for each in every for child in each.children(recursive=True)]
    found = [each for process in every for each in process.net_connections() if each.status == "LISTEN"]
    assert len(found) >= 5  # scheduler, nannies, workers
    assert {each.laddr.ip for each in found} == {"127.0.0.1"}


def test_a_scheduler_elsewhere_needs_tls(tmp_path):
    for address in ("tcp://10.0.0.1:8786", "10.0.0.1:8786", "tcp://example.org:8786", "tcp://0.0.0.0:1"):
        with pytest.raises(DomainError, match="another machine needs TLS"):
            check_address(ClusterParameters(scheduler=address))
    for address in ("tcp://127.0.0.1:8786", "tcp://[::1]:8786", "localhost:8786"):
        assert not check_address(ClusterParameters(scheduler=address))
    with pytest.raises(DomainError, match="tls_ca is not given"):
        check_address(ClusterParameters(scheduler="tls://10.0.0.1:8786"))
    files = {name: str(tmp_path / name) for name in ("tls_ca", "tls_certificate", "tls_key")}
    with pytest.raises(DomainError, match="tls_ca is not a file"):
        check_address(ClusterParameters(scheduler="tls://10.0.0.1:8786", **files))
    for file in files.values():
        open(file, "w").close()
    assert check_address(ClusterParameters(scheduler="tls://10.0.0.1:8786", **files))


def test_a_scheduler_that_goes_while_it_is_asked_for_its_workers_is_told(work, monkeypatch):
    def gone(_):
        raise OSError("Connection reset by peer")

    monkeypatch.setattr("distributed.Client.nthreads", gone)
    with pytest.raises(DomainError, match="the Dask scheduler does not answer any more"):
        list(work({"1": partial(tasks.double, 1)}, "counting"))


def test_where_nothing_answers_a_run_says_so():
    pytest.importorskip("distributed")
    from dask_processes import free_port

    address = f"tcp://127.0.0.1:{free_port()}"
    with pytest.raises(DomainError, match="no Dask scheduler answers") as found:
        dask_map(ClusterParameters(scheduler=address, wait_seconds=1))
    assert address in str(found.value)
    assert "make cluster" in str(found.value)
    assert os.environ.get("DASK_SCHEDULER_ADDRESS") is None
