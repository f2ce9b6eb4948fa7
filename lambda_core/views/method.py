"""Define comparison methods of plugins.

A method answers the same question as the simulation by other means (a catalogue formula, a standard, an analytical
model) and is compared with it. It gets plain numbers (:class:`MethodInputs`) and returns a table of named values with
units (:class:`MethodTable`), so that a new method is one small function.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass
from typing import Literal

import numpy as np

from lambda_core.domain.errors import LambdaError, unknown_name
from lambda_core.domain.lubrication import Lubrication
from lambda_core.domain.plugin_errors import PluginError, blamed, went_on_without
from lambda_core.elements.roller.roller_bearing import RollerBearing
from lambda_core.elements.roller.roller_equilibrium import RollerEquilibrium
from lambda_core.elements.roller.roller_friction import OilState, RollerFriction
from lambda_core.laws.context import Material, Oil

METHOD_API = 1

Group = Literal["friction", "capacitance", "life", "rating", "kinematics", "stiffness", "load"]

# The unit in which every method states a quantity of a group, so that rows can stand side by side.
GROUP_UNITS: dict[str, tuple[str, ...]] = {
    "friction": ("N mm", "-"),
    "capacitance": ("pF", "um", "mm2", "GPa", "-"),
    "life": ("h", "1e6 rev", "N", "-"),
    "rating": ("N", "-"),
    "kinematics": ("Hz", "1/rev", "rpm", "-"),
    "stiffness": ("N/um", "N m/mrad", "N/mrad"),
    "load": ("N", "deg", "um", "-"),
}


class NotApplicable(LambdaError):
    """Method that cannot answer for this case.

    The sentence has the reason; the other methods go on.
    """

    exit_code = 3


@dataclass(frozen=True)
class ContactLoad:
    """Loads of one ball in the quasi-static equilibrium, SI."""

    azimuth: float  # from +y towards +z [rad]
    load_inner: float  # normal load of the ball-inner contact [N]
    load_outer: float  # normal load of the ball-outer contact [N]
    angle_inner: float  # contact angle [rad]
    angle_outer: float  # [rad]


@dataclass(frozen=True)
class EquilibriumState:
    """The quasi-static solution as methods see it, SI."""

    contacts: tuple[ContactLoad, ...]  # ball by ball; of four-point contact of one pair of arcs, then of the other
    displacement: tuple[float, float, float, float, float]  # inner ring x, y, z [m], tilt_y, tilt_z [rad]
    # 5 x 5, rows of d(load)/d(displacement) in the same order [N/m, N/rad, N m/rad]; None when not computed
    stiffness: tuple[tuple[float, ...], ...] | None = None
    friction: tuple[tuple[str, float], ...] = ()  # (part, friction torque [N m]) of the quasi-static solver


@dataclass(frozen=True)
class MethodInputs:
    """Inputs of a method.

    They are plain SI numbers, frozen; None means that the case has no value.
    """

    title: str  # the bearing for people: "6319 (Syla2026)"
    series: str  # "60", "62", "63", "64", "618", "619", "70", "72", "73" or "" when unknown
    bore_diameter: float  # [m]
    outside_diameter: float  # [m]
    width: float  # [m]
    ball_count: int  # Z
    ball_diameter: float  # [m]
    pitch_diameter: float  # [m]
    groove_radius_inner: float  # [m]
    groove_radius_outer: float  # [m]
    ball: Material  # of the balls
    inner_ring: Material  # of the inner ring
    outer_ring: Material  # of the outer ring
    oil: Oil  # viscosity, density, alpha_p and beta filled in at the bulk temperature
    radial_load: float  # magnitude [N]
    axial_load: float  # magnitude [N]
    inner_speed: float  # signed [rad/s]
    outer_speed: float  # signed [rad/s]
    dynamic_rating: float | None = None  # C [N]
    static_rating: float | None = None  # C_0 [N]
    fatigue_limit: float | None = None  # C_u [N]
    contamination: float | None = None  # e_C of ISO 281, 0..1
    lubrication: Lubrication = "oil bath"  # "oil bath", "oil jet", "under-race", "oil-air", "grease"
    oil_level: float | None = None  # above the lowest point of the pitch circle [m]
    drag_volume_factor: float | None = None  # V_M of SKF, read from its chart at H/d_m
    drag_edition: Literal["2008", "2018"] = "2018"  # edition of SKF's drag formula, to which V_M belongs
    permittivity: Callable[[float], float] | None = None  # pressure [Pa] -> eps_r at the bulk temperature
    state: EquilibriumState | None = None  # quasi-static loads, displacement, stiffness and friction
    designation: str = ""  # as it is written, with its suffixes
    shoulder_diameter_inner: float | None = None  # of the inner ring, on which lips of seals slide [m]
    contact_angle: float = 0.0  # free one of an angular contact bearing, which ratings go by; 0: radial contact [rad]
    rated_rows: int = 1  # of balls, by which the standards rate it: two of four-point contact, a pair of arcs each
    on_sphere: bool = False  # whether the outer raceway is one sphere for two rows

    @property
    def mean_diameter(self) -> float:
        """Mean diameter d_m [m].

        It is (d + D)/2 of the catalogues, not the pitch diameter.
        """
        return 0.5 * (self.bore_diameter + self.outside_diameter)

    @property
    def relative_speed(self) -> float:
        """|Omega_i - Omega_o| [rad/s]."""
        return abs(self.inner_speed - self.outer_speed)

    @property
    def kinematic_viscosity(self) -> float:
        """Kinematic viscosity at the bulk temperature [m2/s]."""
        return self.oil.viscosity / self.oil.density


@dataclass(frozen=True)
class RollerMethodInputs:
    """Inputs of a method for rollers.

    They are plain SI numbers, frozen.
    """

    title: str  # the bearing for people: "NU 208 (SKF)"
    bearing: RollerBearing  # its inner geometry, at operating clearance
    oil: OilState  # at the bulk temperature
    base_type: str  # of the oil, "mineral" ...
    radial_load: float  # magnitude [N]
    axial_load: float  # magnitude [N]
    inner_speed: float  # signed [rad/s]
    outer_speed: float  # signed [rad/s]
    lubrication: Lubrication  # "oil bath", "oil jet", "under-race", "oil-air", "grease"
    oil_height: float  # above the lowest point of the outer raceway [m]; 0: no bath
    state: RollerEquilibrium  # quasi-static loads of slices and ribs
    friction: RollerFriction | None  # of the program's own; None at rest
    contamination: float | None = None  # e_C of ISO 281, 0..1

    @property
    def relative_speed(self) -> float:
        """|Omega_i - Omega_o| [rad/s]."""
        return abs(self.inner_speed - self.outer_speed)


@dataclass(frozen=True)
class MethodRow:
    """One number of a method.

    It has a unit of its group (:data:`GROUP_UNITS`).
    """

    group: Group  # "friction", "capacitance", "life", "rating", "kinematics", "stiffness", "load"
    name: str  # "total", "rolling", "sliding", ...; equal names of two methods stand side by side
    value: float  # in `unit`
    unit: str  # one of the group's
    meaning: str = ""  # one line for people

    def __post_init__(self) -> None:
        if self.unit not in GROUP_UNITS[self.group]:
            raise ValueError(
                f'"{self.unit}" is not a unit of {self.group}; allowed: {", ".join(GROUP_UNITS[self.group])}'
            )


@dataclass(frozen=True)
class MethodTable:
    """Result of a method.

    It has rows and its assumptions.
    """

    rows: tuple[MethodRow, ...]  # in the order in which they are shown
    assumptions: tuple[str, ...] = ()

    def value(self, group: str, name: str) -> float:
        """Return one number.

        Raises
        ------
        LookupError
            If the table has no such row; the message lists the nearest names.
        """
        for row in self.rows:
            if row.group == group and row.name == name:
                return row.value
        known = [f"{row.group} {row.name}" for row in self.rows]
        raise LookupError(unknown_name("row of this method", f"{group} {name}", known))


def rollers_only(inputs: MethodInputs) -> MethodTable:
    """Refuse ball bearings.

    It is the `evaluate` of a method about rollers alone.
    """
    raise NotApplicable("is about roller bearings")


@dataclass(frozen=True)
class Method:
    """A comparison method.

    Attributes
    ----------
    name : str
        Short and unique: "skf".
    title : str
        One line for people.
    reference : str
        Publication and equation numbers.
    evaluate : callable
        ``evaluate(inputs: MethodInputs) -> MethodTable``; raises :class:`NotApplicable` with a sentence when the
        method does not cover the case.
    validity : str
        Cases that it is made for.
    method_api : int
        Version of this interface that it is written for, as a number: 1. Without it the method is refused.
    evaluate_rollers : callable, optional
        ``evaluate_rollers(inputs: RollerMethodInputs) -> MethodTable`` for roller bearings; without it the method is
        about ball bearings alone.
    """

    name: str
    title: str
    reference: str
    evaluate: Callable[[MethodInputs], MethodTable]
    validity: str = ""
    method_api: int | None = None
    evaluate_rollers: Callable[[RollerMethodInputs], MethodTable] | None = None
    distribution: str = ""  # filled by the registry

    def is_about(self, *, rollers: bool) -> bool:
        """Tell whether it answers for rollers, or for balls."""
        return self.evaluate_rollers is not None if rollers else self.evaluate is not rollers_only


@dataclass(frozen=True)
class MethodAnswer:
    """One method's answer to one case.

    A table, or the sentence why there is none.
    """

    method: Method
    table: MethodTable | None
    reason: str = ""
    failed: bool = False  # of its own, where others would answer


def evaluate_methods(methods: Iterable[Method], inputs: MethodInputs | RollerMethodInputs) -> tuple[MethodAnswer, ...]:
    """Ask every method.

    One that does not apply, or fails, answers with its reason and does not stop the others.
    """
    answers = []
    for method in methods:
        what = f'the method "{method.name}" ({method.distribution})'
        try:
            with blamed(what):
                table = _asked(method, inputs)
            if not isinstance(table, MethodTable):
                raise PluginError(f"{what} returns a {type(table).__name__}, not a MethodTable")
            for row in table.rows:
                if not isinstance(row, MethodRow):
                    raise PluginError(f"{what} returns a row that is a {type(row).__name__}, not a MethodRow")
                if not isinstance(row.value, int | float | np.number):
                    raise PluginError(f"{what} returns {row.group} {row.name} = {row.value!r}, which is not a number")
            answers.append(MethodAnswer(method, table))
        except NotApplicable as error:
            answers.append(MethodAnswer(method, None, str(error)))
        except PluginError as error:
            went_on_without(str(error))
            answers.append(MethodAnswer(method, None, str(error), failed=True))
    return tuple(answers)


def _asked(method: Method, inputs: MethodInputs | RollerMethodInputs) -> MethodTable:
    """Ask a method about balls or rollers.

    NotApplicable where it is about balls alone.
    """
    if not isinstance(inputs, RollerMethodInputs):
        return method.evaluate(inputs)
    if method.evaluate_rollers is None:
        raise NotApplicable("is about ball bearings")
    return method.evaluate_rollers(inputs)
