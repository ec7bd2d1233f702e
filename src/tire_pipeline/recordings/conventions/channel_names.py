"""Names by which files call a channel, and what they are called here."""

from __future__ import annotations

import re
import unicodedata
from dataclasses import dataclass

from tire_pipeline.recordings.conventions.foreign_names import foreign_names


@dataclass(frozen=True)
class Channel:
    """One canonical column: its dimension, SI unit and the names it goes by.

    `aliases` are compared as :func:`plain_name` has them; the earlier the better where a file has several.
    Names in other languages (:mod:`.foreign_names`) come after them.
    """

    name: str
    dimension: str
    unit: str
    aliases: tuple[str, ...]


# The columns that the whole project speaks of.
CANONICAL: tuple[Channel, ...] = (
    Channel("time", "time", "s", ("RUNTIME", "ET", "t", "timestamp", "elapsed time", "MEASTIME")),
    Channel(
        "slip_angle",
        "angle",
        "rad",
        ("SLIPANGL", "SA", "alpha", "slipang", "sideslip angle", "tire slip angle"),
    ),
    Channel(
        "slip_ratio",
        "ratio",
        "-",
        ("LONGSLIP", "SL", "SR", "kappa", "longitudinal slip", "longitudinal slip ratio", "slip"),
    ),
    Channel(
        "camber",
        "angle",
        "rad",
        ("INCLANGL", "IA", "gamma", "inclination", "camber angle", "inclination angle"),
    ),
    Channel(
        "normal_load",
        "force",
        "N",
        (
            *("FZW", "FZH", "FZ", "FZC", "vertical load", "vertical force", "normal force", "wheel load"),
            *("tire load", "tyre load", "load"),
        ),
    ),
    Channel(
        "speed",
        "speed",
        "m/s",
        (
            "LONGVEL",
            "TRAJVELW",
            "TRAJVELH",
            "TRAJVELC",
            "V",
            "VX",
            "velocity",
            "road speed",
            "belt speed",
            "vehicle speed",
        ),
    ),
    Channel(
        "pressure",
        "pressure",
        "Pa",
        ("INFLPRES", "P", "tire pressure", "tyre pressure", "inflation pressure"),
    ),
    Channel(
        "tread_temperature",
        "temperature",
        "degC",
        (
            *("TSTC", "TREDTEMP", "tread temp", "tire surface temperature", "tyre surface temperature"),
            *("tread temperature center", "tread temperature centre"),
        ),
    ),
    Channel("fx", "force", "N", ("FXW", "FXH", "FX", "FXC", "longitudinal force")),
    Channel("fy", "force", "N", ("FYW", "FYH", "FY", "FYC", "lateral force", "side force")),
    Channel("mx", "moment", "N m", ("MXW", "MXH", "MX", "MXC", "overturning moment")),
    Channel("my", "moment", "N m", ("MYW", "MYH", "MY", "MYC", "rolling resistance moment")),
    Channel(
        "mz",
        "moment",
        "N m",
        (
            "MZW",
            "MZH",
            "MZ",
            "MZC",
            "aligning moment",
            "aligning torque",
            "self aligning torque",
            "self aligning moment",
        ),
    ),
)

# Channels that are not canonical but whose dimension is known, so that their unit can be brought
# to SI. They keep their own name unless one is given here.
FURTHER: tuple[Channel, ...] = (
    Channel(
        "wheel_speed",
        "rate",
        "rad/s",
        (
            "WHROTSPD",
            "N",
            "omega",
            "wheel rotation speed",
            "wheel rotational speed",
            "wheel angular velocity",
        ),
    ),
    Channel("loaded_radius", "length", "m", ("RL", "DSTGRWHC", "LOADRAD")),
    Channel(
        "effective_radius",
        "length",
        "m",
        ("RE", "KROLRAD", "rolling radius", "effective rolling radius", "dynamic rolling radius"),
    ),
    Channel("tread_temperature_inner", "temperature", "degC", ("TSTI",)),
    Channel("tread_temperature_outer", "temperature", "degC", ("TSTO",)),
    Channel("ambient_temperature", "temperature", "degC", ("AMBTMP", "AMBITEMP")),
    Channel("surface_temperature", "temperature", "degC", ("RST", "TRCKTEMP")),
    Channel("turn_slip", "curvature", "1/m", ("TURNSLIP",)),
    Channel("simulated_fx", "force", "N", ("fx_simulated", "sim_fx")),
    Channel("simulated_fy", "force", "N", ("fy_simulated", "sim_fy")),
    Channel("simulated_mz", "moment", "N m", ("mz_simulated", "sim_mz")),
    Channel("steering", "angle", "rad", ("road wheel angle",)),
    Channel("yaw_rate", "rate", "rad/s", ()),
    Channel("lateral_acceleration", "acceleration", "m/s^2", ("LatAcc", "lateral accel", "lat accel")),
    Channel(
        "longitudinal_acceleration", "acceleration", "m/s^2", ("LongAcc", "longitudinal accel", "long accel")
    ),
    Channel("lateral_speed", "speed", "m/s", ()),
    Channel("sideslip", "angle", "rad", ("vehicle sideslip angle", "body slip angle")),
    Channel("wheel_surface_speed", "speed", "m/s", ()),
    Channel("load_transfer", "force", "N", ()),
)


def plain_name(name: str) -> str:
    """A name without case, accents, blanks, `_`, `-`, `.` and apostrophes.

    Examples
    --------
    >>> plain_name("Couple d'auto-alignement"), plain_name("Längskraft")
    ('coupledautoalignement', 'langskraft')
    """
    if not name.isascii():
        letters = unicodedata.normalize("NFD", name)
        name = "".join(each for each in letters if not unicodedata.combining(each))
    return _NOT_COMPARED.sub("", name).lower()


def _ranks() -> dict[str, tuple[Channel, int]]:
    table: dict[str, tuple[Channel, int]] = {}
    for channel in (*CANONICAL, *FURTHER):
        names = (channel.name, *channel.aliases, *foreign_names(channel.name))
        for rank, alias in enumerate(names):
            table.setdefault(plain_name(alias), (channel, rank))
    return table


_NOT_COMPARED = re.compile(r"[\s_.\-'\u2019]+")
_BETWEEN_NAMES = re.compile(r"[\s,()\[\]]+")
_RANK_OF_NAME = _ranks()


def find_channel(name: str) -> tuple[Channel, int] | None:
    """The channel that a name stands for, and how far down its list of aliases it is.

    A word with its symbol is one name: ``Radlast Fz``.

    Examples
    --------
    >>> find_channel("Slip Angle")[0].name, find_channel("Radlast Fz")[0].name
    ('slip_angle', 'normal_load')
    >>> find_channel("brake_pressure") is None, find_channel("Radlast Fy") is None
    (True, True)
    """
    return _RANK_OF_NAME.get(plain_name(name)) or _named_twice(name)


def _named_twice(name: str) -> tuple[Channel, int] | None:
    """The channel that both parts of a name stand for."""
    words = [word for word in _BETWEEN_NAMES.split(name) if word]
    for end in range(1, len(words)):
        first = _RANK_OF_NAME.get(plain_name("".join(words[:end])))
        second = _RANK_OF_NAME.get(plain_name("".join(words[end:])))
        if first and second and first[0] is second[0]:
            return min(first, second, key=lambda found: found[1])
    return None
