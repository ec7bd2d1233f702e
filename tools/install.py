"""Runs ``pip install`` and says every few seconds how far it is: pip says nothing while it unpacks.

It installs what pip installs, and fails as pip fails. It needs the standard library only.
"""

from __future__ import annotations

import re
import subprocess
import sys
import sysconfig
import threading
import time
from collections.abc import Iterable
from pathlib import Path

SECONDS = 10.0  # between two lines
_INTERRUPTED = 130
PIP = (sys.executable, "-m", "pip", "install", "--disable-pip-version-check", "--progress-bar", "off")


class Progress:
    """What pip does at the moment, by the lines that it prints.

    Parameters
    ----------
    packages
        The folder that pip unpacks into.
    """

    def __init__(self, packages: Path) -> None:
        self._packages = packages
        self._doing = "starting pip"
        self._names: list[str] = []
        self._begin = 0.0

    def hear(self, line: str) -> None:
        """Take in one line that pip printed."""
        if found := re.match(r"\s*Downloading (\S+/)?([^\s/]+)(.*)", line.rstrip()):
            package = _package(found[2])
            only_facts = found[2].endswith(".metadata")
            self._doing = (
                f"choosing versions, {package}" if only_facts else f"downloading {package}{found[3]}"
            )
        elif found := re.match(r"\s*Collecting ([\w.-]+)", line):
            self._doing = f"choosing versions, {found[1]}"
        elif re.match(r"\s*(Installing build dependencies|Building|Preparing|Getting requirements)", line):
            self._doing = "building packages"
        elif line.startswith(("Requirement already satisfied", "Obtaining ")):
            self._doing = "looking at what is there"
        elif line.startswith("Installing collected packages: "):
            self._names = line.partition(": ")[2].split(", ")
            self._begin = time.time()

    def say(self) -> str:
        """What is being done now, in a few words."""
        if not self._names:
            return self._doing
        return f"unpacking {len(self._names):,} packages, {self._unpacked():,} done"

    def _unpacked(self) -> int:
        """How many packages have been written since pip began to unpack."""
        written = [each for each in self._packages.glob("*.dist-info") if (each / "INSTALLER").is_file()]
        new = sum(each.stat().st_mtime >= self._begin - 1 for each in written)  # clocks of disks are coarse
        return min(new, len(self._names))


def _package(file_name: str) -> str:
    """Name and version of a package, from the name of its file."""
    return " ".join(file_name.removesuffix(".metadata").split("-")[:2]).removesuffix(".tar.gz")


def install(arguments: Iterable[str], *, seconds: float = SECONDS) -> int:
    """Run ``pip install`` with some arguments, say how far it is, and return its exit code."""
    begin = time.monotonic()
    progress = Progress(Path(sysconfig.get_path("purelib")))
    pip = subprocess.Popen([*PIP, *arguments], stdout=subprocess.PIPE, text=True, errors="replace")
    listener = threading.Thread(target=_listen, args=(pip, progress), daemon=True)
    listener.start()
    while True:
        try:
            return pip.wait(timeout=seconds)
        except subprocess.TimeoutExpired:
            print(f"  {progress.say()} ({time.monotonic() - begin:.0f} s so far)", flush=True)
        except KeyboardInterrupt:  # pip has it, too
            pip.wait()
            return _INTERRUPTED


def _listen(pip: subprocess.Popen[str], progress: Progress) -> None:
    """Pass what pip prints on to the progress."""
    assert pip.stdout is not None
    for line in pip.stdout:
        progress.hear(line)


if __name__ == "__main__":
    sys.exit(install(sys.argv[1:]))
