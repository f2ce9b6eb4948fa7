"""Report the quasi-static equilibrium of a machine."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any, Self, cast

import numpy as np
from pydantic import Field

from lambda_core.analysis.rotor.bearing_alone import number_among
from lambda_core.analysis.rotor.machine_modes import AXES, six
from lambda_core.domain.arrays import FloatArray
from lambda_core.domain.number_text import digits
from lambda_core.domain.unit_systems import SI, UnitSystem
from lambda_core.formulas.elastic.beam import NODE
from lambda_core.formulas.elastic.body import internal_forces
from lambda_core.formulas.life import BALL_SLOPE, ROLLER_SLOPE, system_life
from lambda_core.model.checks.operating_limits import load_warnings, operating_warnings
from lambda_core.model.machine_model import MachineModel, MountedBearing, Place, is_on_cage
from lambda_core.results.answer import dataset, declared_numbers, drawn
from lambda_core.results.averages import finite
from lambda_core.results.bearing_summary import BearingSummary
from lambda_core.results.limits import warnings
from lambda_core.results.model_band import ModelBand, sum_of_bands
from lambda_core.results.quantity import FLOATING, quantity, same_as
from lambda_core.results.quasistatic import (
    BearingStatics,
    QuasiStatic,
    StaticAnswer,
    bearing_statics,
    play_of,
    unsteady_warnings,
)
from lambda_core.results.rating import Rating
from lambda_core.results.record import Record
from lambda_core.results.summary import Summary
from lambda_core.results.text import line
from lambda_core.results.verdict import Verdict
from lambda_core.solver.drivers.machine_statics import MachineState
from lambda_core.solver.drivers.preload import Preload, first_contact
from lambda_core.solver.drivers.structure import point_on, static_rows, stretch

if TYPE_CHECKING:
    from lambda_core.analysis.rotor.machine_point import MachinePoint, MountedPoint
    from lambda_core.model.roller_case import RollerModel


class MountedState(Record):
    """Place and load of a bearing in a machine."""

    name: str
    position_mm: float = quantity(
        "of its middle, from the shaft's left end",
        "mm",
        label="position",
        column="position",
        decimals=FLOATING,
        digits=5,
    )
    radial_load_N: float = quantity(
        "across the shaft", "N", label="radial load", column="radial load", decimals=FLOATING, digits=4, group="load"
    )
    axial_load_N: float = quantity(
        "along x on the bearing, with its sign", "N", label="axial load", column="axial load",
        decimals=FLOATING, digits=4,
        group="load",
    )  # fmt: skip
    force_N: list[float] = quantity(
        "of the bearing on the shaft: x, y, z", "N", label="force on the shaft", column="force on shaft",
        decimals=FLOATING, digits=4, group="load", axes="xyz",
    )  # fmt: skip
    moment_Nm: list[float] = quantity(
        "of the bearing on the shaft about y and z", "N m", label="moment on the shaft about", column="moment about",
        decimals=FLOATING, digits=3, group="load", axes="yz",
    )  # fmt: skip
    displacement_um: list[float] = quantity(
        "of the inner ring against the outer ring: x, y, z; x from the first contact of a bearing that takes thrust "
        "from one side", "um", label="displacement of the rings",
        column="displacement", decimals=FLOATING, digits=3, group="place", axes="xyz",
    )  # fmt: skip
    misalignment_mrad: list[float] = quantity(
        "of the inner ring against the outer ring about y and z", "mrad", label="misalignment about",
        column="misalignment", decimals=FLOATING, digits=3, group="place", axes="yz",
    )  # fmt: skip
    outer_ring_um: list[float] = Field(description="of the outer ring in the housing: x, y, z")
    preload_force_N: float | None = quantity(
        "thrust without loads and weight, warm and turning; null unless the bearing takes thrust from one side", "N",
        label="preload force", column="preload force", decimals=FLOATING, digits=4, group="load", default=None,
    )  # fmt: skip
    lift_off_N: float | None = quantity(
        "thrust on a rigid shaft that brings the opposite bearing back to its first contact; null without a rigid "
        "preload of two", "N",
        label="lift-off thrust", column="lift-off thrust", decimals=FLOATING, digits=4, group="load", default=None,
    )  # fmt: skip
    clearance_um: float | None = quantity(
        "radial, in operation; null of angular contact, whose rings are set against each other",
        "um",
        label="clearance in operation",
        column="clearance",
        decimals=FLOATING,
        digits=3,
        group="place",
        default=None,
    )
    stiffness: list[list[float]] = Field(
        description="6 x 6, inner ring against outer ring, order of `axes` [N/m, N/rad, N m/rad]; no row turns about x"
    )


class BearingEquilibrium(BearingStatics, MountedState):
    """One bearing of a machine at its operating point."""

    verdict: Verdict = Field(description="against required life and limits")
    rating: Rating = Field(description="life, safety and catalogue friction")
    power_loss_W: float | None = same_as(
        BearingSummary, "power_loss_W", "of the friction; null where the balls have no steady motion"
    )

    @property
    def ring_displacement_um(self) -> list[float]:
        """Displacement x, y, z between the rings [um]."""
        return self.displacement_um


class MountedQuasiStatic(QuasiStatic, MountedState):
    """Quasi-static solution of one bearing of a machine.

    It has the fields of a bearing that is alone, and its place and loads in the machine. Displacement and tilt are
    those of the inner ring against the outer ring.
    """

    @property
    def bearings(self) -> Mapping[str, BearingStatics]:
        """The bearing by its name."""
        return {self.name: self}

    def own_lines(self, units: UnitSystem) -> list[str]:
        """Return the stiffness of the bearing."""
        each = (f"{axis} {digits(units.value(1e-6 * self.stiffness[k][k], 'N/um'), 3)}" for k, axis in enumerate("xyz"))
        return [line("stiffness", f"{'  '.join(each)} {units.unit('N/um')}")]


class BodyMoved(Record):
    """Displacement of a body or place as drawn."""

    displacement_um: list[float] = Field(description="x, y, z")
    tilt_mrad: list[float] = Field(description="about x, y and z")


class MachineEquilibrium(StaticAnswer):
    """Quasi-static equilibrium of a machine.

    It holds loads, deflection, lives and friction of its bearings.
    """

    speed_rpm: float = Field(description="of the shaft")
    axes: tuple[str, ...] = Field(default=AXES, description="order of rows and columns of the stiffness matrices")
    bearings: dict[str, BearingEquilibrium] = Field(description="each bearing by its name, from left to right")
    gears: dict[str, list[float]] = Field(description="tangential, radial and axial force [N]")
    springs: dict[str, list[float]] = Field(
        default={}, description="force of each spring on the body of its place: x, y, z [N]"
    )
    bodies: dict[str, BodyMoved] = Field(default={}, description="bodies other than the shaft")
    markers: dict[str, BodyMoved] = Field(default={}, description="named places")
    system_life_h: float | None = same_as(
        Summary, "system_life_h", "of all bearings by their reference rating lives, 90 %"
    )
    friction_torque_Nmm: float | None = same_as(Summary, "friction_torque_Nmm", "of all bearings")
    friction_torque_Nmm_band: list[float] = Field(
        default=[], description="ends of the 90 % model band, the sum of those of the bearings; empty without one"
    )
    drive_torque_Nm: float = same_as(Summary, "drive_torque_Nm", "of the coupling on the shaft, friction left out")
    shaft_mass_kg: float = Field(description="with its discs")
    positions_mm: list[float] = Field(description="of the nodes along the shaft")
    deflection_um: list[list[float]] = Field(description="x, y, z at each position")
    slope_mrad: list[list[float]] = Field(description="tilts about y and z at each position")
    cut_positions_mm: list[float] = Field(description="places of the section forces, both sides of every node")
    shear_N: list[list[float]] = Field(description="along y and z")
    bending_moment_Nm: list[list[float]] = Field(description="about y and z, of the right side on the left")
    torque_Nm: list[float] = Field(description="about x, of the right side on the left")
    residual: float = Field(description="largest unbalanced force over the loads")
    warnings: list[str] = Field(default=[], description="geometric conflicts of parts on the shaft")

    def bearing(self, name: str) -> BearingEquilibrium:
        """Return one bearing by its name.

        UsageError with the nearest name where there is none.
        """
        return cast("BearingEquilibrium", super().bearing(name))

    def of_bearing(self, name: str | None = None) -> MountedQuasiStatic:
        """Return the answer about one bearing.

        An only bearing needs no name; UsageError where a name is needed, or nothing has it.
        """
        number = number_among(list(self.bearings), name, self.case)
        one = list(self.bearings.values())[number]
        mounted: MountedBearing | None = None if self._model is None else self._model.bearings[number]
        found = MountedQuasiStatic(
            **dict(one),
            case=self.case,
            headline=f"{one.name}: {one.title}, {one.position_mm:.5g} mm from the left end of {self.case}",
            inner_ring_displacement_um=one.displacement_um,
            axial_play_um=None if mounted is None or mounted.takes or one.rollers else play_of(mounted.model),
            inner_ring_tilt_mrad=one.misalignment_mrad,
            iterations=self.iterations,
            assumptions=[text for whose, text in map(self.assumed, self.assumptions) if one.name in whose],
        )
        return found if mounted is None else found.of_model(mounted.model)

    def assumed(self, assumption: str) -> tuple[list[str], str]:
        """Return an assumption's bearings and its text."""
        head, mark, text = assumption.partition(": ")
        names = head.split(", ")
        return (names, text) if mark and self.bearings.keys() >= set(names) else ([], assumption)

    def warned(self) -> list[str]:
        """Return all warnings.

        Those of a bearing begin with its name.
        """
        return [
            *self.warnings,
            *(f"{one.name}: {warning}" for one in self.bearings.values() for warning in one.warnings),
        ]

    def preloaded(self, found: Mapping[str, Preload]) -> Self:
        """Return the same with the preload of its bearings."""
        each = {
            name: one.model_copy(update={"preload_force_N": own.force, "lift_off_N": own.lift_off}) if own else one
            for name, one, own in ((name, one, found.get(name)) for name, one in self.bearings.items())
        }
        return self.model_copy(update={"bearings": each})

    def with_bands(self, bands: Mapping[str, ModelBand]) -> Self:
        """Return the same with the model bands of its bearings."""
        each = {name: one.with_band(bands[name]) for name, one in self.bearings.items()}
        torque = sum_of_bands([one.friction_torque_Nmm_band for one in each.values()])
        return self.model_copy(update={"bearings": each, "friction_torque_Nmm_band": torque})

    def text(self, width: int | None = None, units: UnitSystem = SI) -> str:
        """Return the lines of text in some units.

        None is longer than `width` where one is given.
        """
        from lambda_core.analysis.rotor.machine_text import equilibrium_text

        return equilibrium_text(self, width, units)

    def plot(self, name: str = "shaft", **options: Any) -> Any:
        """Return a view of the machine as a matplotlib figure.

        Parameters
        ----------
        name : str
            View; default: the shaft with deflection and bending moment.
        **options
            Options of the view by name.

        Returns
        -------
        matplotlib.figure.Figure
            ``savefig`` writes it.

        Raises
        ------
        UsageError
            For a view or an option that does not exist, or an equilibrium that has no machine.
        """
        return drawn(self.solved(), self, None, name, options)

    def to_xarray(self) -> Any:
        """Return bearings and deflection as an xarray.Dataset.

        Every variable has its unit.

        Returns
        -------
        xarray.Dataset
            Dimensions bearing, position (along the shaft) and axes.

        Raises
        ------
        UsageError
            When xarray is not installed; it comes with the extra "data".
        """
        data, labels = declared_numbers(self.bearings, "bearing")
        lives, _ = declared_numbers({name: bearing.rating for name, bearing in self.bearings.items()}, "bearing")
        data |= lives
        data["deflection_um"] = (("position", "xyz"), np.array(self.deflection_um), {"units": "um"})
        return dataset(data, labels | {"position": self.positions_mm}, {"case": self.case, "speed_rpm": self.speed_rpm})

    def __repr__(self) -> str:
        """Return case, speed and the loads of the bearings."""
        loads = ", ".join(f"{name} {one.radial_load_N:.4g} N" for name, one in self.bearings.items())
        return f"<MachineEquilibrium {self.case}, {self.speed_rpm:.5g} 1/min, radial loads {loads}>"


def equilibrium_of(point: MachinePoint) -> MachineEquilibrium:
    """Put the equilibrium into the units of the interface."""
    model, state = point.model, point.state
    pairs = zip(model.bearings, point.bearings.values(), strict=True)
    bearings = [_bearing(mounted, one, state) for mounted, one in pairs]
    moved = state.displacement[: NODE * model.body.positions.size].reshape(-1, NODE)
    cuts, forces = internal_forces(model.body, state.displacement, model.gravity)
    known = [b for b in bearings if b.rating.reference_life_h is not None]
    lives = [life for b in known if (life := b.rating.reference_life_h) is not None]
    slopes = [BALL_SLOPE if b.rollers is None else ROLLER_SLOPE for b in known]
    torques = [b.friction_torque_Nmm for b in bearings]
    rpm, rows = 30.0 / math.pi * model.speed, static_rows(model)
    return MachineEquilibrium(
        case=model.name,
        speed_rpm=rpm,
        bearings={one.name: one for one in bearings},
        gears={name: [g.tangential, g.radial, g.axial] for name, g in model.gears.items()},
        springs={
            **{s.name: _listed(-(s.stiffness @ stretch(model, rows, s) @ state.motions)[:3]) for s in model.springs},
            **{link.name: _listed(link.wrench[:3]) for link in state.links},
        },
        bodies={body.name: _moved(moves) for body, moves in zip(model.bodies, state.bodies, strict=True)},
        markers={name: _moved(_at(model, state, place)) for name, place in model.markers if not is_on_cage(place)},
        system_life_h=finite(system_life(lives, slopes)) if lives else None,
        friction_torque_Nmm=None if None in torques else sum(t for t in torques if t is not None),
        drive_torque_Nm=state.drive_torque,
        shaft_mass_kg=model.body.total_mass,
        positions_mm=_listed(1e3 * model.body.positions),
        deflection_um=_listed(1e6 * moved[:, :3]),
        slope_mrad=_listed(1e3 * moved[:, 4:]),
        cut_positions_mm=_listed(1e3 * cuts),
        shear_N=_listed(forces[:, 1:3]),
        bending_moment_Nm=_listed(forces[:, 4:]),
        torque_Nm=_listed(forces[:, 3]),
        iterations=state.iterations,
        residual=state.residual,
        warnings=list(model.warnings),
        assumptions=list(model.assumptions),
    ).of_model(model)


def _moved(motion: FloatArray) -> BodyMoved:
    return BodyMoved(displacement_um=_listed(1e6 * motion[:3]), tilt_mrad=_listed(1e3 * motion[3:]))


def _at(model: MachineModel, state: MachineState, place: Place) -> FloatArray:
    """Return the displacement and rotation of a place.

    They are zero on the ground and off the nodes of the shaft.
    """
    own, moves = point_on(model, static_rows(model), place.body, place.point)
    return np.asarray(moves @ state.motions[own])


def _listed(values: FloatArray) -> Any:
    return values.tolist()


def _bearing(bearing: MountedBearing, point: MountedPoint, state: MachineState) -> BearingEquilibrium:
    """Return what there is to say of one bearing."""
    own = _of_balls(bearing, point) if point.rollers is None else _of_rollers(bearing, point, point.rollers)
    reaction, pose = point.reaction, point.pose
    return BearingEquilibrium(
        **own,
        name=bearing.name,
        position_mm=1e3 * bearing.position,
        radial_load_N=float(np.hypot(*reaction[1:3])),
        axial_load_N=float(-reaction[0]),
        force_N=_listed(reaction[:3]),
        moment_Nm=_listed(reaction[3:]),
        displacement_um=[1e6 * float(pose[0] - first_contact(bearing)), *_listed(1e6 * pose[1:3])],
        misalignment_mrad=_listed(1e3 * pose[3:]),
        outer_ring_um=_listed(1e6 * state.outer[point.number, :3]),
        stiffness=six(state.stiffness[point.number]),
    )


def _of_balls(bearing: MountedBearing, point: MountedPoint) -> dict[str, Any]:
    """Return the numbers of a bearing with balls."""
    found = point.equilibrium
    own = bearing_statics(found, point.rating, float(np.hypot(*point.pose[3:])))
    own["warnings"] = _warnings(bearing, point, own)
    clearance = None if bearing.takes and bearing.nominal_angle else 1e6 * bearing.model.geometry.clearance
    return {**own, "clearance_um": clearance}


def _of_rollers(bearing: MountedBearing, point: MountedPoint, rollers: RollerModel) -> dict[str, Any]:
    """Return the numbers of a bearing with rollers."""
    clearance = None if rollers.bearing.contact_angle else 1e6 * rollers.bearing.clearance
    return {**point.roller_statics, "title": bearing.model.title, "clearance_um": clearance}


def _warnings(bearing: MountedBearing, point: MountedPoint, own: Mapping[str, Any]) -> list[str]:
    """Return warnings of exceeded limits, ratings first."""
    model, tilt = bearing.model, float(np.hypot(*point.pose[3:]))
    return [
        *load_warnings(model, *point.loads),
        *warnings(1e9 * own["max_pressure_GPa"], own["shoulders"], tilt, model.geometry.kind.name, on_shaft=True),
        *operating_warnings(model, on_shaft=True),
        *unsteady_warnings(point.equilibrium),
    ]
