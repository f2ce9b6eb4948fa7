"""Provide the circuit with the contacts over time.

They come from a run's samples, or from quasi-static equilibria as balls pass.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, fields, replace
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from lambda_core.analysis.electric.circuit_integrator import Films
from lambda_core.domain.arrays import FloatArray
from lambda_core.domain.errors import UsageError
from lambda_core.formulas.gap_capacitance import VACUUM_PERMITTIVITY

if TYPE_CHECKING:
    from collections.abc import Mapping

    from lambda_core.case.electric import Electric
    from lambda_core.model.bearing_model import BearingModel
    from lambda_core.results.reader import Result
    from lambda_core.solver.drivers.compiled_laws import Announce, Kernels
    from lambda_core.solver.drivers.equilibrium import Equilibrium


PHASES = 12  # equilibria per ball pitch
_AT_REST = "at rest no {} passes a point: give the bearing a speed"
_MOST_SAMPLES = 500_000  # about a gigabyte of nine balls
_TURNS = 10.0  # of the cage, where nothing says how long


@dataclass(frozen=True)
class Contacts:
    """Contacts of one bearing over time, SI.

    Arrays of shape (n, Z, 2), inner then outer, where nothing else is given.

    Attributes
    ----------
    time : float64[:], shape (n,)
    azimuth : float64[:, :], shape (n, Z)
        Of the balls, from +y towards +z [rad].
    inner_angle, outer_angle : float64[:], shape (n,)
        Of the rings about the shaft axis [rad].
    load, film, film_minimum, film_parameter : float64[:, :, :]
        [N]; central and minimum film, 0 without load [m]; Lambda [-].
    pressure : float64[:, :, :]
        Largest one, 0 without load [Pa].
    semi_a, semi_b, entrainment : float64[:, :, :]
        Semi-axes across and along rolling, of a line half its length and half its width [m]; mean surface speed along
        rolling [m/s].
    hertz, capacitance : float64[:, :, :]
        Of the Hertzian area; of the whole contact, inf where asperities short it [F].
    roughness : float
        Composite rms roughness [m].
    of_lines : bool
        Whether the contacts are lines of rollers, not ellipses.
    origin : str
        Where the films come from, for people.
    """

    time: FloatArray
    azimuth: FloatArray
    inner_angle: FloatArray
    outer_angle: FloatArray
    load: FloatArray
    film: FloatArray
    film_minimum: FloatArray
    film_parameter: FloatArray
    pressure: FloatArray
    semi_a: FloatArray
    semi_b: FloatArray
    entrainment: FloatArray
    hertz: FloatArray
    capacitance: FloatArray
    roughness: float
    origin: str
    of_lines: bool = False

    @property
    def ball_count(self) -> int:
        """Number of balls."""
        return int(self.load.shape[1])

    @property
    def loaded(self) -> NDArray[np.bool_]:
        """True where surfaces press against each other."""
        return self.load > 0.0

    @property
    def shorted(self) -> NDArray[np.bool_]:
        """True where asperities touch and metal conducts."""
        return ~np.isfinite(self.capacitance)

    @property
    def area(self) -> FloatArray:
        """Hertzian area of each contact [m2].

        The area of an ellipse is pi a b. That of a line is F/(pi/4 p_max): Hertz's mean pressure across a line is pi/4
        of the largest (Johnson 1985, Contact Mechanics, eq. 4.45).
        """
        if not self.of_lines:
            return np.asarray(math.pi * self.semi_a * self.semi_b)
        return np.asarray(self.load / np.maximum(0.25 * math.pi * self.pressure, 1.0))

    def part(self, rows: slice) -> Contacts:
        """Return some of the samples."""
        values = {f.name: getattr(self, f.name) for f in fields(self)}
        parts: dict[str, Any] = {name: a[rows] for name, a in values.items() if isinstance(a, np.ndarray)}
        return replace(self, **parts)

    def after(self, earlier: Contacts | None) -> Contacts:
        """Return these samples behind earlier ones."""
        if earlier is None:
            return self
        values = {f.name: (getattr(earlier, f.name), getattr(self, f.name)) for f in fields(self)}
        parts: dict[str, Any] = {
            name: np.concatenate(pair) for name, pair in values.items() if isinstance(pair[0], np.ndarray)
        }
        return replace(self, **parts)

    def turned(self, times: FloatArray) -> FloatArray:
        """Return the relative angle of the rings [rad].

        It is that of the inner ring against the outer at times [s], linear between and beyond samples.
        """
        return turned(self.time, self.inner_angle - self.outer_angle, times)


def turned(known: FloatArray, angle: FloatArray, times: FloatArray) -> FloatArray:
    """Return an angle at times.

    It is linear between the known ones and beyond them.
    """
    i = np.clip(np.searchsorted(known, times, side="right") - 1, 0, known.size - 2)
    slope = (angle[i + 1] - angle[i]) / (known[i + 1] - known[i])
    return np.asarray(angle[i] + slope * (times - known[i]))


_CHANNELS = {
    "load": "load",
    "film": "film_central",
    "film_minimum": "film_minimum",
    "film_parameter": "film_parameter",
    "pressure": "max_pressure",
    "semi_a": "semi_axis_a",
    "semi_b": "semi_axis_b",
    "entrainment": "entrainment",
    "hertz": "capacitance_hertz",
    "capacitance": "capacitance",
}
CHANNELS = ("time", "body_spin_angle", "ball_azimuth", *_CHANNELS.values())  # that the circuit reads of a run


def contacts_of_samples(
    samples: Mapping[str, FloatArray], roughness: float, origin: str, *, of_lines: bool = False
) -> Contacts:
    """Return the contacts in the samples of a run.

    The samples map channels to arrays.
    """
    angle = samples["body_spin_angle"]
    return Contacts(
        time=samples["time"],
        azimuth=samples["ball_azimuth"],
        inner_angle=angle[:, 0],
        outer_angle=angle[:, 1],
        roughness=roughness,
        origin=origin,
        of_lines=of_lines,
        **{name: samples[channel] for name, channel in _CHANNELS.items()},
    )


def contacts_of_run(result: Result) -> Contacts:
    """Read the contacts of a run.

    Raises
    ------
    UsageError
        When there are not three samples.
    """
    samples = {name: result[name] for name in CHANNELS}
    if samples["time"].size < 3:
        raise UsageError(f"{result.path}: has fewer than three samples, simulate longer or lower output.interval")
    roughness, origin = float(result.model["roughness"]), f"the run {result.path.name}"
    return contacts_of_samples(samples, roughness, origin, of_lines=result.model.get("rollers") is not None)


def equilibria(
    model: BearingModel, phases: int = PHASES, announce: Announce = None, kernels: Kernels | None = None
) -> list[Equilibrium]:
    """Solve the equilibrium at several positions of balls.

    The equilibria are quasi-static, the positions within one pitch. Where no steady motion of rollers is found at one
    of them, they roll at all: loads are the same, films of raceways within a thousandth.

    Raises
    ------
    SolverError
        When there is none.
    """
    from lambda_core.solver.drivers.compiled_laws import Kernels
    from lambda_core.solver.drivers.equilibrium import solve
    from lambda_core.solver.drivers.near_equilibrium import solve_or_roll

    kernels = kernels or Kernels(model, announce)
    found: list[Equilibrium] = []
    for k in range(phases):
        found.append(solve_or_roll(model, kernels, announce, phase=k / phases))
        if not found[-1].converged:
            return [solve(model, kernels, with_friction=False, phase=k / phases) for k in range(phases)]
    return found


def spins(model: BearingModel) -> tuple[float, float]:
    """Return the spins of inner and outer ring [rad/s].

    UsageError where they are equal: what creeps by rounding between rings at rest passes no point.
    """
    from lambda_core.model.laws.time_functions import initial

    inner, outer = (initial(body.dofs["spin"].motion) for body in (model.inner_ring, model.outer_ring))
    if inner == outer:
        raise UsageError(_AT_REST.format(model.elements[:-1]))
    return inner, outer


def contacts_of_equilibria(found: list[Equilibrium], duration: float | None = None) -> Contacts:
    """Arrange equilibria in time as balls pass.

    Ball j takes the place of ball j + 1 after each pitch.

    No dynamics: every ball has the film that belongs to its place in the load zone.
    """
    from lambda_core.solver.records import CONTACT_CHANNELS

    model = found[0].context.model
    z, phases = model.geometry.balls, len(found)
    orbit = float(np.mean([e.orbit for e in found]))
    inner, outer = spins(model)
    relative = orbit - outer
    if relative == 0.0:
        raise UsageError(_AT_REST.format(model.elements[:-1]))
    pitch = 2.0 * math.pi / (z * abs(relative))
    length = default_duration(found) if duration is None else duration
    count = max(math.ceil(length / pitch * phases), 1)
    if count > _MOST_SAMPLES:
        raise UsageError(
            f"{length:.4g} s are {count:.6g} positions of the balls, at most {_MOST_SAMPLES}: shorten duration"
        )
    step = np.arange(count + 1)
    time = step * pitch / phases
    moved = step if relative > 0.0 else -step
    at, turn = moved % phases, moved // phases
    ball = (np.arange(z)[None, :] + turn[:, None]) % z
    table = np.stack([e.contacts for e in found])  # (phases, Z, 2, channels)
    rows = table[at[:, None], ball]
    parts = {name: rows[..., CONTACT_CHANNELS.index(channel)] for name, channel in _CHANNELS.items()}
    azimuth = -0.5 * math.pi + 2.0 * math.pi / z * (np.arange(z)[None, :] + moved[:, None] / phases)
    return Contacts(
        time=time,
        azimuth=azimuth + outer * time[:, None],
        inner_angle=inner * time,
        outer_angle=outer * time,
        roughness=model.roughness,
        origin=f"quasi-static equilibria at {phases} positions of the {model.elements}"
        + ("" if found[0].converged else ", which roll: no steady motion with friction was found"),
        of_lines=model.rollers is not None,
        **parts,
    )


def default_duration(found: list[Equilibrium]) -> float:
    """Return the time of ten cage turns [s].

    The cage turns against the outer ring.
    """
    from lambda_core.model.laws.time_functions import initial

    outer = initial(found[0].context.model.outer_ring.dofs["spin"].motion)
    relative = float(np.mean([e.orbit for e in found])) - outer
    z = found[0].context.model.geometry.balls
    return _TURNS * z * (2.0 * math.pi / (z * abs(relative))) if relative != 0.0 else 0.0


def films(contacts: Contacts, options: Electric, rolled: FloatArray | None = None) -> Films:
    """Return the contacts as electric parts.

    Each has capacitance, conductance and breakdown.

    Each sample is treated alone, so that a run gives the same films however its samples come.

    Parameters
    ----------
    rolled : float64[:, :], shape (Z, 2), optional
        Patches rolled over at the first sample; default: none.
    """
    shorted, loaded = contacts.shorted, contacts.loaded
    capacitance = np.where(shorted, contacts.hertz, contacts.capacitance) + rough_excess(contacts, options)
    conductance = options.film.conductivity * capacitance / _permittivity(contacts)
    conductance = np.where(shorted, 1.0 / options.film.metal_resistance, conductance)
    film = np.where(loaded & ~shorted, contacts.film, 0.0)
    if options.film.ball_permittivity is not None:
        through = ball_capacitance(contacts, options.film.ball_permittivity)
        capacitance = capacitance * through / (capacitance + through)
        conductance, film = np.zeros_like(conductance), np.zeros_like(film)
    with np.errstate(divide="ignore", invalid="ignore"):
        rate = np.where(loaded, np.abs(contacts.entrainment) / (2.0 * contacts.semi_b), 0.0)
    steps = 0.5 * (rate[1:] + rate[:-1]) * np.diff(contacts.time)[:, None, None]
    first = np.zeros_like(rate[:1]) if rolled is None else rolled[None]
    return Films(
        time=contacts.time,
        capacitance=capacitance,
        conductance=conductance,
        film=film,
        thinnest=contacts.film_minimum,
        area=contacts.area,
        rolled=np.cumsum(np.concatenate([first, steps]), axis=0),
    )


def _permittivity(contacts: Contacts) -> FloatArray:
    """Return the oil's permittivity in each contact [F/m].

    Outside films it is that of the films of the same sample.
    """
    carried = contacts.loaded & ~contacts.shorted
    with np.errstate(divide="ignore", invalid="ignore"):
        own = np.where(carried, contacts.hertz * contacts.film / contacts.area, 0.0)
    total, count = np.zeros(contacts.time.size), np.zeros(contacts.time.size)
    for ball in range(own.shape[1]):  # one after the other: a sum by numpy depends on how many samples there are
        for ring in range(2):
            total += own[:, ball, ring]
            count += carried[:, ball, ring]
    mean = np.where(count > 0.0, total / np.maximum(count, 1.0), VACUUM_PERMITTIVITY)
    return np.where(carried, own, mean[:, None, None])


def ball_capacitance(contacts: Contacts, permittivity: float) -> FloatArray:
    """Return the capacitance into insulating balls [F].

    It leads from each contact into the ball; two of them are in series in a ball.

    The flux spreads from the Hertzian ellipse into a half-space: C = 2 pi eps_0 eps_r a/K(m), m = 1 - (b/a)^2, a the
    larger semi-axis, K the complete elliptic integral of the first kind; a circle gives 4 eps_0 eps_r a. It is the
    spreading resistance rho K/(2 pi a) of an ellipse (Holm 1967, Electric Contacts, par. 3) with eps for 1/rho. An
    unloaded ball gets that of a circle of the mean size of the loaded ones in its sample, an upper bound. Field lines
    outside the ellipse are left out, so that the result is a lower bound for loaded balls.
    """
    from scipy.special import ellipk

    large, small = np.maximum(contacts.semi_a, contacts.semi_b), np.minimum(contacts.semi_a, contacts.semi_b)
    loaded = contacts.loaded & (large > 0.0)
    with np.errstate(divide="ignore", invalid="ignore"):
        own = np.where(loaded, large / ellipk(np.where(loaded, 1.0 - (small / large) ** 2, 0.0)), 0.0)
    total, count = np.zeros(contacts.time.size), np.zeros(contacts.time.size)
    for ball in range(own.shape[1]):
        for ring in range(2):
            total += own[:, ball, ring]
            count += loaded[:, ball, ring]
    mean = np.where(count > 0.0, total / np.maximum(count, 1.0), 1e-6)
    size = np.where(loaded, own, mean[:, None, None])
    return np.asarray(2.0 * math.pi * VACUUM_PERMITTIVITY * permittivity * size)


def rough_excess(contacts: Contacts, options: Electric) -> FloatArray:
    """Return the roughness capacitance of Hertzian areas [F].

    It is the capacitance that roughness adds to each area.

    C/C_smooth = h E[1/h] >= 1 (Jensen). For a gamma-distributed gap of mean h and deviation sigma, E[1/h] =
    1/(h (1 - sigma^2/h^2)), so the factor is Lambda^2/(Lambda^2 - 1); it has no meaning where Lambda is near 1, where
    asperities touch and the contact is a resistance.
    """
    if options.film.roughness == "smooth":
        return np.zeros_like(contacts.hertz)
    squared = contacts.film_parameter**2
    rough = contacts.loaded & ~contacts.shorted & (squared > 1.0)
    return np.asarray(np.where(rough, contacts.hertz / np.where(rough, squared - 1.0, 1.0), 0.0))
