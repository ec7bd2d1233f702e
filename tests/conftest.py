"""The tiers of tests, and those that are known to fail (``known_misses.txt``).

`make quick` leaves out what is slow, `make test` only what stands in ``ci_only.txt`` and those cases of a
test that are marked ci where they are listed. `make checks` runs just that. What is marked long is for
`make long`. CI runs `make test-and-checks`, which is both in one go.
"""

from __future__ import annotations

import gc
import re
from collections.abc import Generator
from functools import cache
from pathlib import Path
from typing import Any

import pytest
from hypothesis import settings

# On a busy machine any example may take over 200 ms, Hypothesis' own limit.
settings.register_profile("any machine", deadline=None)
settings.load_profile("any machine")

_KNOWN = Path(__file__).with_name("known_misses.txt")
_REASON = "known miss: a finding to look into (tests/known_misses.txt)"

_HERE = Path(__file__).parent
_CI_ONLY = _HERE / "ci_only.txt"
_SLOW_FOLDERS = frozenset(
    "classifiers cluster concealed mismatch notebooks object_storage pipelines thesis viz".split()
)
"""Whole runs, browsers, simulators, explanations, trainings. Elsewhere the slow files say so themselves."""

_SLOW_FILE = re.compile(r"^pytestmark = .*pytest\.mark\.slow\b", re.MULTILINE)

_SHARE_WHAT_THEY_TEST = frozenset(("cluster", "translation"))
"""Folders whose files need the same workers or the same fitted models: they are done in one process."""

_LONGEST_FIRST = (
    "translation/predict/test_translation_learns_from_batch.py",
    "cluster/test_cluster_map.py",
    "pipelines/test_pipelines_small_run.py",
    "thesis/test_thesis_run.py",
    "pipelines/test_pipelines_bad_input.py",
    "magic_formula/test_magic_formula_fit.py",
    "mismatch/real_recordings/test_mismatch_real_recordings.py",
    "notebooks/test_notebooks_run.py",
    "mismatch/effects/test_mismatch_wrong_inputs.py",
    "command/test_command_translate.py",
    "mismatch/real_recordings/test_mismatch_sampling_rates.py",
    "fleet/test_fleet_bias.py",
    "mismatch/real_recordings/test_mismatch_flat_belt.py",
    "pipelines/test_pipelines_public_files.py",
    "concealed/test_concealed_second.py",
    "retraining/test_retraining_runs.py",
    "docs/test_docs_snippets.py",
    "viz/test_viz_browser.py",
    "magic_formula/test_magic_formula_compiled.py",
    "mismatch/recording/test_mismatch_another_tire.py",
    "mismatch/recording/test_mismatch_spikes.py",
    "mismatch/recording/test_mismatch_units_and_axes.py",
    "magic_formula/test_magic_formula_subsets.py",
    "docs/test_docs_site.py",
    "viz/test_viz_hostile_names.py",
    "recordings/test_recordings_axle_simulated.py",
    "magic_formula/test_magic_formula_gradients.py",
    "mismatch/recording/test_mismatch_few_channels.py",
    "concealed/test_concealed_cases.py",
    "mismatch/proof/test_mismatch_visible.py",
    "pipelines/test_pipelines_explain.py",
    "mismatch/recording/test_mismatch_clipping.py",
    "mismatch/unnamed_physics/test_mismatch_unnamed.py",
    "runs/test_runs_namespaces.py",
    "pipelines/test_pipelines_reader_dies.py",
    "mismatch/proof/test_mismatch_noise_and_places.py",
    "mismatch/inference/test_mismatch_posterior.py",
    "fleet/test_fleet_files.py",
    "mismatch/effects/test_mismatch_lags.py",
    "mismatch/inference/test_mismatch_thinning.py",
    "mismatch/effects/test_mismatch_other_pressure.py",
    "thesis/test_thesis_results.py",
    "viz/test_viz_pages.py",
    "docs/test_docs_examples.py",
    "supply_chain/test_supply_chain_components.py",
    "mismatch/recording/test_mismatch_checks.py",
    "mismatch/recording/test_mismatch_usable.py",
    "command/test_command_explain.py",
    "mismatch/test_mismatch_explain.py",
    "mismatch/effects/test_mismatch_brake_sweeps.py",
    "viz/test_viz_translated_page.py",
    "viz/test_viz_hostile_commands.py",
    "magic_formula/test_magic_formula_fit_given.py",
    "magic_formula/test_magic_formula_lone_points.py",
    "command/test_command.py",
    "tir/test_tir_fuzz.py",
    "test_light_imports.py",
    "recordings/test_recordings_memory.py",
    "object_storage/test_object_storage_datasets.py",
    "classifiers/test_classifiers.py",
    "concealed/test_concealed_baselines.py",
    "mismatch/discrepancy/test_mismatch_gaussian_form.py",
    "recordings/test_recordings_fuzz.py",
    "concealed/test_concealed_real_cases.py",
    "classifiers/test_classifiers_open_set.py",
    "mismatch/effects/test_mismatch_catalogue.py",
    "object_storage/test_object_storage_retraining.py",
    "test_names.py",
    "reporting/test_reporting_translation.py",
    "mismatch/proof/test_mismatch_never_worse.py",
    "mismatch/test_mismatch_several.py",
)
"""Files that take long, longest first: begun last, they would leave one process with nothing to do.

Of a folder that is done in one process the first file stands for all."""


@pytest.hookimpl(wrapper=True)
def pytest_collection() -> Generator[None, object, object]:
    """Look for no garbage among what is imported and collected: nearly all of it stays until the end."""
    gc.disable()
    try:
        return (yield)
    finally:
        gc.freeze()
        gc.enable()


def pytest_ignore_collect(collection_path: Path, config: pytest.Config) -> bool | None:
    """Do not import slow folders and files where no slow test is wanted: that takes as long as the others."""
    if "not slow" not in config.option.markexpr:
        return None
    if collection_path.parent == _HERE and collection_path.name in _SLOW_FOLDERS:
        return True
    test = collection_path.match("test_*.py")
    return True if test and _SLOW_FILE.search(collection_path.read_text(encoding="utf-8")) else None


@pytest.hookimpl(optionalhook=True)
def pytest_xdist_make_scheduler(config: pytest.Config, log: Any) -> Any:
    """Give each file to one process, and each folder whose files share what they test."""
    from xdist.scheduler import LoadFileScheduling

    class FilesAndFolders(LoadFileScheduling):
        def _split_scope(self, nodeid: str) -> str:
            file = nodeid.partition("::")[0]
            folder = Path(file).relative_to("tests").parts[0]
            return folder if folder in _SHARE_WHAT_THEY_TEST else file

    return FilesAndFolders(config, log)


def _listed(path: Path) -> set[str]:
    return {line for line in path.read_text(encoding="utf-8").splitlines() if line.startswith("tests/")}


def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    """Mark known misses as expected failures and slow folders as slow; begin with what takes longest."""
    known, ci_only = _listed(_KNOWN), _listed(_CI_ONLY)
    for item in items:
        if ci_only & {item.nodeid, item.nodeid.partition("[")[0], item.nodeid.partition("::")[0]}:
            item.add_marker(pytest.mark.ci)
        if item.nodeid in known:
            item.add_marker(pytest.mark.xfail(reason=_REASON, strict=True))
        if _in_tests(item.path).partition("/")[0] in _SLOW_FOLDERS:
            item.add_marker(pytest.mark.slow)
    place = {name: number for number, name in enumerate(_LONGEST_FIRST)}
    items.sort(key=lambda item: place.get(_in_tests(item.path), len(place)))


@cache
def _in_tests(path: Path) -> str:
    return path.relative_to(_HERE).as_posix()
