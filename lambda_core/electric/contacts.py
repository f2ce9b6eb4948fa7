"""What the circuit has to know of the contacts: from a run's samples, or from quasi-static equilibria as balls pass."""

from __future__ import annotations

import math
from dataclasses import dataclass, fields, replace
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from lambda_core.domain.arrays import FloatArray
from lambda_core.domain.errors import UsageError
from lambda_core.electric.march import Films

if TYPE_CHECKING:
    from lambda_core.case.electric import Electric
    from lambda_core.results.reader import Result
    from lambda_core.solver.drivers.compiled_laws import Announce, Kernels
    from lambda_core.solver.drivers.equilibrium import Equilibrium
    from lambda_core.system.bearing import BearingModel


PHASES = 12  # equilibria per ball pitch
_TURNS = 10.0  # of the cage, where nothing says how long
VACUUM_PERMITTIVITY = 8.8541878128e-12  # [F/m], CODATA 2018


@dataclass(frozen=True)
class Contacts:
    """Contacts of one bearing over time, SI; arrays of shape (n, Z, 2), inner then outer, where nothing else stands.

    Attributes
    ----------
    time : float64[:], shape (n,)
    azimuth : float64[:, :], shape (n, Z)
        Of the balls, from +y towards +z [rad].
    inner_angle, outer_angle : float64[:], shape (n,)
        Of the rings about the shaft axis [rad].
    load, film, film_minimum, film_parameter : float64[:, :, :]
        [N]; central and minimum film, 0 without load [m]; Lambda [-].
    semi_a, semi_b, entrainment : float64[:, :, :]
        Semi-axes across and along rolling [m]; mean surface speed along rolling [m/s].
    hertz, capacitance : float64[:, :, :]
        Of the Hertzian area; of the whole contact, inf where asperities short it [F].
    roughness : float
        Composite rms roughness [m].
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
    semi_a: FloatArray
    semi_b: FloatArray
    entrainment: FloatArray
    hertz: FloatArray
    capacitance: FloatArray
    roughness: float
    origin: str

    @property
    def loaded(self) -> NDArray[np.bool_]:
        """Where surfaces press against each other."""
        return self.load > 0.0

    @property
    def shorted(self) -> NDArray[np.bool_]:
        """Where asperities touch: metal conducts."""
        return ~np.isfinite(self.capacitance)

    @property
    def area(self) -> FloatArray:
        """Hertzian area of each contact [m2]."""
        return np.asarray(math.pi * self.semi_a * self.semi_b)

    def until(self, duration: float) -> Contacts:
        """Return the samples of the first `duration` [s]."""
        count = int(np.searchsorted(self.time, self.time[0] + duration, side="right"))
        rows = slice(0, max(count, 2))
        values = {f.name: getattr(self, f.name) for f in fields(self)}
        parts: dict[str, Any] = {name: a[rows] for name, a in values.items() if isinstance(a, np.ndarray)}
        return replace(self, **parts)


_CHANNELS = {
    "load": "load",
    "film": "film_central",
    "film_minimum": "film_minimum",
    "film_parameter": "film_parameter",
    "semi_a": "semi_axis_a",
    "semi_b": "semi_axis_b",
    "entrainment": "entrainment",
    "hertz": "capacitance_hertz",
    "capacitance": "capacitance",
}


def contacts_of_run(result: Result, start: float, duration: float | None = None) -> Contacts:
    """Read the contacts of a run from time `start` [s] on.

    Raises
    ------
    UsageError
        When there are not two samples.
    """
    time = result["time"]
    first = int(np.searchsorted(time, start))
    if time.size - first < 2:
        raise UsageError(f"{result.path}: fewer than two samples from {start:.4g} s on")
    angle = result["body_spin_angle"][first:]
    found = Contacts(
        time=time[first:],
        azimuth=result["ball_azimuth"][first:],
        inner_angle=angle[:, 0],
        outer_angle=angle[:, 1],
        roughness=float(result.model["roughness"]),
        origin=f"the run {result.path.name} from {1e3 * start:.4g} ms on",
        **{name: result[channel][first:] for name, channel in _CHANNELS.items()},
    )
    return found if duration is None else found.until(duration)


def equilibria(
    model: BearingModel, phases: int = PHASES, announce: Announce = None, kernels: Kernels | None = None
) -> list[Equilibrium]:
    """Solve the quasi-static equilibrium at several positions of the balls within one pitch.

    Raises
    ------
    SolverError
        When there is none.
    """
    from lambda_core.solver.drivers.compiled_laws import Kernels
    from lambda_core.solver.drivers.equilibrium import solve

    kernels = kernels or Kernels(model, announce)
    return [solve(model, kernels, announce, phase=k / phases) for k in range(phases)]


def contacts_of_equilibria(found: list[Equilibrium], duration: float | None = None) -> Contacts:
    """Lay equilibria over time as balls pass: ball j takes the place of ball j + 1 after each pitch.

    No dynamics: every ball has the film that belongs to its place in the load zone.
    """
    from lambda_core.solver.sampling import CONTACT_CHANNELS
    from lambda_core.system.time_functions import initial

    model = found[0].assembly.model
    z, phases = model.geometry.ball_count, len(found)
    orbit = float(np.mean([e.orbit for e in found]))
    inner, outer = (initial(body.dofs["spin"].motion) for body in (model.inner_ring, model.outer_ring))
    relative = orbit - outer
    if relative == 0.0:
        raise UsageError("at rest no ball passes: give the bearing a speed")
    pitch = 2.0 * math.pi / (z * abs(relative))
    length = _TURNS * z * pitch if duration is None else duration
    count = max(math.ceil(length / pitch * phases), 1)
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
        origin=f"quasi-static equilibria at {phases} positions of the balls",
        **parts,
    )


def films(contacts: Contacts, options: Electric) -> Films:
    """Return the contacts as electric parts: capacitance, conductance, and what breaks down.

    Raises
    ------
    UsageError
        When no contact has a film.
    """
    shorted, loaded = contacts.shorted, contacts.loaded
    capacitance = np.where(shorted, contacts.hertz, contacts.capacitance) + rough_excess(contacts, options)
    with np.errstate(divide="ignore", invalid="ignore"):
        permittivity = np.where(loaded & ~shorted, contacts.hertz * contacts.film / contacts.area, np.nan)
    if not np.isfinite(permittivity).any():
        permittivity[:] = VACUUM_PERMITTIVITY  # every contact is shorted: metal conducts, not oil
    permittivity = np.where(np.isfinite(permittivity), permittivity, np.nanmean(permittivity))
    conductance = options.film.conductivity * capacitance / permittivity
    conductance = np.where(shorted, 1.0 / options.film.metal_resistance, conductance)
    breaks = loaded & ~shorted
    law = options.breakdown
    film = np.where(breaks, contacts.film_minimum if law.law == "field" else contacts.film, 0.0)
    with np.errstate(divide="ignore", invalid="ignore"):
        rate = np.where(loaded, np.abs(contacts.entrainment) / (2.0 * contacts.semi_b), 0.0)
    steps = 0.5 * (rate[1:] + rate[:-1]) * np.diff(contacts.time)[:, None, None]
    rolled = np.concatenate([np.zeros_like(rate[:1]), np.cumsum(steps, axis=0)])
    particles = law.particle_density * contacts.area * contacts.film if law.law == "particles" else np.zeros_like(rate)
    return Films(
        time=contacts.time,
        capacitance=capacitance,
        conductance=conductance,
        film=film,
        spots=np.maximum(contacts.area / law.correlation_length**2, 1.0),
        particles=particles,
        rolled=rolled,
    )


def rough_excess(contacts: Contacts, options: Electric) -> FloatArray:
    """Return the capacitance that roughness adds to each Hertzian area [F].

    C/C_smooth = h E[1/h] >= 1 (Jensen). For a gamma-distributed gap of mean h and deviation sigma, E[1/h] =
    1/(h (1 - sigma^2/h^2)), so the factor is Lambda^2/(Lambda^2 - 1); it has no meaning where Lambda is near 1, where
    asperities touch and the contact is a resistance.
    """
    if options.film.roughness == "smooth":
        return np.zeros_like(contacts.hertz)
    squared = contacts.film_parameter**2
    rough = contacts.loaded & ~contacts.shorted & (squared > 1.0)
    return np.asarray(np.where(rough, contacts.hertz / np.where(rough, squared - 1.0, 1.0), 0.0))
