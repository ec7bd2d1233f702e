"""What Dagster runs: the retraining when files have arrived and every night. Kedro does the work."""

# No `from __future__ import annotations`: Dagster reads the annotations when the module is loaded.
import os
from pathlib import Path
from typing import Any

import dagster as dg
from kedro.framework.session import KedroSession
from kedro.framework.startup import bootstrap_project
from pydantic import Field

from tire_pipeline.kedro_runs.run_errors import one_line
from tire_pipeline.schedule.arrivals import new_files_of
from tire_pipeline.thesis.parameters import GridParameters

ROOT = Path(os.environ.get("TIRE_PIPELINE_ROOT", Path.cwd()))
JOB = "retraining"
UNDERWAY = [
    dg.DagsterRunStatus.QUEUED,
    dg.DagsterRunStatus.NOT_STARTED,
    dg.DagsterRunStatus.STARTING,
    dg.DagsterRunStatus.STARTED,
]


TURN_SECONDS = 3600  # how long a run waits for another one on the same data folder
TUNING_NODES = ["experiments.search_the_grid"]
CASE_NODES = [
    "mismatch.explain_cases",
    "mismatch.explain_by_baselines",
    "mismatch.explain_real_cases",
    "mismatch.explain_real_by_baselines",
]


class KedroRun(dg.Config):
    """Which environment and parameters a run takes.

    Attributes
    ----------
    env : str or None
        For example ``small``.
    conf_source : str or None
        Folder of the configuration, if not ``conf``.
    parameters : dict
        As behind ``--params``.
    """

    env: str | None = os.environ.get("KEDRO_ENV")
    conf_source: str | None = os.environ.get("TIRE_PIPELINE_CONF")
    parameters: dict[str, Any] = Field(default_factory=dict)


def kedro_run(
    config: KedroRun,
    pipeline: str,
    *,
    namespaces: list[str] | None = None,
    nodes: list[str] | None = None,
) -> None:
    """Run one registered pipeline or a part of it, as ``kedro run --pipeline`` does.

    Parts of a pipeline run beside each other; a whole one waits for its turn on the data folder.
    """
    bootstrap_project(ROOT)
    turn = {"alongside": True} if namespaces else {"wait_seconds": TURN_SECONDS}
    session = KedroSession.create(
        project_path=ROOT,
        env=config.env,
        conf_source=config.conf_source,
        runtime_params={"one_run_at_a_time": turn, **config.parameters},
    )
    with session:
        session.run(pipeline_names=[pipeline], namespaces=namespaces, node_names=nodes)


@dg.op(retry_policy=dg.RetryPolicy(max_retries=2, delay=60))
def retrain(config: KedroRun) -> None:
    """Read what is new, train a candidate, release it if it is not worse."""
    kedro_run(config, "retrain")


@dg.job(name=JOB)
def retraining() -> None:
    """New files -> candidate -> comparison -> release."""
    retrain()


@dg.sensor(job=retraining, minimum_interval_seconds=30, default_status=dg.DefaultSensorStatus.RUNNING)
def arrivals(context: dg.SensorEvaluationContext) -> dg.SensorResult | dg.SkipReason:
    """One run for all that has arrived, once it has stopped growing and no other run is underway."""
    if context.instance.get_runs(filters=dg.RunsFilter(job_name=JOB, statuses=UNDERWAY), limit=1):
        return dg.SkipReason("a run is underway; what arrives meanwhile is for the next")
    try:
        found = new_files_of(ROOT, KedroRun())
    except Exception as error:  # a folder that is not mounted yet is no reason for a traceback every 30 s
        line = one_line(error)
        if line is None:
            raise
        return dg.SkipReason(line)
    if found.growing:
        return dg.SkipReason(f"{len(found.growing)} files still grow, {found.growing[0]} for one")
    if not found:
        return dg.SkipReason("nothing new")
    failed = [dg.DagsterRunStatus.FAILURE, dg.DagsterRunStatus.CANCELED]
    tag = {"tire_pipeline/difference": found.key}
    before = len(context.instance.get_runs(filters=dg.RunsFilter(tags=tag, statuses=failed), limit=3))
    return dg.SensorResult([dg.RunRequest(run_key=f"{found.key}-{before}", tags=tag)])


@dg.op
def train_cell(context: dg.OpExecutionContext, config: KedroRun) -> None:
    """Train and judge the agents of one cell of the thesis' grid."""
    kedro_run(config, "reproduce_thesis", namespaces=[f"agents.{context.partition_key}"])


@dg.job(partitions_def=dg.StaticPartitionsDefinition([cell.name for cell in GridParameters().cells]))
def agents() -> None:
    """The grid of agents, one partition a cell; each writes results of its own (docs/how-to/cluster.md)."""
    train_cell()


@dg.op
def tune(config: KedroRun) -> None:
    """Train the networks of the ANN's grid, on both kinds of folds."""
    kedro_run(config, "reproduce_thesis", nodes=TUNING_NODES)


@dg.job
def tuning() -> None:
    """The tuning of the ANN; the run's cluster divides it (docs/how-to/cluster.md)."""
    tune()


@dg.op
def explain(config: KedroRun) -> None:
    """Explain the concealed cases, by ``explain_mismatch`` and by the baselines."""
    kedro_run(config, "prove_concealed", nodes=CASE_NODES)


@dg.job
def cases() -> None:
    """The concealed cases; the run's cluster divides them."""
    explain()


nightly = dg.ScheduleDefinition(
    job=retraining, cron_schedule="0 3 * * *", default_status=dg.DefaultScheduleStatus.RUNNING
)

definitions = dg.Definitions(
    jobs=[retraining, agents, tuning, cases],
    sensors=[arrivals],
    schedules=[nightly],
    executor=dg.multiprocess_executor.configured({"max_concurrent": 2}),
)
