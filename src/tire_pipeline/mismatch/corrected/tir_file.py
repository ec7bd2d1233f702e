"""Contents of a corrected ``.tir`` file and its sidecar, and the comment at the file's top."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from tire_pipeline.mismatch.effects import catalogue
from tire_pipeline.mismatch.model.forces import Change
from tire_pipeline.mismatch.model.nominal import Reference
from tire_pipeline.mismatch.model.residual import partly
from tire_pipeline.mismatch.unnamed_physics.found import UnnamedPhysics

_ENTRY_OF_EQUATION = "unnamed"


def with_coefficients(
    tire: Any, changes: Sequence[Change], part: float, reference: Reference, unnamed: UnnamedPhysics | None
) -> tuple[Any, dict[str, dict[str, object]]]:
    """Return a tire model with all effects that its format has a place for, and the rest.

    Parameters
    ----------
    tire : TireModel
    changes : sequence of (name, parameters)
        Effects with their parameters in SI.
    part : float
        Share of the effects' change that is added.
    reference : Reference
    unnamed : UnnamedPhysics or None

    Returns
    -------
    tire : TireModel
    sidecar : dict
        Effect -> equation, parameters and reference values, for what a ``.tir`` cannot hold; ``part`` if that
        is not 1. Artefacts belong to the recording, not to the tire, and are in neither.
    """
    sidecar: dict[str, dict[str, object]] = {}
    for name, p in changes:
        effect = catalogue()[name]
        if effect.kind == "artefact":
            continue
        coefficients = effect.coefficients(tire, p)
        if coefficients:
            without = effect.coefficients(tire, dict.fromkeys(p, 0.0))
            tire = tire.replace(**_between(without, coefficients, part))
        else:
            sidecar[name] = {
                "equation": effect.equation,
                "source": effect.source,
                "parameters": {k: float(v) for k, v in p.items()},
                "reference": reference.to_sidecar(),
                **({"part": part} if part < 1.0 else {}),
            }
    if unnamed is not None:
        sidecar[_ENTRY_OF_EQUATION] = unnamed.to_sidecar()
    return tire, sidecar


def comments(
    changes: Sequence[Change],
    part: float,
    others: Sequence[Sequence[Change]],
    sidecar: Mapping[str, object],
) -> list[str]:
    """Return the comment at the top of a file: physics, where it is stored, and faults of the recording.

    Parameters
    ----------
    changes : sequence of (name, parameters)
    part : float
        Share of the effects' change that is added.
    others : sequence of sequences of (name, parameters)
        Other explanations that are open.
    sidecar : mapping
        Of :func:`with_coefficients`.
    """
    names = [name for name, _ in changes]
    physics = [name for name in names if catalogue()[name].kind != "artefact"]
    inside = [name for name in physics if name not in sidecar]
    faults = [name for name in names if name not in physics]
    said = ["corrected by tire_pipeline.mismatch"]
    said += [f"physics in these coefficients: {', '.join(inside) or 'none'}"]
    beside = [name for name in sidecar if name != _ENTRY_OF_EQUATION]
    said += [f"physics in the sidecar beside this file: {', '.join(beside)}"] if beside else []
    if part < 1.0:
        said.append(f"added: {part:.0%} of what was found, as much as unseen sweeps confirm")
    if others:
        open_ones = "; ".join(" and ".join(name for name, _ in each) for each in others)
        said.append(f"the recording does not tell {' and '.join(names)} from: {open_ones}")
    if _ENTRY_OF_EQUATION in sidecar:
        said.append("unexplained residual, by an empirical equation: in the sidecar beside this file")
    said += [f"faults of the recording, not in this file: {', '.join(faults)}"] if faults else []
    return said


def _between(without: Mapping[str, float], full: Mapping[str, float], part: float) -> dict[str, float]:
    """Return coefficients between those without an effect and those with all of it."""
    if part == 1.0:
        return dict(full)
    return {n: partly(without.get(n, v), v, part) for n, v in full.items()}
