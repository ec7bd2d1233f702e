"""What can go wrong: one clear line, an exit code, and nothing that a later run would trust."""

from __future__ import annotations

import os
import shutil
import signal
import subprocess
import sys
import time
from pathlib import Path
from types import SimpleNamespace

import pytest
from conftest_kedro import ROOT, kedro, kedro_here, small_conf
from kedro.config import OmegaConfigLoader

from tire_pipeline.errors import DomainError
from tire_pipeline.kedro_runs.unknown_parameters import UnknownParameterHooks
from tire_pipeline.settings import CONFIG_LOADER_ARGS

pytestmark = pytest.mark.slow
INGEST = ("--pipelines", "ingest_tir,dedupe_filter")


def _one_line(done: subprocess.CompletedProcess[str]) -> str:
    assert done.returncode != 0, done.stdout
    lines = [line for line in done.stderr.splitlines() if line.startswith("error: ")]
    assert len(lines) == 1, done.stdout + done.stderr
    assert "Traceback" not in done.stdout + done.stderr
    return lines[0]


def _folder(tmp_path: Path, fleet: Path, *categories: str) -> Path:
    """The first files of some categories: more of them than are needed."""
    for name in categories:
        place = tmp_path / "data/01_raw/tir" / name
        place.mkdir(parents=True)
        for path in sorted((fleet / "data/01_raw/tir" / name).iterdir())[:40]:
            shutil.copy(path, place)
    return tmp_path


COMPUTED = "tir_blocks"
"""Parts that are named by all that they depend on: a later run may trust them."""


def _versions(folder: Path) -> list[Path]:
    data = folder / "data"
    return [p for p in data.rglob("*") if p.is_file() and not {"01_raw", ".runs", COMPUTED} & set(p.parts)]


def test_an_empty_folder(tmp_path):
    line = _one_line(kedro_here(tmp_path))
    assert "there are no .tir files" in line
    assert "make_fleet" in line
    assert _versions(tmp_path) == []


def test_a_data_folder_whose_path_reads_as_a_pattern_is_told_before_anything_is_written(tmp_path):
    folder = tmp_path / "files [1]"
    conf = small_conf(folder).rename(tmp_path / "conf")
    done = kedro_here(tmp_path, "--pipeline", "ingest_tir")
    assert done.returncode == 1
    assert "files [1]/data: the path of the data folder holds *, ? or [" in done.stdout + done.stderr
    assert not list(folder.iterdir())
    conf.rename(folder / "conf")
    done = kedro_here(folder, "--pipeline", "ingest_tir")
    assert "whose path must not hold *, ? or [" in done.stdout + done.stderr


def test_one_category_only(tmp_path, small_fleet):
    line = _one_line(kedro_here(_folder(tmp_path, small_fleet, "D"), *INGEST))
    assert "two categories are needed" in line
    assert "node 'files.keep_usable' failed" in line
    assert _versions(tmp_path) == []


def test_no_target_category(tmp_path, small_fleet):
    line = _one_line(kedro_here(_folder(tmp_path, small_fleet, "A", "B"), *INGEST))
    assert "'D' has no usable files" in line
    assert "set target_category" in line


def test_results_of_a_run_whose_clock_was_ahead_are_replaced(tmp_path, small_fleet):
    """They bear the last name for weeks; "2 files were read" was said of a folder with one."""
    folder = _folder(tmp_path, small_fleet, "A")
    tires = sorted((folder / "data/01_raw/tir/A").iterdir())
    for path in tires[2:]:
        path.unlink()
    ingest = ("--pipeline", "ingest_tir")
    assert "2 of 2 files were read" in kedro_here(folder, *ingest).stdout
    for version in (folder / "data/02_intermediate").glob("*/20*Z"):
        version.rename(version.with_name("2100-01-01T00.00.00.000Z"))
    tires[0].unlink()
    assert "1 of 1 files were read" in kedro_here(folder, *ingest).stdout


def test_a_wrong_parameter_is_named_with_what_is_allowed(tmp_path):
    line = _one_line(kedro_here(tmp_path, "--params", "bin.method=equal_with"))
    assert "method" in line
    assert "equal_width" in line
    assert "equal_frequency" in line


def test_a_misspelt_parameter_is_named(tmp_path):
    assert "binz" in _one_line(kedro_here(tmp_path, "--params", "bin.binz=3"))


@pytest.mark.parametrize("value", ["[1", "{a", "*x", "\udce9"])
def test_a_parameter_that_cannot_be_read_is_told(tmp_path, value):
    done = kedro_here(tmp_path, "--params", f"translate.only={value}")
    assert done.returncode == 2
    assert "Invalid value for --params: " in done.stderr
    assert "-> correct it in conf or --params" in done.stderr


@pytest.mark.parametrize(("line", "said"), [("data: [1\n", "unable to read line"), ("data: ${x:y}\n", "x")])
def test_a_configuration_that_cannot_be_read_is_told(tmp_path, line, said):
    (small_conf(tmp_path) / "small" / "globals.yml").write_text(line)
    told = _one_line(kedro_here(tmp_path))
    assert said in told
    assert "-> correct it in conf or --params" in told


def test_a_misspelt_environment_is_named(tmp_path):
    line = _one_line(kedro_here(tmp_path, "--env", "smal"))
    assert (
        "--env: there is no environment 'smal' -> did you mean 'small'? there are base, cluster, small"
        in line
    )


@pytest.mark.parametrize("written", [[], ["README.md", "paramters.yml"]])
def test_an_environment_of_which_nothing_is_read_is_told(tmp_path, written):
    """The run took the base environment, without a word."""
    mine = small_conf(tmp_path) / "mine"
    mine.mkdir()
    for name in written:
        (mine / name).write_text("seed: 2\n")
    line = _one_line(kedro_here(tmp_path, "--env", "mine"))
    assert "conf/mine: the environment 'mine' is empty: no file in it is read" in line
    assert "there are base, cluster, small" in line
    (mine / "parameters.yml").write_text("seedd: 2\n")
    assert "did you mean 'seed'?" in _one_line(kedro_here(tmp_path, "--env", "mine"))


@pytest.mark.parametrize(
    ("option", "name"),
    [
        ("--pipeline", "ingest"),
        ("--pipelines", "ingest"),
        ("--pipeline", "story"),  # kedro-viz's alone
    ],
)
def test_a_misspelt_pipeline_is_named_with_those_there_are(tmp_path, option, name):
    line = _one_line(kedro_here(tmp_path, option, name))
    assert f"no pipeline '{name}'" in line
    assert ("did you mean 'ingest_tir'?" in line) == (name == "ingest")
    assert "ingest_tir" in line
    assert "translate" in line


def test_a_dataset_that_no_run_has_made_yet_says_what_to_run_first(tmp_path):
    line = _one_line(kedro_here(tmp_path, "--pipeline", "represent"))
    assert "normalized_table" in line
    assert "not there yet" in line
    assert "kedro run" in line


def test_a_binary_file_is_set_aside_and_the_run_goes_on(tmp_path, small_fleet):
    folder = _folder(tmp_path, small_fleet, "A", "B", "D", "E")
    (folder / "data/01_raw/tir/A/bad.tir").write_bytes(bytes(range(256)) * 20)
    done = kedro_here(folder, *INGEST)
    assert done.returncode == 0, done.stdout + done.stderr
    report = (folder / "data/08_reporting/tables/ingest_report.csv").read_text()
    assert [line for line in report.splitlines() if line.startswith("A/bad.tir,A,set aside")]


def test_files_of_the_user_stay_as_they_are(tmp_path, small_fleet):
    folder = _folder(tmp_path, small_fleet, "A", "D")
    files = {p: (p.read_bytes(), p.stat().st_mtime_ns) for p in folder.rglob("*.tir")}
    kedro_here(folder, *INGEST)
    refused = kedro_here(folder, "--pipeline", "make_fleet")
    assert "never overwritten" in _one_line(refused)
    assert {p: (p.read_bytes(), p.stat().st_mtime_ns) for p in folder.rglob("*.tir")} == files


@pytest.mark.skipif(os.geteuid() != 0, reason="needs root to mount a small disk")
def test_a_full_disk_leaves_nothing_behind(tmp_path, small_fleet):
    small_conf(tmp_path)
    folder = _folder(tmp_path, small_fleet, "A", "D")
    disk = folder / "data" / "02_intermediate"
    disk.mkdir()
    mounted = subprocess.run(["mount", "-t", "tmpfs", "-o", "size=48k", "tmpfs", disk], check=False)
    if mounted.returncode != 0:
        pytest.skip("no right to mount a small disk here")
    try:
        line = _one_line(kedro_here(folder, *INGEST))
        assert "disk is full" in line
        assert [p for p in disk.rglob("*") if p.is_file()] == []
    finally:
        subprocess.run(["umount", disk], check=True)


def test_a_killed_run_is_taken_back_by_the_next(tmp_path, small_fleet):
    conf = small_conf(tmp_path)
    folder = _folder(tmp_path, small_fleet, "A", "B", "D", "E")
    command = [sys.executable, "-m", "kedro", "run", "--env", "small", "--conf-source", str(conf)]
    running = subprocess.Popen(command, cwd=ROOT, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    written = folder / "data" / "04_feature"
    for _ in range(1200):
        if list(written.rglob("features.parquet/*/*")):
            break
        time.sleep(0.05)
    running.send_signal(signal.SIGKILL)
    running.wait()
    left = {p.parent.name for p in written.rglob("features.parquet") if p.is_file()}
    assert len(left) == 1
    done = kedro(folder, "--pipelines", "ingest_tir")
    assert done.returncode == 0, done.stdout + done.stderr
    assert "was killed" in done.stdout
    assert [p for p in _versions(folder) if left & set(p.parts)] == []
    assert list((folder / "data/.runs").glob("*.json")) == []


@pytest.mark.parametrize(
    ("asked", "said"),
    [
        ("tir_foldr=/x", "there is no parameter 'tir_foldr' -> did you mean 'tir_folder'?"),
        (
            "only=B",
            "there is no parameter 'only' -> did you mean 'explain_mismatch.only' or 'translate.only'?",
        ),
        ("translate.onli=B", "error: translate: there is no parameter 'onli': did you mean 'only'? ->"),
        ("translate.farthest=-1", "error: translate.farthest: Input should be greater than 0 (given: -1) ->"),
    ],
)
def test_a_wrong_parameter_is_one_line_that_names_it(tmp_path, asked, said):
    done = kedro_here(tmp_path, "--pipeline", "translate", "--params", asked)
    assert done.returncode == 1
    assert (done.stdout + done.stderr).count(said) == 1
    assert "pydantic.dev" not in done.stdout + done.stderr


@pytest.mark.parametrize(
    ("written", "text", "said"),
    [
        (
            "local/parameters.yml",
            "target_categry: A\n",
            "error: conf/local/parameters.yml: there is no parameter 'target_categry' -> "
            "did you mean 'target_category'?",
        ),
        (
            "local/parameters.yml",
            "tir_folder: /x\n",
            "-> give it on the command line: --params tir_folder=...",
        ),
        (
            "base/parameters/translate.yml",
            "translate: {only: []}\nonly: [B]\n",
            "did you mean 'explain_mismatch.only' or",
        ),
    ],
)
def test_a_name_that_nothing_knows_in_a_file_of_parameters_is_told(tmp_path, written, text, said):
    folder = shutil.copytree(ROOT / "conf", tmp_path / "conf") / written
    folder.write_text(text)
    loader = OmegaConfigLoader(str(tmp_path / "conf"), **CONFIG_LOADER_ARGS)
    with pytest.raises(DomainError) as told:
        UnknownParameterHooks().after_context_created(SimpleNamespace(config_loader=loader))
    assert said in f"error: {told.value}"


@pytest.mark.parametrize("environment", [None, "small", "cluster"])
def test_the_files_of_parameters_that_are_here_are_known(environment):
    loader = OmegaConfigLoader(str(ROOT / "conf"), env=environment, **CONFIG_LOADER_ARGS)
    UnknownParameterHooks().after_context_created(SimpleNamespace(config_loader=loader))
