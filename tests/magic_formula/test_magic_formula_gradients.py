"""The derivatives' code is written when it is first asked for, wherever the package lies."""

import importlib.util
import json
import os
import shutil
import subprocess
import sys
import zipfile
from pathlib import Path

import numpy as np
import pytest
from magic_formula_tires import tire_52

import tire_pipeline
from tire_pipeline.channels import FORCE_CHANNELS
from tire_pipeline.magic_formula.derivatives import derive, gradients
from tire_pipeline.magic_formula.derivatives.gradients import gradients_of

ROOT = Path(__file__).parents[2]
PLACE = "tire_pipeline/magic_formula/derivatives"
CODE = (
    "import json; from magic_formula_tires import tire_52\n"
    "from tire_pipeline.magic_formula.derivatives import gradients\n"
    "points = {'slip_angle': 0.05, 'camber': 0.02, 'normal_load': 3000.0}\n"
    "j = tire_52().jacobian(['QSX1', 'QSX3'], **points, outputs=('mx',))\n"
    "print(json.dumps([gradients.gradients_of(5).__dict__.get('__file__'), j['mx'].tolist()]))\n"
)


def expected():
    tire = tire_52()
    return tire.jacobian(["QSX1", "QSX3"], slip_angle=0.05, camber=0.02, normal_load=3000.0, outputs=("mx",))[
        "mx"
    ]


def started(package: Path, cache: Path, **more: str) -> subprocess.Popen[str]:
    """A process that asks for derivatives, with a package and a cache of its own."""
    paths = os.pathsep.join([str(package), str(Path(__file__).parent)])
    environment = {**os.environ, "PYTHONPATH": paths, "XDG_CACHE_HOME": str(cache), **more}
    environment.pop("NUMBA_CACHE_DIR", None)
    return subprocess.Popen(
        [sys.executable, "-c", CODE],
        env=environment,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
    )


def answer(process: subprocess.Popen[str]) -> tuple[str | None, np.ndarray]:
    out, err = process.communicate()
    assert process.returncode == 0, err
    file, values = json.loads(out.splitlines()[-1])
    return file, np.array(values)


@pytest.fixture
def package(tmp_path):
    """A copy of the package, without anything that was written since it was installed."""
    source = Path(tire_pipeline.__file__).parent
    copy = tmp_path / "installed"
    shutil.copytree(source, copy / "tire_pipeline", ignore=shutil.ignore_patterns("__pycache__"))
    return copy


def read_only(package: Path) -> None:
    """Keep anyone, also root, from writing beside the equations: a file stands where the folder would be."""
    (package / PLACE / "__pycache__").write_text("")


@pytest.mark.slow
def test_the_code_lies_where_compiled_code_lies(package, tmp_path):
    file, found = answer(started(package, tmp_path / "cache", TIRE_PIPELINE_NO_NUMBA="1"))
    assert Path(file).parent == package / PLACE / "__pycache__"
    assert not (tmp_path / "cache").exists()
    np.testing.assert_allclose(found, expected(), rtol=1e-12)


@pytest.mark.slow
def test_a_read_only_installation_writes_to_the_users_cache(package, tmp_path):
    read_only(package)
    file, found = answer(started(package, tmp_path / "cache"))
    assert Path(file).is_relative_to(tmp_path / "cache" / "tire-pipeline")
    assert list(Path(file).parent.rglob("gradients_5_*.nbi"))
    np.testing.assert_allclose(found, expected(), rtol=1e-12)


@pytest.mark.slow
def test_where_nothing_can_be_written_derivatives_are_there_all_the_same(package, tmp_path):
    read_only(package)
    (tmp_path / "cache").write_text("no folder")
    file, found = answer(started(package, tmp_path / "cache"))
    assert file is None
    np.testing.assert_allclose(found, expected(), rtol=1e-12)


@pytest.mark.slow
def test_processes_that_start_at_once_write_the_same_whole_file(package, tmp_path):
    several = [started(package, tmp_path / "cache", TIRE_PIPELINE_NO_NUMBA="1") for _ in range(3)]
    answers = [answer(process) for process in several]
    (file,) = {file for file, _ in answers}
    assert Path(file).read_text("utf-8") == derive.module_source(5)
    assert not list(Path(file).parent.glob(".*.part"))
    for _, found in answers:
        np.testing.assert_allclose(found, expected(), rtol=1e-12)


def test_code_of_other_equations_is_not_taken(tmp_path, monkeypatch):
    monkeypatch.setenv("NUMBA_CACHE_DIR", str(tmp_path))
    (folder,) = gradients.cache_folders()
    folder.mkdir()
    other, just_now = (folder / f"gradients_5_{name}.py" for name in ("aaaa", "bbbb"))
    for path in (other, just_now):
        path.write_text("OVER = {}\n")
    os.utime(other, (0, 0))
    module = gradients_of.__wrapped__(5)
    assert set(module.OVER) == set(FORCE_CHANNELS)
    assert derive.source_stamp() in Path(module.__file__).name
    assert not other.exists()  # old, so nobody is about to compile it
    assert just_now.exists()


def test_old_code_is_deleted_also_where_the_code_is_there(tmp_path, monkeypatch):
    """What was too new to be deleted when code was last written stayed for ever."""
    monkeypatch.setenv("NUMBA_CACHE_DIR", str(tmp_path))
    monkeypatch.setenv("TIRE_PIPELINE_NO_NUMBA", "1")
    file = Path(gradients_of.__wrapped__(5).__file__)
    stale = [file.with_name("gradients_5_aaaa.py"), file.parent / "__pycache__" / "gradients_5_aaaa.loop.nbi"]
    stale.append(file.with_name(".killed.part"))
    other_family = file.with_name("gradients_6_aaaa.py")
    stale[1].parent.mkdir(exist_ok=True)
    for path in (*stale, other_family):
        path.write_text("")
        os.utime(path, (0, 0))
    assert Path(gradients_of.__wrapped__(5).__file__) == file
    assert [path for path in stale if path.exists()] == []
    assert file.exists()
    assert other_family.exists()  # goes when derivatives of its own family are asked for


@pytest.mark.slow
def test_the_wheel_builds_offline_and_holds_no_generated_code(tmp_path):
    source = tmp_path / "source"
    shutil.copytree(ROOT / "src", source / "src", ignore=shutil.ignore_patterns("*.egg-info", "*.nb?"))
    for name in ("pyproject.toml", "README.md", "LICENSE"):
        shutil.copy(ROOT / name, source / name)
    pip = [sys.executable, "-m", "pip", "wheel", "--no-index", "--no-deps", "--no-build-isolation"]
    subprocess.run([*pip, "--quiet", "-w", str(tmp_path), str(source)], check=True, capture_output=True)
    (wheel,) = tmp_path.glob("*.whl")
    names = zipfile.ZipFile(wheel).namelist()
    assert f"{PLACE}/derive.py" in names
    assert not [name for name in names if "gradients_" in name]


@pytest.mark.long
@pytest.mark.parametrize("version", ["5.2", "6.1"])
def test_the_first_use_takes_a_tenth_more_at_most_than_where_the_code_is_there(version):
    path = ROOT / "benchmarks" / "bench_first_use.py"
    spec = importlib.util.spec_from_file_location(path.stem, path)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    without, found = module.least(version, rounds=2)
    assert without <= module.GOAL * found
