"""Add, change, remove, rename, link, corrupt, kill, retrain and roll back in any order.

Nothing is lost, nothing is counted twice, no run ends in a traceback.
"""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
import tempfile
import time
from functools import partial
from pathlib import Path

import pandas as pd
import pytest
from changing_data import CLOSED, ENTERED, LISTED, ORGANISATIONS, ChangingData
from hypothesis import HealthCheck, settings
from hypothesis import strategies as st
from hypothesis.stateful import (
    RuleBasedStateMachine,
    initialize,
    invariant,
    precondition,
    rule,
    run_state_machine_as_test,
)

from tire_pipeline.errors import DomainError
from tire_pipeline.kedro_runs.run_errors import one_line

pytestmark = pytest.mark.slow

ROOT = Path(__file__).resolve().parents[2]
FEW = ",dedupe_filter.minimum_per_category=2"
NAMES = st.sampled_from(["plain", "latin", "control", "escape", "long"])
ORGANISATION = st.sampled_from(ORGANISATIONS)
DATE = st.sampled_from([None, 0.0, -86400.0, 1.0, 2.0**33])
NUMBER = st.integers(0, 10**6)
KIND = st.sampled_from(["fifo", "socket", "device"])
RIGHTS = st.sampled_from([CLOSED, LISTED, ENTERED])
BAD = st.sampled_from([b"", b"no tire", bytes(range(256)), b"[MODEL]\nFITTYP = 6\n"])
LINKS = st.sampled_from(
    [
        "itself",
        "nowhere",
        "above",
        "the folder",
        "its own folder",
        "a closed folder",
        "a file",
        "a file in a closed folder",
    ]
)


class Machine(RuleBasedStateMachine):
    steps = 0

    @initialize()
    def begin(self):
        self.folder = Path(tempfile.mkdtemp(prefix="changing-"))
        self.data = ChangingData(self.folder / "data")
        self.book = self.data.book
        self.runs = 0
        self.killed: list[str] = []
        self.good_models = True

    def _pick(self, files, number):
        return sorted(files)[number % len(files)]

    def _version(self) -> str:
        self.runs += 1
        return f"v{self.runs:04d}"

    @rule(kind=NAMES, organisation=ORGANISATION, date=DATE, elsewhere=st.booleans(), inner=st.booleans())
    def add(self, kind, organisation, date, elsewhere, inner):
        folder = f"{organisation}/inner" if inner else organisation
        if elsewhere or folder in self.book.closed:
            inner = False
        name = self.data.name(kind)
        name = name if elsewhere else f"{folder if inner else organisation}/{name}"
        self.data.write(name, self.data.text(organisation), good=True, date=date, elsewhere=elsewhere)

    @rule(kind=NAMES, organisation=ORGANISATION, number=NUMBER)
    def copy(self, kind, organisation, number):
        content, good = self.book.files[self._pick(self.book.free(), number)]
        self.data.write(
            f"{organisation}/{self.data.name(kind)}", content, good=good, date=None, elsewhere=False
        )

    @rule(number=NUMBER, organisation=ORGANISATION, date=DATE)
    def change(self, number, organisation, date):
        name = self._pick(self.book.free(), number)
        self.data.write(name, self.data.text(organisation), good=True, date=date, elsewhere=False)

    @rule(number=NUMBER, content=BAD, date=DATE)
    def corrupt(self, number, content, date):
        name = self._pick(self.book.free(), number)
        self.data.write(name, content, good=False, date=date, elsewhere=False)

    @precondition(lambda self: len(self.book.free()) > 8)
    @rule(number=NUMBER)
    def remove(self, number):
        self.data.remove(self._pick(self.book.free(), number), elsewhere=False)

    @precondition(lambda self: self.book.outside)
    @rule(number=NUMBER)
    def remove_elsewhere(self, number):
        self.data.remove(self._pick(self.book.outside, number), elsewhere=True)

    @precondition(lambda self: len(self.book.free()) > 8)
    @rule(number=NUMBER, kind=KIND)
    def replace_by_no_regular_file(self, number, kind):
        self.data.no_regular_file(self._pick(self.book.free(), number), kind)

    @rule(number=NUMBER)
    def take_the_rights_of_a_file(self, number):
        self.data.take_rights(self._pick(self.book.free(), number))

    @precondition(lambda self: self.book.unreadable & self.book.free())
    @rule(number=NUMBER)
    def give_them_back(self, number):
        self.data.let_read(self._pick(self.book.unreadable & self.book.free(), number))

    @rule(organisation=ORGANISATION, rights=RIGHTS)
    def close_a_folder(self, organisation, rights):
        folder = f"{organisation}/inner"
        if folder not in self.book.closed:
            (self.data.tir / folder).mkdir(exist_ok=True)
            self.data.close(folder, rights)

    @precondition(lambda self: self.book.closed)
    @rule(number=NUMBER)
    def reopen_a_folder(self, number):
        self.data.reopen(self._pick(self.book.closed, number))

    @rule(number=NUMBER, kind=NAMES, organisation=ORGANISATION)
    def rename(self, number, kind, organisation):
        old = self._pick(self.book.free(), number)
        self.data.rename(old, f"{organisation}/{self.data.name(kind)}")

    @rule(circle=LINKS, kind=NAMES, organisation=ORGANISATION, number=NUMBER)
    def link_in_circles(self, circle, kind, organisation, number):
        name = f"{organisation}/{self.data.name(kind)}"
        closed = set(self.book.files) - self.book.free()
        to = {
            "itself": Path(name).name,
            "nowhere": "absent.tir",
            "above": "../../..",
            "the folder": self.data.tir,
            "its own folder": ".",
            "a closed folder": self.data.tir / self._pick(self.book.closed or {"absent"}, number),
            "a file": self.data.tir / self._pick(self.book.free(), number),
            "a file in a closed folder": self.data.tir / self._pick(closed or {"absent.tir"}, number),
        }
        self.data.link(name, to[circle])

    @rule(kind=NAMES, organisation=ORGANISATION)
    def link_elsewhere(self, kind, organisation):
        name = f"{organisation}/{self.data.name(kind)}"
        self.data.link(name, self.data.elsewhere)
        self.book.folder_links.add(name)

    @precondition(lambda self: self.book.outside)
    @rule(kind=NAMES, organisation=ORGANISATION, number=NUMBER)
    def link_a_file_elsewhere(self, kind, organisation, number):
        name, target = f"{organisation}/{self.data.name(kind)}", self._pick(self.book.outside, number)
        self.data.link(name, self.data.elsewhere / target)
        self.book.file_links[name] = target

    @precondition(lambda self: self.book.folder_links)
    @rule(number=NUMBER)
    def unlink_elsewhere(self, number):
        name = self._pick(self.book.folder_links, number)
        (self.data.tir / name).unlink()
        self.book.folder_links.remove(name)

    @rule()
    def retrain(self):
        self._retrain(self.data.retrain)

    @rule(number=NUMBER, organisation=ORGANISATION, before=st.booleans())
    def retrain_while_a_new_file_grows(self, number, organisation, before):
        name = self._pick(self.book.free(), number)
        self.data.write(name, self.data.text(organisation), good=True, date=None, elsewhere=False)
        self._retrain(
            partial(self.data.retrain_while_a_file_grows, name=name, before=before),
            "" if before else name,
        )

    def _retrain(self, run, grows=""):
        before = self.data.registry().release
        try:
            run(self._version())
        except Exception as error:
            if not one_line(error):  # a traceback; others say that there is no model, nothing to train on...
                raise
            assert self.data.registry().release == before
        self.book.rows = self.book.rows_after_a_run(grows)
        assert self.data.agrees(self.book.rows)

    @rule(step=st.integers(0, 14))
    def retrain_and_be_killed(self, step):
        version = self._version()
        if self.data.retrain_and_be_killed(version, step):
            self.killed.append(version)
        after = self.book.rows_after_a_run()
        if self.data.agrees(after):  # as before the run, or as after it: nothing in between
            self.book.rows = after
        else:
            assert self.data.agrees(self.book.rows)

    @rule()
    def roll_back(self):
        registry = self.data.registry()
        whole = [name for name in registry.release.models[:-1] if name not in registry.unusable]
        if whole:
            self.data.roll_back()
            assert self.data.registry().release.current == whole[-1]
            assert self.data.released.load().model is not None
        else:
            with pytest.raises(DomainError, match=r"no earlier model|no model left"):
                self.data.roll_back()

    @precondition(lambda self: self.data.registry().release.current)
    @rule(gone=st.booleans())
    def lose_the_model_in_use(self, gone):
        path = self.data.model_file(self.data.registry().release.current)
        if gone or not path.exists():
            path.unlink(missing_ok=True)
        else:
            path.write_bytes(path.read_bytes()[:-25])

    @precondition(lambda self: self.data.registry().unusable)
    @rule()
    def begin_anew(self):
        shutil.rmtree(self.data.base / "06_models/released")

    @invariant()
    def files_of_the_user_are_as_they_were(self):
        Machine.steps += 1
        for folder, files in (
            (self.data.tir, self.book.files),
            (self.data.elsewhere, self.book.outside),
        ):
            for name, (content, _) in files.items():
                if os.geteuid() != 0 and (name in self.book.unreadable or self.book.in_closed(name)):
                    continue  # looked at as soon as it can be read again
                assert (folder / name).read_bytes() == content

    def teardown(self):
        if not hasattr(self, "folder"):
            return
        for folder in list(self.book.closed):
            self.data.reopen(folder)
        self.retrain()
        assert not [v for v in self.killed if list(self.data.base.rglob(f"*/{v}"))]
        assert not list((self.data.base / ".runs").glob("*.json"))
        assert not list(self.data.base.rglob("*.part"))
        shutil.rmtree(self.folder)


COMMON = {"deadline": None, "suppress_health_check": list(HealthCheck), "derandomize": True, "database": None}


@pytest.mark.parametrize("rights", [CLOSED, LISTED, ENTERED])
def test_sockets_lost_rights_and_files_that_grow(rights):
    """What a fixed part of the steps may not draw, one after the other."""
    machine = Machine()
    machine.begin()
    for organisation in ORGANISATIONS:
        machine.add("plain", organisation, None, elsewhere=False, inner=True)
    for kind in ("fifo", "socket", "device"):
        machine.replace_by_no_regular_file(3, kind)
    machine.retrain()
    machine.close_a_folder("A", rights)
    machine.take_the_rights_of_a_file(1)
    machine.link_in_circles("a file in a closed folder", "plain", "B", 0)
    machine.retrain_while_a_new_file_grows(2, "B", before=False)
    machine.reopen_a_folder(0)
    machine.give_them_back(0)
    machine.retrain_while_a_new_file_grows(2, "B", before=True)
    machine.files_of_the_user_are_as_they_were()
    machine.teardown()


def test_a_fixed_part_of_the_random_steps():
    run_state_machine_as_test(Machine, settings=settings(max_examples=2, stateful_step_count=30, **COMMON))


@pytest.mark.long
def test_two_thousand_random_steps():
    Machine.steps = 0
    begun = time.monotonic()
    run_state_machine_as_test(Machine, settings=settings(max_examples=60, stateful_step_count=50, **COMMON))
    print(f"{Machine.steps} steps in {time.monotonic() - begun:.0f} s")
    assert Machine.steps >= 2000


@pytest.fixture
def pipeline(tmp_path):
    """Data that change, and ``kedro run`` in it as cron starts it."""
    shutil.copytree(ROOT / "conf", tmp_path / "conf")
    data = tmp_path / "data"
    (tmp_path / "conf/small/globals.yml").write_text(f"data: {data}\ntir_folder: {data}/01_raw/tir\n")

    def kedro(name: str) -> str:
        command = [sys.executable, "-m", "kedro", "run", "--env", "small", "--pipeline", name]
        parameters = (
            "retrain.settle_seconds=0,retrain.most_removed_share=1.0,ingest_tir.most_failed_share=1.0"
        )
        done = subprocess.run(
            [*command, "--conf-source", str(tmp_path / "conf"), "--params", parameters + FEW],
            cwd=ROOT,
            env={**os.environ, "OMP_NUM_THREADS": "1"},
            capture_output=True,
            text=True,
            check=False,
            timeout=600,
        )
        said = done.stdout + done.stderr
        assert "Traceback" not in said, said
        assert done.returncode == 0, said
        return said

    changing = ChangingData(data)
    for name in ("1.tir", "2.tir"):
        changing.write(name, changing.text("D"), good=True, date=None, elsewhere=True)
    return changing, kedro


@pytest.mark.long
def test_the_whole_pipeline_on_data_that_change(pipeline):
    changing, kedro = pipeline
    book = changing.book
    for kind in ("plain", "latin", "control", "escape", "long"):
        changing.write(f"A/{changing.name(kind)}", changing.text("A"), good=True, date=0.0, elsewhere=False)
        changing.write(f"B/{changing.name(kind)}", b"no tire", good=False, date=None, elsewhere=False)
        changing.link(f"D/{changing.name(kind)}", changing.elsewhere)
        changing.link(f"D/{changing.name(kind)}", "absent.tir")
        changing.link(f"D/{changing.name(kind)}", ".")
        os.mkfifo(changing.tir / "D" / changing.name(kind))
    changing.link("D/self.tir", "self.tir")
    book.folder_links.add("all of them")
    kedro("retrain")
    book.rows = book.rows_after_a_run()
    assert changing.agrees(book.rows)
    first = changing.registry().release.current

    for name in [name for name, (_, good) in book.files.items() if good][::3]:
        changing.write(name, changing.text("A"), good=True, date=None, elsewhere=False)
    for name in list(book.files)[::4]:
        changing.rename(name, f"B/{changing.name('latin')}")
    for name in list(book.files)[1::4]:
        changing.write(name, b"spoiled", good=False, date=None, elsewhere=False)
    changing.remove("1.tir", elsewhere=True)
    kedro("retrain")
    book.rows = book.rows_after_a_run()
    assert changing.agrees(book.rows)
    kedro("ingest_tir")
    counts = pd.read_csv(changing.base / "08_reporting/tables/ingest_report.csv").groupby("status").size()
    assert counts["read"] == sum(good for _, good in book.reached().values())

    second = changing.registry().release.current
    assert second != first
    changing.model_file(second).unlink()
    kedro("rollback")
    assert changing.registry().release.current == first
