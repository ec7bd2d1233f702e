"""A parameter that nothing knows is an error with the nearest name, never ignored."""

from __future__ import annotations

import re
from collections.abc import Iterable
from pathlib import Path
from typing import Any

from kedro.config import OmegaConfigLoader
from kedro.framework.hooks import hook_impl
from omegaconf.resolvers import oc

from tire_pipeline.errors import DomainError, did_you_mean

_RUNTIME = re.compile(r"\$\{runtime_params:\s*(\w+)")


class UnknownParameterHooks:
    """Checks the top-level names of ``--params`` before anything runs."""

    @hook_impl(tryfirst=True)
    def after_context_created(self, context: Any) -> None:
        """Refuse a name that neither the parameters nor the catalog know."""
        asked = dict(context.config_loader.runtime_params or {})
        if asked:
            check_names(asked, *known_names(context.config_loader))


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
    names = {str(name) for name in parameters}
    for file in Path(loader.conf_source).rglob("*.yml"):
        names |= set(_RUNTIME.findall(file.read_text(encoding="utf-8")))
    below = {
        f"{top}.{name}" for top, values in parameters.items() if isinstance(values, dict) for name in values
    }
    return names, below


def check_names(asked: Iterable[str], known: set[str], below: Iterable[str]) -> None:
    """Check names of parameters at the top level.

    Parameters
    ----------
    asked : iterable of str
    known : set of str
        At the top level.
    below : iterable of str
        Dotted names below them, to be suggested.

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
                where="--params",
                todo=f"did you mean {' or '.join(map(repr, same))}?"
                if same
                else did_you_mean(
                    str(name), sorted(known), f"use one of {', '.join(sorted(known))}", cutoff=0.5
                ),
            )
