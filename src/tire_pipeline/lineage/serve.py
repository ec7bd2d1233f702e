"""``python -m tire_pipeline.lineage.serve``: kedro-viz on this machine only."""

from __future__ import annotations

import argparse
import shutil
import socket
import tempfile
import warnings
from pathlib import Path

from packaging.version import parse

from tire_pipeline.errors import DomainError
from tire_pipeline.kedro_runs.run_errors import errors_in_one_line
from tire_pipeline.lineage.descriptions import described
from tire_pipeline.lineage.first_screen import prepared
from tire_pipeline.lineage.page_policy import with_policy

_HOST = "127.0.0.1"


def main() -> None:
    """Serve until interrupted; what the user can put right is one line."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--port", type=int, default=4141)
    parser.add_argument("--env", default=None, help="configuration environment, for example small")
    parser.add_argument("--project", type=Path, default=Path.cwd())
    arguments = parser.parse_args()
    warnings.filterwarnings("ignore", message="ORJSONResponse is deprecated")  # kedro-viz' own matter
    with errors_in_one_line():
        _check_port(arguments.port)
        _serve(arguments.project.resolve(), arguments.env, arguments.port)


def _check_port(port: int) -> None:
    """Refuse a port that cannot be listened to, before anything is loaded and an address is printed."""
    try:
        with socket.socket() as tried:
            tried.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)  # as the server does
            tried.bind((_HOST, port))
    except (OSError, OverflowError) as error:
        why = error.strerror if isinstance(error, OSError) else "there is no such port"
        raise DomainError(
            f"the port cannot be used ({why})",
            where=f"{_HOST}:{port}",
            todo="end what uses it, or choose another: python -m tire_pipeline.lineage.serve --port 4142",
        ) from error


def _serve(project: Path, env: str | None, port: int) -> None:
    import kedro_viz
    from kedro.framework.startup import bootstrap_project
    from kedro_viz.api import apps
    from kedro_viz.api.rest.responses import version
    from kedro_viz.server import run_server

    metadata = bootstrap_project(project)
    with tempfile.TemporaryDirectory() as folder:
        pages = Path(folder) / "html"
        shutil.copytree(apps._HTML_DIR, pages)
        index = pages / "index.html"
        html = prepared(index.read_text(encoding="utf-8"))
        html = described(html, project, env)
        index.write_text(with_policy(html, served=True), encoding="utf-8")
        (pages / "telemetry.html").write_text("</head>")  # never, whatever the folder's consent says
        apps._HTML_DIR = pages
        version.get_latest_version = lambda: parse(kedro_viz.__version__)  # it would ask pypi.org
        print(f"kedro-viz: http://{_HOST}:{port}/", flush=True)
        run_server(
            host=_HOST,
            port=port,
            project_path=str(project),
            package_name=metadata.package_name,
            env=env,
        )


if __name__ == "__main__":
    main()
