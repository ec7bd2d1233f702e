"""``python -m tire_pipeline.lineage.serve``: kedro-viz on this machine only."""

from __future__ import annotations

import argparse
import shutil
import tempfile
import warnings
from pathlib import Path

from packaging.version import parse

from tire_pipeline.lineage.descriptions import described
from tire_pipeline.lineage.first_screen import prepared
from tire_pipeline.lineage.page_policy import with_policy


def main() -> None:
    """Serve until interrupted."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--port", type=int, default=4141)
    parser.add_argument("--env", default=None, help="configuration environment, for example small")
    parser.add_argument("--project", type=Path, default=Path.cwd())
    arguments = parser.parse_args()
    warnings.filterwarnings("ignore", message="ORJSONResponse is deprecated")  # kedro-viz' own matter
    import kedro_viz
    from kedro.framework.startup import bootstrap_project
    from kedro_viz.api import apps
    from kedro_viz.api.rest.responses import version
    from kedro_viz.server import run_server

    metadata = bootstrap_project(arguments.project.resolve())
    with tempfile.TemporaryDirectory() as folder:
        pages = Path(folder) / "html"
        shutil.copytree(apps._HTML_DIR, pages)
        index = pages / "index.html"
        html = prepared(index.read_text(encoding="utf-8"))
        html = described(html, arguments.project.resolve(), arguments.env)
        index.write_text(with_policy(html, served=True), encoding="utf-8")
        (pages / "telemetry.html").write_text("</head>")  # never, whatever the folder's consent says
        apps._HTML_DIR = pages
        version.get_latest_version = lambda: parse(kedro_viz.__version__)  # it would ask pypi.org
        print(f"kedro-viz: http://127.0.0.1:{arguments.port}/", flush=True)
        run_server(
            host="127.0.0.1",
            port=arguments.port,
            project_path=str(arguments.project.resolve()),
            package_name=metadata.package_name,
            env=arguments.env,
        )


if __name__ == "__main__":
    main()
