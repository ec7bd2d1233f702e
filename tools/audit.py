"""Known vulnerabilities of the pinned versions, by an advisory database on this machine.

`tools/audit.sh` runs this and ends with its code; `make audit` runs that, and ends every failure with 2.
Exit codes: 0 clean, 1 vulnerable, 2 not run, 3 stale: nothing found, but the newest
advisory is over 90 days old.
"""

from __future__ import annotations

import argparse
import datetime
import importlib.util
import json
import sys
import zipfile
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from packaging.requirements import InvalidRequirement, Requirement
from packaging.specifiers import InvalidSpecifier, SpecifierSet
from packaging.utils import canonicalize_name
from packaging.version import InvalidVersion, Version

CLEAN, VULNERABLE, NOT_RUN, STALE = 0, 1, 2, 3
MOST_DAYS = 90
_BEGIN_OF_ZIP = b"PK"
UNTOLD = "its versions cannot be compared; look it up"


class NotRun(Exception):
    """The audit cannot be done; why, and what to do."""


@dataclass(frozen=True)
class Advisory:
    """What a database says of one package: a name, and a test of a version (None: it cannot be told)."""

    package: str
    name: str
    text: str
    record: dict[str, Any]

    def affects(self, version: Version) -> bool | None:
        """Whether a version is affected."""
        try:
            if "specs" in self.record:  # Safety DB
                specs = self.record["specs"]
                return any(SpecifierSet(spec).contains(version, prereleases=True) for spec in specs)
            return _osv_affects(self.record, version)
        except (InvalidSpecifier, InvalidVersion):
            return None


def _osv_affects(affected: dict[str, Any], version: Version) -> bool | None:
    """The evaluation that the OSV format prescribes (ossf.github.io/osv-schema, "Evaluation")."""
    listed = affected.get("versions", [])
    if str(version) in listed or version in {Version(each) for each in listed if _is_version(each)}:
        return True
    ranges = [each for each in affected.get("ranges", []) if each.get("type") in ("ECOSYSTEM", "SEMVER")]
    for each in ranges:
        events = [(kind, Version(value)) for event in each["events"] for kind, value in event.items()]
        inside = False
        for kind, at in sorted(events, key=lambda event: event[1]):
            if kind == "introduced" and version >= at:
                inside = True
            elif (kind == "fixed" and version >= at) or (kind == "last_affected" and version > at):
                inside = False
        if inside:
            return True
    return False if ranges or listed else None


def _is_version(text: str) -> bool:
    try:
        Version(text)
    except InvalidVersion:
        return False
    return True


def pinned(lock: Path) -> dict[str, Version]:
    """Versions by canonical name; every line must pin one."""
    found = {}
    for number, line in enumerate(_read(lock).splitlines(), 1):
        text = line.split("#")[0].split(" --hash")[0].strip()
        if not text:
            continue
        try:
            requirement = Requirement(text)
            (only,) = requirement.specifier
            if only.operator != "==":
                raise ValueError
            found[canonicalize_name(requirement.name)] = Version(only.version)
        except (InvalidRequirement, InvalidVersion, ValueError) as error:
            raise NotRun(f"{lock}:{number}: {text!r} pins no version -> write name==version") from error
    return found


def _read(path: Path) -> str:
    try:
        return path.read_text(encoding="utf-8")
    except (OSError, UnicodeDecodeError) as error:
        raise NotRun(f"{path} cannot be read ({error})") from error


def _documents(place: Path) -> Iterator[Any]:
    """JSON documents of a file, a folder or a zip archive."""
    try:
        if zipfile.is_zipfile(place):
            with zipfile.ZipFile(place) as archive:
                yield from (json.loads(archive.read(n)) for n in archive.namelist() if n.endswith(".json"))
        else:
            if place.is_file() and place.read_bytes()[:2] == _BEGIN_OF_ZIP:
                raise NotRun(f"{place} is no whole zip archive -> fetch it again")
            files = sorted(place.rglob("*.json")) if place.is_dir() else [place]
            yield from (json.loads(_read(file)) for file in files)
    except (OSError, ValueError, zipfile.BadZipFile) as error:
        raise NotRun(f"{place} is no advisory database ({error})") from error


def database(place: Path) -> tuple[list[Advisory], datetime.datetime]:
    """Advisories on Python packages, and when the newest was written."""
    advisories: list[Advisory] = []
    dates: list[datetime.datetime] = []
    try:
        for document in _documents(place):
            if "$meta" in document:
                moment = document["$meta"]["timestamp"]
                dates.append(datetime.datetime.fromtimestamp(moment, datetime.UTC))
                advisories += _of_safety_db(document)
            elif of_record := list(_of_osv(document)):
                moment = datetime.datetime.fromisoformat(document["modified"])
                dates.append(moment if moment.tzinfo else moment.replace(tzinfo=datetime.UTC))
                advisories += of_record
    except (KeyError, TypeError, AttributeError, ValueError) as error:
        raise NotRun(f"{place} holds what is neither OSV nor Safety DB ({error!r})") from error
    if not advisories:
        raise NotRun(f"{place} holds no advisory on a Python package -> give OSV's PyPI/all.zip")
    return advisories, max(dates)


def _of_safety_db(document: dict[str, Any]) -> Iterator[Advisory]:
    for package, records in document.items():
        if package != "$meta":
            for each in records:
                name = each.get("cve") or each["id"]
                yield Advisory(canonicalize_name(package), name, each["advisory"], {"specs": each["specs"]})


def _of_osv(record: dict[str, Any]) -> Iterator[Advisory]:
    if "id" not in record:
        raise KeyError("id")
    for affected in [] if "withdrawn" in record else record.get("affected", []):  # optional in OSV
        package = affected.get("package", {})
        if package.get("ecosystem") == "PyPI":
            text = record.get("summary") or record.get("details", "")
            yield Advisory(canonicalize_name(package["name"]), record["id"], text, affected)


def packaged() -> Path:
    """The database of the package ``safety-db``, where it is installed."""
    spec = importlib.util.find_spec("safety_db")
    if spec is None or spec.origin is None:
        raise NotRun("there is no advisory database -> make audit ADVISORIES=all.zip (docs/how-to/audit.md)")
    return Path(spec.origin).with_name("insecure_full.json")


def findings(versions: dict[str, Version], advisories: Iterable[Advisory]) -> list[str]:
    """One line for each advisory that concerns a pinned version, or may."""
    lines = set()
    for each in advisories:
        version = versions.get(canonicalize_name(each.package))
        verdict = False if version is None else each.affects(version)
        if verdict is not False:
            said = " ".join(each.text.split())[:100] if verdict else UNTOLD
            lines.add(f"{each.package} {version}: {each.name}: {said}")
    return sorted(lines)


def audit(lock: Path, place: Path | None, now: datetime.datetime) -> tuple[int, list[str]]:
    """Exit code, and lines to print; the last one begins with the outcome."""
    try:
        versions = pinned(lock)
        advisories, newest = database(place or packaged())
        days = (now - newest).days
        if days < -1:
            raise NotRun(f"the newest advisory is of {newest:%Y-%m-%d}, in the future -> set the clock")
    except NotRun as error:
        return NOT_RUN, [f"not run: {error}"]
    against = f"{len(versions)} versions, {len(advisories)} advisories, the newest of {newest:%Y-%m-%d}"
    old = f" ({days} days ago, over {MOST_DAYS}: newer ones are unknown)" if days > MOST_DAYS else ""
    found = findings(versions, advisories)
    if found:
        return VULNERABLE, [*found, f"vulnerable: {len(found)} findings in {against}{old}"]
    if old:
        return STALE, [f"stale: nothing found in {against}{old}"]
    return CLEAN, [f"clean: nothing found in {against}"]


def main() -> int:
    """Print the outcome."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument("--lock", type=Path, default=Path("requirements.lock"))
    parser.add_argument(
        "--advisories", type=Path, help="OSV records (.json, folder, .zip) or Safety DB's JSON"
    )
    arguments = parser.parse_args()
    code, lines = audit(arguments.lock, arguments.advisories, datetime.datetime.now(datetime.UTC))
    print(*lines, sep="\n")
    return code


if __name__ == "__main__":
    sys.exit(main())
