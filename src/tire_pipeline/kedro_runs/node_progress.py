"""Says which node is at work once it has taken two seconds, and how long each took."""

from __future__ import annotations

import logging
import threading
import time
from typing import Any

from kedro.framework.hooks import hook_impl

SAY_AFTER_SECONDS = 2.0
_LOG = logging.getLogger(__name__)


class NodeProgressHooks:
    """One line when a node has worked for two seconds, one when it is done."""

    def __init__(self) -> None:
        self._total, self._done, self._began = 0, 0, 0.0
        self._timer: threading.Timer | None = None

    @hook_impl
    def before_pipeline_run(self, pipeline: Any) -> None:
        """Count what there is to do."""
        self._total, self._done = len(pipeline.nodes), 0

    @hook_impl
    def before_node_run(self, node: Any) -> None:
        """Say what the node does, if it takes long."""
        self._stop()
        self._began = time.monotonic()
        text = (node.func.__doc__ or "").strip().split("\n\n")[0]
        said = f"{node.name}: {' '.join(text.split())}"
        self._timer = threading.Timer(SAY_AFTER_SECONDS, _LOG.info, args=[said])
        self._timer.daemon = True
        self._timer.start()

    @hook_impl
    def after_node_run(self, node: Any) -> None:
        """Say that it is done."""
        self._stop()
        self._done += 1
        taken = time.monotonic() - self._began
        _LOG.info("%d of %d done: %s (%.1f s)", self._done, self._total, node.name, taken)

    @hook_impl
    def on_node_error(self) -> None:
        """Say nothing more of a node that failed."""
        self._stop()

    def _stop(self) -> None:
        if self._timer is not None:
            self._timer.cancel()
            self._timer = None
