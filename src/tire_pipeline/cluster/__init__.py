"""Where the many tasks of a run are done: in processes here, or by the workers of a Dask cluster."""

from tire_pipeline.cluster.chosen import ClusterHooks, given_map, work_map

__all__ = ["ClusterHooks", "given_map", "work_map"]
