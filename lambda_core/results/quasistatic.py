"""Summarise the quasi-static equilibrium for the machine interface."""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any, Self

import numpy as np
from pydantic import Field, PrivateAttr

from lambda_core.domain.arrays import FloatArray
from lambda_core.domain.channels import LOSSES, RINGS
from lambda_core.domain.elements import ALONE
from lambda_core.domain.errors import UsageError, unknown_name
from lambda_core.domain.unit_systems import SI, UnitSystem
from lambda_core.formulas.between_rings import between_rings
from lambda_core.formulas.loading import CARRYING, Ring, largest_contact, loaded_elements
from lambda_core.model.checks.operating_limits import operating_warnings
from lambda_core.model.geometry.axial_play import axial_play
from lambda_core.model.laws.time_functions import initial
from lambda_core.results.answer import Answer, dataset, declared_numbers, drawn
from lambda_core.results.averages import finite
from lambda_core.results.bearing_summary import CONTACT_UNITS, BearingSummary, Contact, StartState
from lambda_core.results.limits import Grooves, Shoulder, shoulders, warnings
from lambda_core.results.model_band import Banded, ModelBand
from lambda_core.results.quantity import FLOATING, quantity, same_as, shown
from lambda_core.results.rating import Rating, rated_verdict
from lambda_core.results.record import INTERFACE, Record, by_bearing
from lambda_core.results.ring_shape import RingShape, ring_shape
from lambda_core.results.summary import capacitance_note, contact_list, merged_cage, span
from lambda_core.results.verdict import Verdict
from lambda_core.solver.arrays import bundle as L
from lambda_core.solver.drivers.equilibrium import Equilibrium
from lambda_core.solver.drivers.wave_tables import waves_at
from lambda_core.solver.records import CONTACT_CHANNELS

if TYPE_CHECKING:
    from lambda_core.model.bearing_model import BearingModel


class RollerLoad(Record):
    """Loads of one roller."""

    roller: int = Field(description="number of the roller, from 1")
    azimuth_deg: float
    inner_N: float
    outer_N: float
    rib_N: float = Field(description="largest load of a rib")
    tilt_mrad: float = Field(description="of the roller in its plane")
    max_line_load_N_mm: float = Field(description="largest load per length of a slice")


class RollerStatics(Record):
    """Numbers of an equilibrium that only rollers have."""

    kind: str
    full_complement: bool = Field(description="whether they have no cage", default=False)
    raceway_share: float | None = Field(description="of the raceways in the torque")
    rib_share: float | None = Field(description="of the ribs in the torque")
    heat_factor: float | None = Field(description="of inlet heating on the rolling resistance")
    supply_factor: float | None = Field(description="of replenishment on the rolling resistance")
    min_film_um: float | None = Field(description="smallest minimum film of the raceways under load", default=None)
    rib_load_N: float = Field(description="largest load of a rib")
    rib_pressure_GPa: float
    rib_film_um: float | None
    rib_friction: float | None = Field(description="coefficient of friction of the most loaded rib")
    inner_ring_moment_Nm: list[float] = Field(description="about y and z, that the rollers put on the shaft")
    axial_limit_N: float | None = Field(description="permissible constant axial load of ribs of cylindrical rollers")
    loads: list[RollerLoad] = Field(description="of every roller")


class BearingStatics(Banded):
    """Quasi-static equilibrium of a bearing, alone or in a machine.

    Its rolling elements are balls or rollers.

    Contacts, lives, friction and films without time; the cage is left out.

    Numbers that a ring at rest does not have (friction torque, film) are null.
    """

    title: str
    verdict: Verdict | None = Field(description="against required life and limits", default=None)
    loaded_elements: int = same_as(StartState, "loaded_elements")
    max_load_N: float = same_as(StartState, "max_load_N")
    max_load_ring: Ring = same_as(StartState, "max_load_ring")
    max_pressure_GPa: float = same_as(StartState, "max_pressure_GPa")
    contact_angle_deg: list[float] = quantity(
        "smallest and largest of the loaded contacts, sizes", "deg", label="contact angles", column="contact angles",
        decimals=FLOATING, digits=3, group="contact",
    )  # fmt: skip
    rating: Rating | None = Field(description="life, safety and catalogue friction", default=None)
    friction_torque_Nmm: float | None = same_as(BearingSummary, "friction_torque_Nmm")
    friction_breakdown_Nmm: dict[str, float | None] = Field(description="parts of friction_torque_Nmm")
    power_loss_W: float | None = same_as(
        BearingSummary, "power_loss_W", "of the friction, without the cage", default=None
    )
    orbit_speed_ratio: float | None = quantity(
        "mean orbital speed of the loaded elements over inner ring speed",
        label="orbital speed of the elements over inner ring speed", decimals=4, group="cage",
    )  # fmt: skip
    film_um: list[float] = same_as(BearingSummary, "film_um", "smallest and largest central film under load")
    film_parameter: list[float] = same_as(BearingSummary, "film_parameter", "smallest and largest Lambda under load")
    bearing_capacitance_nF: float | None = same_as(
        BearingSummary, "bearing_capacitance_nF", "null at rest and where asperities short an element", default=None
    )
    capacitance_note: str = Field(description="which contacts asperities short, where they do", default="")
    ring_shapes: list[RingShape] = Field(description="how elastic rings bend; empty where all are rigid", default=[])
    shoulders: list[Shoulder] = Field(description="how near contacts come to the shoulders, the worst on each ring")
    contacts: list[Contact] = Field(description="of every rolling element with each ring")
    rollers: RollerStatics | None = Field(description="what only rollers have; null of balls", default=None)
    warnings: list[str] = Field(
        description="where the case or the state leaves what bearing, oil and laws are made for"
    )

    @property
    def ring_displacement_um(self) -> list[float]:
        """Displacement x, y, z of the inner ring [um].

        On a shaft it is that against the outer ring.
        """
        raise NotImplementedError


class StaticAnswer(Answer):
    """Quasi-static equilibrium of any machine.

    It is a :class:`QuasiStatic` of a bearing that is alone, or a MachineEquilibrium of a shaft in its bearings. The
    two are solved for different unknowns: the poses of both rings, or those of a shaft with the reactions of such
    bearings. What holds for both is declared here, and what holds for a bearing of either in :class:`BearingStatics`.
    """

    interface: int = INTERFACE
    case: str = Field(description="name of the case")
    iterations: int = Field(description="of Newton's method")
    assumptions: list[str] = Field(description="assumed values and simplifications")
    _model: Any = PrivateAttr(default=None)

    def __getstate__(self) -> dict[Any, Any]:
        """Return the state without the model.

        Compiled laws cannot go to another process.
        """
        state = super().__getstate__()
        return state | {"__pydantic_private__": (state["__pydantic_private__"] or {}) | {"_model": None}}

    if TYPE_CHECKING:

        @property
        def bearings(self) -> Mapping[str, BearingStatics]:
            """Every bearing by its name; a field of machines."""

    def bearing(self, name: str) -> BearingStatics:
        """Return one bearing by its name.

        UsageError with the nearest name where there is none.
        """
        if name not in self.bearings:
            raise UsageError(unknown_name("bearing", name, self.bearings))
        return self.bearings[name]

    def warned(self) -> list[str]:
        """Return all warnings.

        Those of a bearing on a shaft begin with its name.
        """
        raise NotImplementedError

    def of_bearing(self, name: str | None = None) -> QuasiStatic:
        """Return the answer about one bearing.

        An only bearing needs no name; UsageError where a name is needed, or nothing has it.
        """
        raise NotImplementedError

    def with_bands(self, bands: Mapping[str, ModelBand]) -> Self:
        """Return the same with the model band of each bearing."""
        raise NotImplementedError

    def of_model(self, model: Any) -> Self:
        """Return this answer, which remembers its model for pictures."""
        self._model = model
        return self

    def solved(self) -> Any:
        """Return the model that was solved.

        UsageError for an equilibrium that was read from data.
        """
        if self._model is None:
            raise UsageError(f"{self.case}: this equilibrium has no model; solve its case again")
        return self._model

    def to_dict(self) -> dict[str, Any]:
        """Return plain data, ready for JSON."""
        return self.model_dump(mode="json")


class QuasiStatic(BearingStatics, StaticAnswer):
    """Quasi-static solution of one bearing.

    The bearing is alone, or belongs to a machine and has its place there, too.
    """

    headline: str
    inner_ring_displacement_um: list[float] = same_as(BearingSummary, "inner_ring_displacement_um", "x, y, z")
    axial_play_um: float | None = Field(
        description="from the middle to first contact without load: part of displacement x; null of two rows, and in a "
        "machine where x counts from first contact",
        default=None,
    )
    inner_ring_tilt_mrad: list[float] = same_as(BearingSummary, "inner_ring_tilt_mrad", "about y and z")

    @property
    def bearings(self) -> Mapping[str, BearingStatics]:
        """The only bearing by the name that results give it."""
        return {ALONE: self}

    @property
    def ring_displacement_um(self) -> list[float]:
        """Displacement x, y, z of the inner ring [um]."""
        return self.inner_ring_displacement_um

    def to_dict(self) -> dict[str, Any]:
        """Return plain data, ready for JSON.

        The numbers of the bearing are in ``bearings``, by its name, as in a machine.
        """
        (name,) = self.bearings
        around = ("headline", *StaticAnswer.model_fields)
        life = None if self.rating is None else self.rating.reference_life_h
        return by_bearing(self, name, around, ("friction_torque_Nmm", "friction_torque_Nmm_band"), system_life_h=life)

    def of_bearing(self, name: str | None = None) -> QuasiStatic:
        """Return the answer itself.

        UsageError for a name that is not that of its bearing.
        """
        return self if name is None else self.bearing(name)  # type: ignore[return-value]

    def own_lines(self, units: UnitSystem) -> list[str]:
        """Return lines of text that machines add."""
        return []

    def warned(self) -> list[str]:
        """Return all warnings."""
        return list(self.warnings)

    def with_bands(self, bands: Mapping[str, ModelBand]) -> Self:
        """Return the same with the model band of the bearing."""
        (own,) = bands.values()
        return self.with_band(own)

    def text(self, width: int | None = None, units: UnitSystem = SI) -> str:
        """Return the lines of text in some units.

        None is longer than `width` where one is given.
        """
        from lambda_core.results.text import quasistatic_text

        return quasistatic_text(self, width, units)

    def plot(self, name: str = "element-loads", **options: Any) -> Any:
        """Return a view as a matplotlib figure.

        It shows the equilibrium; default: the load of every rolling element.

        Returns
        -------
        matplotlib.figure.Figure
            ``savefig`` writes it.
        """
        return drawn(self._model, self, None, name, options)

    def to_xarray(self) -> Any:
        """Return contacts and numbers as an xarray.Dataset.

        Every variable has its unit; UsageError when xarray is not installed.

        Returns
        -------
        xarray.Dataset
            Dimension contact, with element, ring and azimuth; numbers of the bearing have dimension bearing.
        """
        data, labels = declared_numbers({self.case: self}, "bearing")
        for name, unit in CONTACT_UNITS.items():
            values = np.array([getattr(contact, name) for contact in self.contacts], dtype=float)
            data[name] = ("contact", values, {"units": unit})
        labels |= {
            "element": ("contact", [contact.element for contact in self.contacts]),
            "ring": ("contact", [contact.ring for contact in self.contacts]),
        }
        return dataset(data, labels, {"case": self.case, "title": self.title})

    def __repr__(self) -> str:
        """Return case, largest load and friction torque."""
        return f"<QuasiStatic {self.case}, {shown(self, 'max_load_N')}, {shown(self, 'friction_torque_Nmm')}>"


def quasistatic_of(found: Equilibrium, rating: Rating | None = None) -> QuasiStatic:
    """Put an equilibrium into the interface's units.

    The verdict needs its rating.
    """
    from lambda_core.model.checks.describe import headline

    model = found.context.model
    x, y, z, tilt_y, tilt_z = found.displacement
    own = bearing_statics(found, rating, math.hypot(tilt_y, tilt_z))
    return QuasiStatic(
        **own,
        case=model.name,
        headline="\n".join(headline(model)),
        inner_ring_displacement_um=[1e6 * value for value in (x, y, z)],
        axial_play_um=play_of(model),
        inner_ring_tilt_mrad=[1e3 * tilt_y, 1e3 * tilt_z],
        iterations=found.iterations,
        assumptions=list(model.assumptions),
    ).of_model(model)


def play_of(model: BearingModel) -> float | None:
    """Return the axial play of balls [um].

    None of two rows.
    """
    return 1e6 * axial_play(model, model.geometry.clearance) if model.geometry.rated_rows == 1 else None


def bearing_statics(found: Equilibrium, rating: Rating | None, tilt: float) -> dict[str, Any]:
    """Return the fields of :class:`BearingStatics`.

    Parameters
    ----------
    tilt : float
        Between the axes of the rings [rad]; of a bearing in a machine its equilibrium does not know it.
    """
    model = found.context.model
    channels = {name: found.contacts[:, :, i] for i, name in enumerate(CONTACT_CHANNELS)}
    load = channels["load"]
    carrying = load > CARRYING * load.max()
    largest, ring = largest_contact(load)
    losses = dict(zip(LOSSES, found.losses.tolist(), strict=True))
    speed = found.relative_speed
    edges: list[Shoulder] = []  # rollers touch ribs, not shoulders
    if model.rollers is None:
        grooves = Grooves.of(dataclasses.asdict(model.geometry))
        edges = shoulders(grooves, load, channels["contact_angle"], channels["semi_axis_a"])
    steady = speed > 0.0 and found.converged  # friction follows from a steady motion of the elements
    per_speed = {name: power / speed if steady else math.nan for name, power in losses.items()}
    pressure = float(channels["max_pressure"].max())
    if speed == 0.0:  # the laws are evaluated in slow motion, which rolls up a film that a bearing at rest has not
        channels |= {name: np.full_like(load, np.nan) for name in ("film_central", "film_parameter")}
    films = span(channels["film_parameter"][carrying])
    contacts = contact_list({**channels, "ball_azimuth": _azimuths(found)})
    return {
        "title": model.title,
        "verdict": rated_verdict(rating, 1e-9 * pressure, films, 1e3 * tilt),
        "loaded_elements": loaded_elements(load[:, RINGS.index("inner")]),
        "max_load_N": largest,
        "max_load_ring": ring,
        "max_pressure_GPa": 1e-9 * pressure,
        "contact_angle_deg": _angles(contacts, largest),
        "rating": rating,
        "friction_torque_Nmm": finite(1e3 * sum(per_speed.values())),
        "friction_breakdown_Nmm": merged_cage(per_speed),
        "power_loss_W": finite(float(found.losses.sum())) if steady else None,
        "orbit_speed_ratio": finite(_ratio(found)),
        "film_um": span(1e6 * channels["film_central"][carrying]),
        "film_parameter": films,
        "bearing_capacitance_nF": finite(1e9 * between_rings(channels["capacitance"])),
        "capacitance_note": capacitance_note(load, channels["capacitance"], model.elements[:-1]),
        "ring_shapes": _ring_shapes(found),
        "shoulders": edges,
        "contacts": contacts,
        "warnings": [
            *operating_warnings(model),
            *warnings(pressure, edges, tilt, model.geometry.kind.name),
            *unsteady_warnings(found),
        ],
    }


def unsteady_warnings(found: Equilibrium) -> list[str]:
    """Warn where friction has no equilibrium."""
    elements = found.context.model.elements
    return [] if found.converged else [f"the {elements} have no steady motion at this load: no friction torque"]


def _angles(contacts: Sequence[Contact], largest: float) -> list[float]:
    """Return the smallest and largest contact angle.

    They are absolute values, of contacts that carry at least 1 % of the largest load.
    """
    angles = [abs(one.contact_angle_deg) for one in contacts if one.load_N > 0.01 * largest]
    return [min(angles), max(angles)] if angles else []


def _ring_shapes(found: Equilibrium) -> list[RingShape]:
    """Return how the elastic rings bend."""
    context = found.context
    shapes = []
    for body, amplitudes in waves_at(context.bundle, context.model, context.shared_part(found.state)).items():
        if body == "cage":
            continue  # nothing pushes it in the equilibrium
        ring: Ring = "inner" if body == "inner_ring" else "outer"
        shapes.append(ring_shape(ring, context.model.elastic[body].counts, amplitudes))
    return shapes


def _azimuths(found: Equilibrium) -> FloatArray:
    """Return the azimuth of each ball, shape (Z,) [rad]."""
    azimuths: FloatArray = L.elements_in(found.context.bundle, found.state)["azimuth"]
    return azimuths


def _ratio(found: Equilibrium) -> float:
    """Return orbital over inner ring speed.

    Both speeds are relative to the outer ring.
    """
    model = found.context.model
    inner, outer = (initial(body.dofs["spin"].motion) for body in (model.inner_ring, model.outer_ring))
    return (found.orbit - outer) / (inner - outer) if inner != outer else math.nan
