"""``make audit``: clean, vulnerable, not run and stale are told apart; without a network."""

from __future__ import annotations

import datetime
import importlib.util
import json
import os
import subprocess
import sys
import zipfile
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
FILE = ROOT / "tools" / "audit.py"
SPEC = importlib.util.spec_from_file_location("audit", FILE)
TOOL = importlib.util.module_from_spec(SPEC)
sys.modules["audit"] = TOOL  # dataclasses look there
SPEC.loader.exec_module(TOOL)
TODAY = datetime.datetime(2026, 11, 24, 12, 0, 0, 500000, tzinfo=datetime.UTC)  # advisories end in .123 s
LOCK = "# pinned\nJinja2==3.1.6\nnumpy==2.4.0rc1 --hash=sha256:00\n\nkedro-viz==12.5.0  # why\n"


def record(
    package: str, *, days: int = 3, ecosystem: str = "PyPI", name: str = "PYSEC-1", **affected
) -> dict:
    moment = (TODAY - datetime.timedelta(days=days)).strftime("%Y-%m-%dT%H:%M:%S.123456789Z")
    concerned = {"package": {"name": package, "ecosystem": ecosystem}, **affected}
    return {"id": name, "modified": moment, "summary": "made up", "affected": [concerned]}


def between(*events: dict[str, str], kind: str = "ECOSYSTEM") -> dict:
    return {"ranges": [{"type": kind, "events": list(events)}]}


def run(folder: Path, *records: dict, lock: str = LOCK, place: Path | None = None) -> tuple[int, str]:
    (folder / "requirements.lock").write_text(lock)
    if place is None:
        place = folder / "advisories"
        place.mkdir()
        for i, each in enumerate(records):
            (place / f"{i}.json").write_text(json.dumps(each))
    code, lines = TOOL.audit(folder / "requirements.lock", place, TODAY)
    return code, "\n".join(lines)


OTHER = record("jinja2", name="PYSEC-0", **between({"introduced": "0"}, {"fixed": "2.0"}))


@pytest.mark.parametrize(
    ("affected", "code"),
    [
        (between({"introduced": "0"}, {"fixed": "3.1.6"}), 0),
        (between({"introduced": "0"}, {"fixed": "3.1.7"}), 1),
        (between({"introduced": "0"}), 1),
        (between({"introduced": "3.1.7"}), 0),
        (between({"introduced": "0"}, {"last_affected": "3.1.5"}), 0),
        (between({"introduced": "0"}, {"last_affected": "3.1.6"}), 1),
        (between({"fixed": "2"}, {"introduced": "0"}, {"introduced": "3"}, {"fixed": "3.2"}), 1),
        (between({"introduced": "0"}, {"fixed": "2"}, {"introduced": "4"}), 0),
        ({"versions": ["3.1.5", "3.1.6.0"]}, 1),
        ({"versions": ["3.1.5", "not one"]}, 0),
        (between({"introduced": "0"}, {"fixed": "abc"}), 1),  # cannot be told
        (between({"introduced": "0"}, kind="GIT"), 1),  # cannot be told
    ],
)
def test_an_advisory_concerns_the_versions_that_it_names(tmp_path, affected, code):
    found, said = run(tmp_path, record("jinja2", **affected))
    assert found == code, said
    assert said.splitlines()[-1].startswith(("clean: ", "vulnerable: ")[code])
    assert ("jinja2 3.1.6: PYSEC-1" in said) == bool(code)


def test_names_are_compared_as_pip_does_and_pre_releases_count(tmp_path):
    spelt = record("Kedro_Viz", **between({"introduced": "0"}, {"fixed": "13"}))
    early = record("numpy", name="PYSEC-2", **between({"introduced": "0"}, {"fixed": "2.4.0"}))
    code, said = run(tmp_path, spelt, early)
    assert code == 1
    assert "kedro-viz 12.5.0: PYSEC-1: made up" in said
    assert "numpy 2.4.0rc1: PYSEC-2" in said


def test_withdrawn_advisories_and_those_on_other_languages_do_not_count(tmp_path):
    everything = between({"introduced": "0"})
    withdrawn = {**record("jinja2", **everything), "withdrawn": "2026-01-01T00:00:00Z"}
    assert run(tmp_path, withdrawn, record("jinja2", ecosystem="npm", **everything), OTHER)[0] == 0


def test_a_record_that_names_no_package_does_not_stop_the_others(tmp_path):
    """OSV allows a record without ``affected``; the audit took the whole database for something else."""
    without = {name: value for name, value in OTHER.items() if name != "affected"}
    assert run(tmp_path, without, OTHER)[0] == 0


def test_over_90_days_is_stale_and_what_it_finds_is_said_all_the_same(tmp_path):
    old = {**OTHER, "modified": record("x", days=91)["modified"]}
    code, said = run(tmp_path, old)
    assert code == 3
    assert said.startswith("stale: ")
    assert "91 days" in said
    hit = record("jinja2", days=400, **between({"introduced": "0"}))
    (tmp_path / "hit.json").write_text(json.dumps(hit))
    code, said = run(tmp_path, place=tmp_path / "hit.json")
    assert code == 1
    assert "400 days ago" in said
    new = {**OTHER, "modified": record("x", days=90)["modified"]}
    (tmp_path / "new.json").write_text(json.dumps(new))
    assert run(tmp_path, place=tmp_path / "new.json")[0] == 0


def test_a_zip_as_osv_gives_it_and_the_database_of_a_package(tmp_path):
    with zipfile.ZipFile(tmp_path / "all.zip", "w") as archive:
        archive.writestr("PYSEC-1.json", json.dumps(record("jinja2", **between({"introduced": "3"}))))
    assert run(tmp_path, place=tmp_path / "all.zip")[0] == 1
    told = {"advisory": "made up", "id": "pyup.io-1", "cve": None, "specs": ["<2", ">=3.1,<3.1.7"]}
    safety = {"$meta": {"timestamp": TODAY.timestamp()}, "Jinja2": [told], "flask": [told]}
    (tmp_path / "insecure_full.json").write_text(json.dumps(safety))
    code, said = run(tmp_path, place=tmp_path / "insecure_full.json")
    assert code == 1
    assert said.startswith("jinja2 3.1.6: pyup.io-1: made up\nvulnerable: 1 findings in 3 versions")


@pytest.mark.parametrize(
    ("content", "said"),
    [
        (None, "cannot be read"),
        ("{", "no advisory database"),
        ("PK\x03\x04 and no more", "no whole zip archive -> fetch it again"),
        ("[]", "neither OSV nor Safety DB"),
        ('{"a": 1}', "neither OSV nor Safety DB"),
        (json.dumps(record("jinja2", ecosystem="npm")), "no advisory on a Python package"),
        (json.dumps(record("jinja2", days=-30)), "in the future"),
    ],
)
def test_what_is_no_database_is_not_run(tmp_path, content, said):
    place = tmp_path / "given.json"
    if content is not None:
        place.write_text(content)
    code, told = run(tmp_path, place=place)
    assert code == 2
    assert told.startswith("not run: ")
    assert said in told


@pytest.mark.parametrize("line", ["jinja2>=3", "jinja2", "-e .", "jinja2==3.*"])
def test_a_line_that_pins_nothing_is_not_run(tmp_path, line):
    code, said = run(tmp_path, OTHER, lock=f"{LOCK}{line}\n")
    assert code == 2
    assert "requirements.lock:6" in said


def test_without_any_database_it_says_so(tmp_path, monkeypatch):
    monkeypatch.setitem(sys.modules, "safety_db", None)
    (tmp_path / "requirements.lock").write_text(LOCK)
    code, lines = TOOL.audit(tmp_path / "requirements.lock", None, TODAY)
    assert code == 2
    assert lines == [
        "not run: there is no advisory database -> make audit ADVISORIES=all.zip (docs/how-to/audit.md)"
    ]


def test_the_project_s_own_lock_is_read_and_the_exit_code_is_that_of_the_process(tmp_path):
    (tmp_path / "old.json").write_text(json.dumps({**OTHER, "modified": "2020-01-01T00:00:00Z"}))
    command = [sys.executable, str(FILE), "--advisories", str(tmp_path / "old.json")]
    done = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=False)
    assert done.returncode == 3, done.stderr
    count = sum("==" in line for line in (ROOT / "requirements.lock").read_text().splitlines())
    assert done.stdout.startswith(f"stale: nothing found in {count} versions, 1 advisories")


def environment(folder: Path, pip: int) -> Path:
    """An environment of the audit whose pip installs nothing and ends with this code."""
    python = folder / "audit" / "bin" / "python"
    python.parent.mkdir(parents=True)
    python.write_text(
        f'#!/bin/sh\n[ "$1" = -m ] && exit {pip}\n[ "$1" = -c ] && exit 0\nexec {sys.executable} "$@"\n'
    )
    python.chmod(0o755)
    return folder


def ended(*command: str, **variables: str) -> subprocess.CompletedProcess[str]:
    here = {**os.environ, **variables}
    return subprocess.run(command, cwd=ROOT, env=here, capture_output=True, text=True, check=False)


NONE_HIT, ALL_HIT = between({"introduced": "0"}, {"fixed": "2"}), between({"introduced": "0"})


@pytest.mark.parametrize(
    ("affected", "old", "pip", "code", "outcome"),
    [
        (NONE_HIT, False, 0, 0, "clean"),
        (ALL_HIT, False, 0, 1, "vulnerable"),
        (NONE_HIT, False, 1, 2, "not run"),
        (None, False, 0, 2, "not run"),
        (NONE_HIT, True, 0, 3, "stale"),
    ],
)
def test_a_user_can_tell_the_outcomes_apart(tmp_path, affected, old, pip, code, outcome):
    """By the code of tools/audit.sh; by the last line, and the code that make prints, of make audit."""
    given = tmp_path / "given.json"
    modified = "2020-01-01T00:00:00Z" if old else datetime.datetime.now(datetime.UTC).isoformat()
    if affected is not None:
        given.write_text(json.dumps({**record("jinja2", **affected), "modified": modified}))
    here = {"VENV": str(environment(tmp_path, pip))}
    done = ended("tools/audit.sh", str(given), **here)
    assert done.returncode == code, done.stderr
    made = ended("make", "--no-print-directory", "audit", f"VENV={here['VENV']}", f"ADVISORIES={given}")
    for said in (done.stdout, made.stdout):
        assert said.splitlines()[-1].startswith(f"{outcome}: ")
    assert made.returncode == (2 if code else 0)
    assert f"Error {code}" in made.stderr or code == 0


def test_an_environment_whose_making_was_interrupted_is_made_again(tmp_path):
    """It has no pip: the audit said *not run* from then on."""
    whole = environment(tmp_path / "whole", 0) / "audit"
    half = environment(tmp_path, 0) / "audit" / "bin" / "python"
    half.write_text("#!/bin/sh\nexit 1\n")
    maker = tmp_path / "python3"
    maker.write_text(f'#!/bin/sh\n[ "$*" = "-m venv --clear {half.parents[1]}" ] && cp -r {whole}/. "$4"\n')
    maker.chmod(0o755)
    given = tmp_path / "given.json"
    now = datetime.datetime.now(datetime.UTC).isoformat()
    given.write_text(json.dumps({**record("jinja2", **NONE_HIT), "modified": now}))
    done = ended("tools/audit.sh", str(given), VENV=str(tmp_path), PYTHON=str(maker))
    assert (done.returncode, done.stdout.splitlines()[-1][:6]) == (0, "clean:")
