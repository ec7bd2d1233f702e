"""A Postgres of Debian's package as a process of its own, on loopback."""

from __future__ import annotations

import os
import pwd
import secrets
import shutil
import subprocess
import tempfile
import time
from pathlib import Path

from dask_processes import free_port


def programs() -> Path | None:
    """The newest that Debian's package has installed."""
    found = sorted(Path("/usr/lib/postgresql").glob("*/bin/postgres"))
    return found[-1].parent if found else None


class Postgres:
    """Makes a database in a folder of its own; it refuses to run as root, so it runs as ``postgres`` then."""

    def __init__(self) -> None:
        self.folder = Path(tempfile.mkdtemp(prefix="tire_postgres_"))
        self._user = "postgres" if os.geteuid() == 0 else pwd.getpwuid(os.geteuid()).pw_name
        self.port = free_port()
        password = secrets.token_hex(16)
        self.url = f"postgresql+psycopg2://tires:{password}@127.0.0.1:{self.port}/postgres"
        written = self.folder / "password"
        written.write_text(password)
        if os.geteuid() == 0:
            for each in (self.folder, written):
                shutil.chown(each, self._user)
        data = self.folder / "data"
        self._run("initdb", "-D", str(data), "-U", "tires", f"--pwfile={written}", "--auth=scram-sha-256")
        self._process = subprocess.Popen(
            [
                str(programs() / "postgres"), "-D", str(data), "-p", str(self.port),
                "-h", "127.0.0.1", "-k", str(self.folder),
            ],
            user=self._user, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, cwd=self.folder,
        )  # fmt: skip
        self._wait()

    def _run(self, name: str, *arguments: str) -> None:
        command = [str(programs() / name), *arguments]
        subprocess.run(command, user=self._user, check=True, capture_output=True, cwd=self.folder)

    def _wait(self) -> None:
        command = [str(programs() / "pg_isready"), "-h", "127.0.0.1", "-p", str(self.port)]
        for _ in range(300):
            if subprocess.run(command, capture_output=True, check=False).returncode == 0:
                return
            time.sleep(0.1)
        raise TimeoutError("Postgres does not answer")

    def end(self) -> None:
        """Stop it and remove all that it wrote."""
        self._process.terminate()
        self._process.wait(timeout=60)
        shutil.rmtree(self.folder)
