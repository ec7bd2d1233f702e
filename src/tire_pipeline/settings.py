"""Kedro settings: which hooks run, and where configuration lies."""

from omegaconf.resolvers import oc

from tire_pipeline.cluster import ClusterHooks
from tire_pipeline.kedro_runs.around_run import FolderHooks, OneRunHooks, OutcomeHooks
from tire_pipeline.kedro_runs.front_page import FrontPageHooks
from tire_pipeline.kedro_runs.newest_tables import NewestTablesHooks
from tire_pipeline.kedro_runs.node_progress import NodeProgressHooks
from tire_pipeline.kedro_runs.thesis_grid import ThesisGridHooks
from tire_pipeline.kedro_runs.unknown_parameters import UnknownParameterHooks

HOOKS = (
    UnknownParameterHooks(),
    FolderHooks(),
    OneRunHooks(),
    ClusterHooks(),
    NodeProgressHooks(),
    NewestTablesHooks(),
    OutcomeHooks(),
    ThesisGridHooks(),
    FrontPageHooks(),
)

# kedro-telemetry comes along with kedro-viz; it stays silent.
DISABLE_HOOKS_FOR_PLUGINS = ("kedro-telemetry",)

CONFIG_LOADER_ARGS = {
    "base_env": "base",
    "default_run_env": "local",
    "merge_strategy": {"parameters": "soft"},  # an environment names only what differs
    "custom_resolvers": {"oc.env": oc.env},  # where a cluster is, in conf/cluster
    "config_patterns": {
        "catalog": ["catalog*", "catalog*/**", "**/catalog*"],
        "parameters": ["parameters*", "parameters*/**", "**/parameters*"],
    },
}
