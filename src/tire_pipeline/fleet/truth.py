"""The sealed truth of a fleet: what the evaluation may see and nothing else may."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np
import pandas as pd

from tire_pipeline.fleet.rig.regimes import COMMON
from tire_pipeline.fleet.rig.true_forces import REFERENCE_TEMPERATURE, Contact, in_contact, lateral

TRUTH_LOADS = (4000.0, 6000.0, 8000.0)


@dataclass(frozen=True)
class FleetTruth:
    """Sealed truth.

    Attributes
    ----------
    first, second : dict of str to str
        ``<set>/<category>/<tire>.tir`` and text: every category's measurement of every evaluation
        tire, and its second measurement (own noise, same regime).
    tires : pandas.DataFrame
        Physical parameters of every tire, by tire.
    files : pandas.DataFrame
        For each training file: ``file``, ``file_role`` (kept, copy, missing, tiny), ``tire``,
        ``pressure``, ``wear``, ``protocol`` ...
    evaluation : pandas.DataFrame
        For each evaluation file: ``file``, ``set``, ``category``, ``tire``, ``protocol``, ``repeat``.
    regimes : dict
        Every regime in force, by ``category/protocol``.
    settings : dict
    curves : dict of str to dict of str to ndarray
        For each evaluation set: ``tire`` (n,), ``slip_angle`` (100,), ``normal_load`` (3,), ``fy`` and
        ``mz`` (n, 3, 100): steady state on the common surface at 60 degC, no rig.
    """

    first: dict[str, str]
    second: dict[str, str]
    tires: pd.DataFrame
    files: pd.DataFrame
    evaluation: pd.DataFrame
    regimes: dict[str, dict[str, float]]
    settings: dict[str, object]
    curves: dict[str, dict[str, np.ndarray]] = field(default_factory=dict)


def true_curves(tires: pd.DataFrame) -> dict[str, np.ndarray]:
    """Steady curves of the true tires on the common surface.

    Parameters
    ----------
    tires : pandas.DataFrame
        n rows of :func:`.tire_population.draw_tires`.

    Returns
    -------
    dict of str to ndarray
        As :attr:`FleetTruth.curves` says.
    """
    slip_angle = np.linspace(-0.25, 0.25, 100)
    loads = np.array(TRUTH_LOADS)
    shape = (len(tires), loads.size)
    one, zero = np.ones((1, 1)), np.zeros((1, 1))
    contact = Contact(
        normal_load=np.broadcast_to(loads, shape),
        camber=np.zeros(shape),
        pressure=one,
        wear=zero,
        adhesion=one,
        hysteresis=one,
        curvature=zero,
        conditioning=one,
    )
    true = in_contact(tires, contact)
    warm = np.full(shape, REFERENCE_TEMPERATURE)
    at = [lateral(true, np.full(shape, angle), COMMON.speed, warm) for angle in slip_angle]
    return {
        "tire": tires.index.to_numpy(dtype=str),
        "slip_angle": slip_angle,
        "normal_load": loads,
        "fy": np.stack([fy for fy, _ in at], axis=2),
        "mz": np.stack([mz for _, mz in at], axis=2),
    }
