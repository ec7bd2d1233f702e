"""The Dagster layer: what the sensor asks for, and that the definitions load."""

from __future__ import annotations

from dataclasses import dataclass, field

import pytest
from retraining_files import put, tir_text

from tire_pipeline.retraining import FolderDifference, Manifest, Store, difference, ingest

dg = pytest.importorskip("dagster", reason='the extra is not installed: pip install -e ".[schedule]"')
from tire_pipeline.schedule import definitions as schedule  # noqa: E402


@dataclass
class Folder:
    """Stands for the project: a folder of files and the manifest of the last run."""

    path: object
    manifest: Manifest = field(default_factory=Manifest)

    def difference(self, *_: object) -> FolderDifference:
        return difference(self.path, self.manifest, settle_seconds=5.0)

    def run(self) -> None:
        self.manifest = ingest(Store(self.manifest), self.path, self.difference())[0].manifest


@pytest.fixture
def folder(tmp_path, monkeypatch):
    stands = Folder(tmp_path)
    monkeypatch.setattr(schedule, "new_files_of", stands.difference)
    return stands


@pytest.fixture
def instance():
    with dg.DagsterInstance.ephemeral() as here:
        yield here


def _ask(instance):
    with dg.build_sensor_context(instance=instance) as context:
        return schedule.arrivals(context)


def _requests(instance):
    answer = _ask(instance)
    return list(answer.run_requests) if isinstance(answer, dg.SensorResult) else []


def test_one_run_for_a_hundred_files(folder, instance):
    for tire in range(100):
        put(folder.path, f"A/{tire}.tir", tir_text(tire))
    (request,) = _requests(instance)
    assert _requests(instance)[0].run_key == request.run_key
    folder.run()
    assert "nothing new" in _ask(instance).skip_message


def test_nothing_starts_while_a_file_grows(folder, instance):
    put(folder.path, "A/1.tir", tir_text(1))
    put(folder.path, "A/2.tir", tir_text(2)[:50], age=0.0)
    assert "still grow, A/2.tir" in _ask(instance).skip_message
    put(folder.path, "A/2.tir", tir_text(2))
    assert len(_requests(instance)) == 1


def test_changed_content_asks_again_and_the_same_again_does_not(folder, instance):
    put(folder.path, "A/1.tir", tir_text(1))
    first = _requests(instance)[0].run_key
    folder.run()
    put(folder.path, "A/1.tir", tir_text(1), age=7200)
    assert _requests(instance) == []
    put(folder.path, "A/1.tir", tir_text(2))
    assert _requests(instance)[0].run_key != first


def test_nothing_starts_while_a_run_is_underway_and_a_failed_one_is_tried_again(folder, instance):
    put(folder.path, "A/1.tir", tir_text(1))
    request = _requests(instance)[0]
    run = instance.create_run_for_job(
        schedule.retraining, tags=request.tags, status=dg.DagsterRunStatus.STARTED
    )
    assert "underway" in _ask(instance).skip_message
    instance.report_run_failed(run)
    assert _requests(instance)[0].run_key not in ("", request.run_key)


def test_a_bad_file_does_not_start_runs_for_ever(folder, instance):
    put(folder.path, "A/bad.tir", "nothing")
    assert len(_requests(instance)) == 1
    folder.run()
    assert _requests(instance) == []


def test_a_folder_that_is_absent_is_said_in_one_line(instance, monkeypatch, tmp_path):
    from tire_pipeline.datasets import FolderDataset

    absent = tmp_path / "not mounted"
    monkeypatch.setattr(schedule, "new_files_of", lambda *_: FolderDataset(path=str(absent)).load())
    assert f"{absent}: this folder does not exist" in _ask(instance).skip_message
    monkeypatch.setattr(schedule, "new_files_of", lambda *_: 1 / 0)  # what nobody expected stays loud
    with pytest.raises(ZeroDivisionError):
        _ask(instance)


def test_sensor_and_nightly_run_are_on_when_it_starts():
    loaded = schedule.definitions
    assert {sensor.name for sensor in loaded.sensors} == {"arrivals"}
    assert schedule.arrivals.default_status == dg.DefaultSensorStatus.RUNNING
    assert schedule.nightly.default_status == dg.DefaultScheduleStatus.RUNNING


def test_a_run_is_that_of_kedro(monkeypatch):
    asked = []
    monkeypatch.setattr(schedule, "kedro_run", lambda config, pipeline: asked.append((config.env, pipeline)))
    config = {"ops": {"retrain": {"config": {"env": "small"}}}}
    assert schedule.retraining.execute_in_process(run_config=config).success
    assert asked == [("small", "retrain")]


def test_every_cell_of_the_grid_is_a_partition_and_a_namespace():
    from pathlib import Path

    from kedro.framework.project import pipelines
    from kedro.framework.startup import bootstrap_project

    bootstrap_project(Path(__file__).resolve().parents[2])
    namespaces = {
        node.namespace for node in pipelines["reproduce_thesis"].nodes if node.namespace.startswith("agents.")
    }
    partitions = schedule.agents.partitions_def.get_partition_keys()
    assert {f"agents.{name}" for name in partitions} == namespaces
    assert len(partitions) == len(namespaces) > 10


@pytest.fixture
def asked(monkeypatch):
    """What Kedro was asked to run."""
    calls = []
    monkeypatch.setattr(
        schedule, "kedro_run", lambda config, pipeline, **part: calls.append((pipeline, part))
    )
    return calls


def test_a_partition_runs_its_own_cell_only(asked):
    cell = schedule.agents.partitions_def.get_partition_keys()[3]
    assert schedule.agents.execute_in_process(partition_key=cell).success
    assert asked == [("reproduce_thesis", {"namespaces": [f"agents.{cell}"]})]


@pytest.mark.parametrize(
    ("job", "pipeline", "nodes"),
    [("cases", "prove_concealed", "CASE_NODES"), ("tuning", "reproduce_thesis", "TUNING_NODES")],
)
def test_a_job_runs_its_own_nodes_which_the_cluster_divides(asked, job, pipeline, nodes):
    assert getattr(schedule, job).execute_in_process().success
    assert asked == [(pipeline, {"nodes": getattr(schedule, nodes)})]


def test_the_nodes_of_the_jobs_exist_and_a_run_takes_the_cluster(monkeypatch):
    from pathlib import Path

    from kedro.framework.project import pipelines
    from kedro.framework.session import KedroSession
    from kedro.framework.startup import bootstrap_project

    root = Path(__file__).resolve().parents[2]
    bootstrap_project(root)
    names = {node.name for name in ("prove_concealed", "reproduce_thesis") for node in pipelines[name].nodes}
    assert {*schedule.CASE_NODES, *schedule.TUNING_NODES} <= names
    seen = {}

    def run(self, **part):
        seen.update(self.load_context().params["cluster"])

    monkeypatch.setattr(KedroSession, "run", run)
    monkeypatch.setattr(schedule, "ROOT", root)
    monkeypatch.setenv("TIRE_PIPELINE_SCHEDULER", "tcp://127.0.0.1:9999")
    schedule.kedro_run(schedule.KedroRun(env="cluster"), "prove_concealed", nodes=schedule.CASE_NODES)
    assert seen["scheduler"] == "tcp://127.0.0.1:9999"
