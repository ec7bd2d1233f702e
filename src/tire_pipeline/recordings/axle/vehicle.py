"""The data of a vehicle that turn its motion into axle forces."""

from __future__ import annotations

import math
from dataclasses import dataclass, fields

from tire_pipeline.errors import RecordingError
from tire_pipeline.unit_definitions import GRAVITY

LARGEST_ROLL_GRADIENT = 0.05
"""rad per m/s^2: 28 deg per g, several times that of soft cars."""


@dataclass(frozen=True)
class Vehicle:
    """A single-track vehicle: masses, lengths, inertia, and how well each is known.

    Parameters
    ----------
    mass : float
        Total mass, kg.
    front_mass : float
        Static mass on the front axle, kg; the rear axle carries the rest.
    wheelbase : float
        Distance between the axles, m.
    yaw_inertia : float
        About the vertical axis through the centre of gravity, kg m^2.
    yaw_inertia_std : float, optional
        Its standard uncertainty. Left out: 20% of the value, as it is hardly ever measured.
    axle_mass_std : float, optional
        Standard uncertainty of the mass that each axle carries, kg.
    track : float, optional
        Distance between left and right wheels, m: what the load that one takes over from the other rests on.
    cg_height, cg_height_std : float, optional
        Height of the centre of gravity, m. Without it no load is transferred between the axles.
    marker_offset, marker_lateral : float, optional
        Where the recorded position lies: metres ahead of the rear axle, and to the left.
    marker_offset_std : float, optional
        Standard uncertainty of ``marker_offset``, m.
    yaw_offset, yaw_offset_std : float, optional
        Added to the recorded yaw to get the vehicle's heading, rad, and its uncertainty.
    front_drive_share : float, optional
        Share of the total longitudinal force that the front axle carries (0 to 1). Without it there is no
        `fx`.
    roll_gradient : float, optional
        Roll of the body under lateral acceleration, rad per m/s^2 (6 deg per g: 0.0107). An accelerometer
        that leans with the body feels a part of gravity, which is taken off. 0 for one that is kept level.
    wheel_radius : float, optional
        Effective rolling radius, m, for wheel speeds in rad/s.

    Raises
    ------
    RecordingError
        A length, mass or inertia is not positive, or a value is not finite.

    See Also
    --------
    axle_recording : Needs it to turn a drive into forces of an axle.

    Notes
    -----
    The centre of gravity lies ``wheelbase * (1 - front_mass / mass)`` behind the front axle. Axes are those
    of ISO 8855: x ahead, y to the left, z up. What is worth measuring: docs/reference/recordings.md.

    Examples
    --------
    >>> car = Vehicle(mass=1500.0, front_mass=825.0, wheelbase=2.7, yaw_inertia=2400.0)
    >>> round(car.front_length, 3), round(car.rear_length, 3)
    (1.215, 1.485)
    """

    mass: float
    front_mass: float
    wheelbase: float
    yaw_inertia: float
    yaw_inertia_std: float | None = None
    axle_mass_std: float = 0.0
    track: float | None = None
    cg_height: float | None = None
    cg_height_std: float = 0.0
    marker_offset: float = 0.0
    marker_lateral: float = 0.0
    marker_offset_std: float = 0.0
    yaw_offset: float = 0.0
    yaw_offset_std: float = 0.0
    front_drive_share: float | None = None
    wheel_radius: float | None = None
    roll_gradient: float = 0.0

    def __post_init__(self) -> None:
        for field in fields(self):
            value = getattr(self, field.name)
            if value is not None and not math.isfinite(value):
                raise RecordingError(f"Vehicle.{field.name} is {value}", todo="use a finite number")
        for name in ("mass", "front_mass", "wheelbase", "yaw_inertia"):
            if getattr(self, name) <= 0:
                raise RecordingError(
                    f"Vehicle.{name} is {getattr(self, name)}", todo="use a positive number (SI)"
                )
        if not 0 <= self.roll_gradient <= LARGEST_ROLL_GRADIENT:
            raise RecordingError(f"Vehicle.roll_gradient is {self.roll_gradient}", todo="use rad per m/s^2")
        if self.front_mass >= self.mass:
            raise RecordingError(
                f"the front axle carries {self.front_mass} kg of {self.mass} kg in all",
                todo="front_mass must be below mass",
            )

    @property
    def front_length(self) -> float:
        """Distance from the centre of gravity to the front axle, m."""
        return self.wheelbase * (1.0 - self.front_mass / self.mass)

    @property
    def rear_length(self) -> float:
        """Distance from the centre of gravity to the rear axle, m."""
        return self.wheelbase * self.front_mass / self.mass

    @property
    def felt_acceleration(self) -> float:
        """Lateral acceleration that a sensor on the rolling body shows, over the true one."""
        return 1.0 + GRAVITY * self.roll_gradient

    @property
    def inertia_std(self) -> float:
        """Standard uncertainty of the yaw inertia, kg m^2."""
        return 0.2 * self.yaw_inertia if self.yaw_inertia_std is None else self.yaw_inertia_std
