"""Convert a tire model to another version of the Magic Formula."""

from __future__ import annotations

from tire_pipeline.errors import TirValueError, TirVersionError
from tire_pipeline.magic_formula.parameters.coefficients import NAMES_BY_FAMILY, family_of, is_possible
from tire_pipeline.magic_formula.parameters.tire_parameters import Tire, TireParameters

_CAMBER_Y = {"PDY3": 2, "PEY4": 1, "PKY3": 1, "PHY3": 1, "PVY3": 1, "PVY4": 1}
_CAMBER_Z = {"QBZ4": 1, "QBZ5": 1, "QDZ3": 1, "QDZ4": 2, "QDZ8": 1, "QDZ9": 1, "QEZ5": 1}
_CAMBER_Z.update({"QHZ3": 1, "QHZ4": 1})


def to_version(model: Tire, version: str) -> Tire:
    """Return the tire as a model of another version.

    Parameters
    ----------
    model : TireParameters
    version : str
        5.0, 5.1, 5.2 and PAC2002 convert into one another, so do 6.1 and 6.2, and each of the former into the
        latter.

    Returns
    -------
    TireParameters
        Of the class that came in. From 5.2 to 6.1, forces and moments stay as they are at every point;
        :func:`conversion_notes` says what does not, and what other software would see.

    Raises
    ------
    TirVersionError
        From 6.1 or 6.2 to an older version, or for an unknown version.
    TirValueError
        If ``LMX`` is 0.

    Notes
    -----
    Camber scale factors (``LGAX``, ``LGAY``, ``LGAZ``), which 6.1 lacks, go into the coefficients that
    multiply camber. The camber thrust of 6.1 (4.E27, 4.E30) must not shift the slip angle where 5.2 does not:
    PKY6 = PVY3 LMUY and PKY7 = PVY4 LMUY cancel its S_Vyg. Two things of 5.2 have no exact place in 6.1,
    and stay as extensions that only the equations here honour: the shift PHY3 gamma of (A.25), which does
    not depend on load as K_yg0 / K_ya must, stays in ``PHY3``; and ``QYZ1`` = 1 says that F'y of the
    aligning torque is taken at camber (A.65), not without it (4.E74).
    """
    old, new = model.family, family_of(version)
    if old == new:
        return _renamed(model, version, dict(model.coefficients))
    if old == 6:
        raise TirVersionError(
            f"a {model.version} model cannot be written as {version}: the older form has fewer terms",
            todo="fit a 5.2 model to its forces, as docs/tutorials/your_supplier_files.md shows",
        )
    return _renamed(model, version, _as_61(model))


def conversion_notes(model: TireParameters, version: str) -> list[str]:
    """Return what :func:`to_version` cannot keep.

    Parameters
    ----------
    model : TireModel
        What would be changed; it stays as it is.
    version : str
        The version to change to.

    Returns
    -------
    list of str
        One plain sentence each; empty if all is kept.

    Raises
    ------
    TirVersionError
        If the version is unknown.

    See Also
    --------
    to_version : The change itself.

    Notes
    -----
    5.2: Appendix A of the thesis. 6.1: Pacejka, Tire and Vehicle Dynamics, 3rd edition, section 4.3.2.

    Examples
    --------
    >>> from tire_pipeline.magic_formula import TireModel
    >>> tire = TireModel.from_coefficients(
    ...     {"FNOMIN": 4000, "PCY1": 1.3, "PDY1": 1.0, "PKY1": -20, "PKY2": 2}
    ... )
    >>> conversion_notes(tire, "5.2")
    []
    """
    if model.family == family_of(version):
        return []
    notes = []
    if model.value("PHY3") != 0:
        notes.append(
            "PHY3 has no exact place in 6.1 and is kept as an extension: "
            "software that ignores it shifts Fy over camber differently."
        )
    if any(model.value(name) != 0 for name in ("PHY3", "PVY3", "PVY4", "PDY3", "PEY4", "PKY3")):
        notes.append(
            "QYZ1 = 1 is an extension: software that ignores it gives another Mz at camber, "
            "because 6.1 takes the trail times Fy without camber (4.E74)."
        )
    if model.value("QSY1") == 0 and model.value("QSY2") == 0:
        notes.append("My becomes 0: 6.1 has no rolling resistance from Fx at free rolling (A.72).")
    return notes


def _renamed(model: Tire, version: str, coefficients: dict[str, float]) -> Tire:
    return type(model)(
        version=version,
        coefficients=coefficients,
        metadata=dict(model.metadata),
        source=model.source,
        path=model.path,
    )


def _as_61(model: TireParameters) -> dict[str, float]:
    used = {name: model.value(name) for name in NAMES_BY_FAMILY[5]}
    used = {name: value for name, value in used.items() if is_possible(name, value)}
    if used["LMX"] == 0:
        raise TirValueError("LMX = 0: QSX1 cannot be kept in 6.1", key="LMX", path=model.path)
    lgax, lgay, lgaz = (used.pop(name) for name in ("LGAX", "LGAY", "LGAZ"))
    used["PDX3"] *= lgax**2
    for name, power in _CAMBER_Y.items():
        used[name] *= (abs(lgay) if name == "PKY3" else lgay) ** power
    for name, power in _CAMBER_Z.items():
        used[name] *= (abs(lgaz) if name == "QBZ5" else lgaz) ** power
    used["QSX1"] /= used["LMX"]
    used.update(PKY4=2.0, PKY5=0.0, PKY6=used["PVY3"] * used["LMUY"], PKY7=used["PVY4"] * used["LMUY"])
    used.update(QSY7=1.0, QSY8=0.0, QYZ1=1.0)
    if used["QSY1"] == 0 and used["QSY2"] == 0:
        used["QSY3"] = used["QSY4"] = 0.0
    others = {
        name: value
        for name, value in model.coefficients.items()
        if name not in used and name not in ("LGAX", "LGAY", "LGAZ", *NAMES_BY_FAMILY[6])
    }
    pressures = {n: model.coefficients[n] for n in ("NOMPRES", "INFLPRES") if n in model.coefficients}
    return {**used, **others, **pressures}
