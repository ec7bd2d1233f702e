"""Says which node is at work once it has taken two seconds, and how long each took."""

from __future__ import annotations

import io
import logging
import sys
import threading
import time
from contextlib import ExitStack
from typing import Any

from kedro.framework.hooks import hook_impl

from tire_pipeline.file_names import NAMED_ONCE
from tire_pipeline.pages.visible_text import VisibleFormatter
from tire_pipeline.progress import under_way

SAY_AFTER_SECONDS = 2.0
_LOG = logging.getLogger(__name__)


class NodeProgressHooks:
    """One line when a node has worked for two seconds, one when it is done; what it is at in between.

    A node is done when the next one begins: what is read and computed only as it is written (a folder of
    files) is its work, too, and so is what it gives in steps.
    """

    def __init__(self) -> None:
        self._total, self._done, self._began = 0, 0, 0.0
        self._node: Any = None
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
        """Count what there is to do; no file has been named yet."""
        self._name_files_again()
        for handler in logging.getLogger().handlers:
            handler.addFilter(FileNamedOnce())
        self._total, self._done, self._node = len(pipeline.nodes), 0, None

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
    def after_node_run(self) -> None:
        """It has run; what is left is to write."""
        self._stop()

    @hook_impl(tryfirst=True)
    def after_pipeline_run(self) -> None:
        """Say that the last node is done, before others say what the run has made."""
        self._begin(None)
        self._name_files_again()

    @hook_impl
    def before_dataset_saved(self, dataset_name: str) -> None:
        """Say what is written, if it takes long."""
        self._at(f"writing {dataset_name}")

    @hook_impl
    def after_dataset_loaded(self) -> None:
        """It is read."""
        self._under_way.close()

    @hook_impl
    def after_dataset_saved(self) -> None:
        """It is written."""
        self._under_way.close()

    @hook_impl
    def on_node_error(self) -> None:
        """Say nothing more of a node that failed."""
        self._stop()

    @hook_impl
    def on_pipeline_error(self) -> None:
        """Nor of a dataset."""
        self._stop()
        self._name_files_again()

    @staticmethod
    def _name_files_again() -> None:
        """The next run names all files that cannot be read."""
        for handler in logging.getLogger().handlers:
            for each in [each for each in handler.filters if isinstance(each, FileNamedOnce)]:
                handler.removeFilter(each)

    def _begin(self, node: Any) -> None:
        """Another node begins, or none: the one before is done."""
        if node is self._node:
            return
        if self._node is not None:
            self._done += 1
            taken = time.monotonic() - self._began
            _LOG.info("%d of %d done: %s (%.1f s)", self._done, self._total, self._node.name, taken)
        self._node, self._began = node, time.monotonic()

    def _at(self, what: str) -> None:
        self._under_way.close()
        self._under_way.enter_context(under_way(what))

    def _stop(self) -> None:
        self._under_way.close()
        if self._timer is not None:
            self._timer.cancel()
            self._timer = None


class FileNamedOnce(logging.Filter):
    """Lets a file that cannot be read, or a link, be named once, though several pipelines meet it."""

    def __init__(self) -> None:
        super().__init__()
        self._named: set[str] = set()

    def filter(self, record: logging.LogRecord) -> bool:
        """Whether the record is about no such file, or about one that was not named before."""
        file = getattr(record, NAMED_ONCE, None)
        new = file not in self._named
        if file is not None:
            self._named.add(file)
        return new


class StandardOutput(io.TextIOBase):
    """Writes to what is standard output now: above a progress bar, where one is shown."""

    def write(self, text: str) -> int:
        """Write."""
        return sys.stdout.write(text)

    def flush(self) -> None:
        """Flush."""
        sys.stdout.flush()
