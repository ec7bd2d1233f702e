"""A parameter that nothing knows is an error with the nearest name, never ignored."""

from __future__ import annotations

import re
from collections.abc import Collection, Iterable, Mapping
from pathlib import Path
from typing import Any

import yaml
from kedro.config import OmegaConfigLoader
from kedro.framework.hooks import hook_impl
from omegaconf.resolvers import oc

from tire_pipeline.errors import DomainError, did_you_mean
from tire_pipeline.kedro_runs.unknown_environment import check_environment

_RUNTIME = re.compile(r"\$\{runtime_params:\s*(\w+)")


class UnknownParameterHooks:
    """Checks the environment, and the top-level names of parameters, before anything runs."""

    @hook_impl(tryfirst=True)
    def after_context_created(self, context: Any) -> None:
        """Refuse a name that neither the folders, the parameters nor the catalog know."""
        check_environment(context.config_loader)
        check_files(context.config_loader)
        asked = dict(context.config_loader.runtime_params or {})
        if asked:
            check_names(asked, *known_names(context.config_loader))
            check_values(asked, _asked_at_run_time(context.config_loader))


def check_values(asked: Mapping[str, Any], needed: Collection[str]) -> None:
    """Refuse ``--params tir_folder=``, which an empty variable of the shell makes.

    Raises
    ------
    DomainError
        A value is missing that the catalog needs.
    """
    for name in sorted(needed):
        if name in asked and asked[name] in (None, ""):
            raise DomainError(
                f"{name!r} has no value", where="--params", todo=f"write it behind the sign: {name}=..."
            )


def check_files(loader: OmegaConfigLoader) -> None:
    """Check the top-level names in every file of parameters of a run.

    ``base`` says what there is: a pipeline's own file has its name, and ``parameters.yml`` the names that
    pipelines share. Another environment only gives other values.

    Raises
    ------
    DomainError
        A name is unknown; it names the file and the nearest one.
    """
    conf = Path(loader.conf_source)
    base = {file: _written(file) for file in _files(loader, loader.base_env)}
    known = {file.stem for file in base if file.parent.name == "parameters"}
    known = known.union(*(set(values) for file, values in base.items() if file.parent.name != "parameters"))
    below = {
        f"{top}.{name}"
        for values in base.values()
        for top in known
        for name in (values[top] if isinstance(values.get(top), dict) else ())
    }
    at_run_time = _asked_at_run_time(loader)
    here = {file: _written(file) for file in _files(loader, loader.env or loader.default_run_env)}
    for file, values in (base | here).items():
        where = f"{conf.name}/{file.relative_to(conf).as_posix()}"
        for name in at_run_time.difference(known).intersection(values):
            raise DomainError(
                f"{name!r} is not read from a file of parameters",
                where=where,
                todo=f"give it on the command line: --params {name}=...",
            )
        check_names([name for name in values if not name.startswith("_")], known, below, where)


def _files(loader: OmegaConfigLoader, environment: str) -> list[Path]:
    """The files of parameters of one environment, as ``config_patterns`` in the settings name them."""
    folder = Path(loader.conf_source) / environment
    found = [file for kind in ("yml", "yaml", "json") for file in folder.rglob(f"*.{kind}")]
    return sorted(
        file
        for file in found
        if file.name.startswith("parameters") or file.relative_to(folder).parts[0].startswith("parameters")
    )


def _written(file: Path) -> dict[str, Any]:
    """What a file holds at the top level; nothing if it cannot be read, which Kedro tells."""
    try:
        values = yaml.safe_load(file.read_text(encoding="utf-8"))
    except (yaml.YAMLError, UnicodeError):
        return {}
    return {str(name): value for name, value in values.items()} if isinstance(values, dict) else {}


def _asked_at_run_time(loader: OmegaConfigLoader) -> set[str]:
    """Names that the catalog takes from ``--params``."""
    files = Path(loader.conf_source).rglob("*.yml")
    return {name for file in files for name in _RUNTIME.findall(file.read_text(encoding="utf-8"))}


def known_names(loader: OmegaConfigLoader) -> tuple[set[str], set[str]]:
    """Top-level names of all parameters and those that the catalog asks for at run time; names below them.

    Names below are dotted, such as ``translate.only``.
    """
    plain = OmegaConfigLoader(
        conf_source=loader.conf_source,
        env=loader.env,
        base_env=loader.base_env,
        default_run_env=loader.default_run_env,
        config_patterns=loader.config_patterns,
        merge_strategy=loader.merge_strategy,
        custom_resolvers={"oc.env": oc.env},
    )
    parameters = plain["parameters"]
    names = {str(name) for name in parameters} | _asked_at_run_time(loader)
    below = {
        f"{top}.{name}" for top, values in parameters.items() if isinstance(values, dict) for name in values
    }
    return names, below


def check_names(asked: Iterable[str], known: set[str], below: Iterable[str], where: str = "--params") -> None:
    """Check names of parameters at the top level.

    Parameters
    ----------
    asked : iterable of str
    known : set of str
        At the top level.
    below : iterable of str
        Dotted names below them, to be suggested.
    where : str
        Where they were written.

    Raises
    ------
    DomainError
        A name is unknown; it names the nearest one.
    """
    for name in asked:
        if str(name) not in known:
            same = sorted(each for each in below if each.rpartition(".")[2] == str(name))
            raise DomainError(
                f"there is no parameter {name!r}",
                where=where,
                todo=f"did you mean {' or '.join(map(repr, same))}?"
                if same
                else did_you_mean(
                    str(name), sorted(known), f"use one of {', '.join(sorted(known))}", cutoff=0.5
                ),
            )
