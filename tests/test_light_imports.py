"""What is slow to import is imported when it is needed, not before."""

from __future__ import annotations

import importlib
import json
import subprocess
import sys

import pytest

pytestmark = pytest.mark.slow
HEAVY = ("torch", "stable_baselines3", "gymnasium", "kedro", "matplotlib", "sklearn")
SLOW = (
    "scipy.stats",
    "scipy.signal",
    "scipy.optimize",
    "scipy.io",
    "scipy.special",
    "scipy.spatial",
    "pyarrow.parquet",
)


def loaded(statement: str) -> set[str]:
    """Modules that a fresh process has after a statement."""
    code = f"import json, sys\n{statement}\nprint(json.dumps(sorted(sys.modules)))"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    return set(json.loads(done.stdout.splitlines()[-1]))


@pytest.mark.parametrize(
    "statement",
    [
        "import tire_pipeline.mismatch",
        "from tire_pipeline.magic_formula import TireModel",
        "from tire_pipeline.tir import read_tir, write_tir",
        "from tire_pipeline.recordings import read_recording, check_recording",
        "from tire_pipeline.mismatch import explain_mismatch, MismatchReport",
    ],
)
def test_an_import_loads_nothing_that_is_not_needed_yet(statement):
    """A name that is taken from a package loads all that the package itself loads."""
    modules = loaded(statement)
    assert ("numpy" in modules) == (statement != "import tire_pipeline.mismatch")
    assert modules.isdisjoint((*HEAVY, *SLOW))


def test_a_run_loads_what_trains_and_draws_only_in_the_nodes_that_need_it():
    modules = loaded(
        "from kedro.framework.project import configure_project, pipelines\n"
        "configure_project('tire_pipeline')\nassert len(pipelines) > 8"
    )
    assert "kedro" in modules
    assert modules.isdisjoint(
        ("torch", "stable_baselines3", "gymnasium", "matplotlib", "sklearn", "scipy.stats")
    )


def test_what_trains_a_network_leaves_the_compiler_of_torch_alone():
    """It takes two seconds to import, in each process that trains."""
    modules = loaded(
        "import numpy as np\n"
        "from tire_pipeline.classifiers.methods.ann import Ann\n"
        "from tire_pipeline.representations.autoencoder import train_autoencoder\n"
        "rows = np.arange(20.0).reshape(10, 2)\n"
        "Ann(epochs=1, smote=False).fit(rows, np.array(list('ab') * 5), seed=0)\n"
        "train_autoencoder(rows, n_features=1, epochs=1, batch_size=5, learning_rate=1e-3, seed=0)"
    )
    assert "torch.optim" in modules
    assert "torch._dynamo" not in modules


def test_a_run_says_that_it_starts_before_what_is_slow_is_imported():
    """Kedro imports these two before it calls the project's ``run``, which says so first."""
    modules = loaded("import tire_pipeline.settings, tire_pipeline.cli")
    assert "kedro" in modules
    assert modules.isdisjoint({*HEAVY, *SLOW, "pandas", "numba"} - {"kedro"})


@pytest.mark.parametrize("package", ["magic_formula", "recordings", "mismatch"])
def test_a_package_loads_no_compiler_before_forces_are_asked_for(package):
    assert "numba" not in loaded(f"import tire_pipeline.{package}")


@pytest.mark.parametrize("package", ["magic_formula", "magic_formula.fitting", "mismatch"])
def test_the_names_that_are_imported_on_demand_are_there(package):
    """A constant has no name of its own."""
    module = importlib.import_module(f"tire_pipeline.{package}")
    values = {name: getattr(module, name) for name in module.__all__}
    assert all(getattr(value, "__name__", name) == name for name, value in values.items())
    with pytest.raises(AttributeError, match="explain_missmatch"):
        _ = module.explain_missmatch
