"""Says which node is at work once it has taken two seconds, and how long each took."""

from __future__ import annotations

import inspect
import io
import logging
import sys
import threading
import time
from contextlib import ExitStack
from typing import Any

from kedro.framework.hooks import hook_impl

from tire_pipeline.pages.visible_text import VisibleFormatter
from tire_pipeline.progress import under_way

SAY_AFTER_SECONDS = 2.0
_LOG = logging.getLogger(__name__)


class NodeProgressHooks:
    """One line when a node has worked for two seconds, one when it is done; what it is at in between.

    A node is done when its last output is written: what is read and computed only then (a folder of files) is
    its work, too. One that gives its results in steps is done when the next one begins, or the run ends.
    """

    def __init__(self) -> None:
        self._total, self._done, self._began = 0, 0, 0.0
        self._node: Any = None
        self._unsaved: set[str] = set()
        self._goes_on: Any = None  # a node that gives its results in steps
        self._timer: threading.Timer | None = None
        self._under_way = ExitStack()

    @hook_impl
    def after_context_created(self) -> None:
        """Have logs written above what shows progress, with all in them visible.

        Kedro allows no handler or formatter of one's own in the configuration.
        """
        for handler in logging.getLogger().handlers:
            if isinstance(handler, logging.StreamHandler) and handler.stream is sys.stdout:
                handler.setStream(StandardOutput())
                handler.setFormatter(VisibleFormatter(handler.formatter or logging.Formatter()))

    @hook_impl
    def before_pipeline_run(self, pipeline: Any) -> None:
        """Count what there is to do."""
        self._total, self._done = len(pipeline.nodes), 0
        self._node = self._goes_on = None

    @hook_impl
    def before_dataset_loaded(self, dataset_name: str, node: Any) -> None:
        """Say what is read, if it takes long."""
        self._begin(node)
        self._at(f"reading {dataset_name}")

    @hook_impl
    def before_node_run(self, node: Any) -> None:
        """Say what the node does, if it takes long."""
        self._stop()
        self._begin(node)
        self._at(node.name)
        text = (node.func.__doc__ or "").strip().split("\n\n")[0]
        said = f"{node.name}: {' '.join(text.split())}"
        self._timer = threading.Timer(SAY_AFTER_SECONDS, _LOG.info, args=[said])
        self._timer.daemon = True
        self._timer.start()

    @hook_impl
    def after_node_run(self, node: Any) -> None:
        """Say that it is done, if it has no outputs."""
        self._stop()
        self._unsaved = set(node.outputs)
        if inspect.isgeneratorfunction(node.func):
            self._unsaved, self._goes_on = set(), node
        elif not node.outputs:
            self._say_done(node)

    @hook_impl
    def before_dataset_saved(self, dataset_name: str) -> None:
        """Say what is written, if it takes long."""
        self._at(f"writing {dataset_name}")

    @hook_impl
    def after_dataset_loaded(self) -> None:
        """It is read."""
        self._under_way.close()

    @hook_impl
    def after_dataset_saved(self, dataset_name: str, node: Any) -> None:
        """It is written; with the last output the node is done."""
        self._under_way.close()
        if dataset_name in self._unsaved:
            self._unsaved.discard(dataset_name)
            if not self._unsaved:
                self._say_done(node)

    @hook_impl
    def after_pipeline_run(self) -> None:
        """The last node is done, too."""
        if self._goes_on is not None:
            self._say_done(self._goes_on)

    @hook_impl
    def on_node_error(self) -> None:
        """Say nothing more of a node that failed."""
        self._stop()

    @hook_impl
    def on_pipeline_error(self) -> None:
        """Nor of a dataset."""
        self._stop()

    def _begin(self, node: Any) -> None:
        if node is self._node:
            return
        if self._goes_on is not None:
            self._say_done(self._goes_on)
        self._node, self._began = node, time.monotonic()

    def _say_done(self, node: Any) -> None:
        self._done, self._goes_on = self._done + 1, None
        taken = time.monotonic() - self._began
        _LOG.info("%d of %d done: %s (%.1f s)", self._done, self._total, node.name, taken)

    def _at(self, what: str) -> None:
        self._under_way.close()
        self._under_way.enter_context(under_way(what))

    def _stop(self) -> None:
        self._under_way.close()
        if self._timer is not None:
            self._timer.cancel()
            self._timer = None


class StandardOutput(io.TextIOBase):
    """Writes to what is standard output now: above a progress bar, where one is shown."""

    def write(self, text: str) -> int:
        """Write."""
        return sys.stdout.write(text)

    def flush(self) -> None:
        """Flush."""
        sys.stdout.flush()
