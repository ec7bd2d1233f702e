"""What a run says of its workers."""

from __future__ import annotations

from pydantic import BaseModel, ConfigDict, Field


class ClusterParameters(BaseModel):
    """Parameters of ``cluster``.

    Attributes
    ----------
    scheduler : str or None
        Address of a Dask scheduler, ``tcp://127.0.0.1:8786`` or ``tls://host:8786``; none: no cluster.
    tls_ca, tls_certificate, tls_key : str or None
        Files in PEM form. Without them only a scheduler on this machine is taken.
    processes : int
        How many tasks are done at once without a cluster.
    wait_seconds : float
        How long a run waits for scheduler and workers to be there.
    """

    model_config = ConfigDict(extra="forbid", frozen=True)
    scheduler: str | None = None
    tls_ca: str | None = None
    tls_certificate: str | None = None
    tls_key: str | None = None
    processes: int = Field(2, ge=1)
    wait_seconds: float = Field(30.0, gt=0.0)
