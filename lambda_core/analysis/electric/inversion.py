"""Find the film thickness from a measured capacitance."""

from __future__ import annotations

import math
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from pydantic import Field

from lambda_core.analysis.electric.circuit import surroundings
from lambda_core.analysis.electric.circuit_bearing import circuit_bearings
from lambda_core.case.electric import check_series
from lambda_core.case.pairs import read_pairs
from lambda_core.domain.arrays import FloatArray
from lambda_core.domain.channels import RINGS
from lambda_core.domain.errors import SolverError, UsageError
from lambda_core.results.record import INTERFACE, Record
from lambda_core.solver.records import CONTACT_CHANNELS

if TYPE_CHECKING:
    from lambda_core.solver.drivers.equilibrium import Equilibrium


_LEAST, _MOST = 0.02, 50.0  # of the film scale that is looked for
_STEP = 1e-4  # of the logarithm of the scale, for slopes


class FilmOutcome(Record):
    """Film thickness of a measured capacitance.

    Spans are 16, 50 and 84 % of the series.
    """

    interface: int = INTERFACE
    case: str
    rows: int = Field(description="of the measured series that were taken")
    measured_capacitance_pF: list[float]
    expected_capacitance_pF: float = Field(description="of the unchanged case")
    film_scale: list[float] = Field(description="film over that of the case")
    film_scale_uncertainty: float = Field(description="standard deviation by that of the measured capacitance")
    sensitivity: float = Field(description="d ln C/d ln h of the bearing: -1 where the films carry all capacitance")
    starvation: float = Field(description="median film over the fully flooded one")
    film_um: dict[str, list[float]] = Field(description="per ring: median central film of loaded contacts, least, most")

    def text(self) -> str:
        """Return the lines for people."""
        from lambda_core.results.text import line

        low, middle, high = self.film_scale
        return "\n".join(
            [
                line("measured", f"{self.measured_capacitance_pF[1]:.1f} pF", f"{self.rows} rows"),
                line("case", f"{self.expected_capacitance_pF:.1f} pF"),
                line(
                    "film over case", f"{middle:.4g} +- {self.film_scale_uncertainty:.2g}", f"{low:.4g} .. {high:.4g}"
                ),
                line("starvation", f"{self.starvation:.3g} of the fully flooded film"),
                *(line(f"film {ring}", f"{a:.3g} .. {b:.3g} um") for ring, (a, b) in self.film_um.items()),
                line("sensitivity", f"d ln C/d ln h = {self.sensitivity:.3f}"),
            ]
        )


class FilmModel:
    """Capacitance of a bearing with scaled films.

    All loaded films have the same scale.

    Parameters
    ----------
    found : list of Equilibrium
        Quasi-static equilibria at positions of the balls within a pitch; the capacitance is their mean.
    rings : float
        Capacitance of the rings past the balls [F].
    """

    def __init__(self, found: list[Equilibrium], rings: float) -> None:
        self._found, self._rings = found, rings
        self._bulk = {ring: _bulk_permittivity(found[0], ring) for ring in RINGS}

    def capacitance(self, scale: float) -> float:
        """Return the capacitance with scaled films [F].

        It acts between the rings, with films of `scale` times those of the equilibria.
        """
        return float(np.mean([self._one(each, scale) for each in self._found])) + self._rings

    def scale(self, measured: float) -> float:
        """Return the films' scale of a capacitance [F].

        Raises
        ------
        UsageError
            When no film of 1/50 to 50 times that of the case has it.
        """
        from scipy.optimize import brentq

        def miss(logarithm: float) -> float:
            return self.capacitance(math.exp(logarithm)) / measured - 1.0

        low, high = math.log(_LEAST), math.log(_MOST)
        if not miss(low) > 0.0 > miss(high):
            reach = f"{1e12 * self.capacitance(_MOST):.4g} to {1e12 * self.capacitance(_LEAST):.4g} pF"
            raise UsageError(
                f"{1e12 * measured:.4g} pF corresponds to no film: films of 1/50 to 50 times the case's have {reach}"
            )
        return math.exp(float(brentq(miss, low, high, xtol=1e-13, rtol=1e-13)))

    def slope(self, scale: float) -> float:
        """Return d ln C/d ln h at a scale."""
        up, down = (self.capacitance(scale * math.exp(sign * _STEP)) for sign in (1.0, -1.0))
        return math.log(up / down) / (2.0 * _STEP)

    def films(self, ring: str) -> FloatArray:
        """Return the central films of one ring [m].

        They are those of the loaded contacts in the equilibria.
        """
        table = np.stack([each.contacts[:, RINGS.index(ring)] for each in self._found]).reshape(
            -1, len(CONTACT_CHANNELS)
        )
        film = table[:, CONTACT_CHANNELS.index("film_central")]
        return film[film > 0.0]

    def _one(self, each: Equilibrium, scale: float) -> float:
        total = 0.0
        for ball in range(each.contacts.shape[0]):
            inner, outer = (self._contact(each, ball, ring, scale) for ring in RINGS)
            total += inner * outer / (inner + outer)
        return total

    def _contact(self, each: Equilibrium, ball: int, ring: str, scale: float) -> float:
        """Return the capacitance of one contact [F].

        The law of the case gives it: C_Hertz/scale, with the film times scale.
        """
        index = RINGS.index(ring)
        value = dict(zip(CONTACT_CHANNELS, each.contacts[ball, index].tolist(), strict=True))
        if value["load"] <= 0.0:
            return float(value["capacitance"])
        raceway: Any = each.context.raceway(f"ball_{ring}")
        modulus, radius_x, oil = float(raceway["modulus"]), float(raceway["radius_x"]), raceway["oil"]
        law, out = each.context.kernels.compiled[f"ball_{ring}", "capacitance"].dispatcher, np.zeros(1)
        status = law(
            value["capacitance_hertz"] / scale, value["film_central"] * scale, value["semi_axis_a"],
            value["semi_axis_b"], radius_x, float(raceway["radius_y"]),
            float(oil["viscosity"]) * abs(value["entrainment"]) / (modulus * radius_x), float(oil["alpha_p"]) * modulus,
            value["load"] / (modulus * radius_x**2), self._bulk[ring],
            each.context.parameters(f"ball_{ring}", "capacitance"), out,
        )  # fmt: skip
        if status != 1:
            raise SolverError(f"the law of capacitance of ball - {ring} refuses a film of {scale:.3g} times the case's")
        return float(out[0])


def _bulk_permittivity(each: Equilibrium, ring: str) -> float:
    """Return the oil's permittivity without pressure.

    It is relative, at the oil's temperature.
    """
    element, context = f"ball_{ring}", each.context
    oil: Any = context.raceway(element)["oil"]
    pressure, temperature = np.zeros(1), np.full(1, float(oil["temperature"]))
    ln_eta, density, found = np.zeros(1), np.zeros(1), np.zeros(1)
    laws = context.kernels.compiled
    laws[element, "rheology"].dispatcher(
        pressure, temperature, context.parameters(element, "rheology"), ln_eta, density
    )
    law = laws[element, "permittivity"].dispatcher
    law(pressure, temperature, density, context.parameters(element, "permittivity"), found)
    return float(found[0])


def film_from_series(found: list[Equilibrium], values: FloatArray, *, uncertainty: float) -> FilmOutcome:
    """Find the film that belongs to a measured series.

    Parameters
    ----------
    found : list of Equilibrium
    values : ndarray
        From :func:`read_measured`.
    uncertainty : float
        Standard deviation of the measured capacitance, relative; ds/s = -(dC/C)/(d ln C/d ln h).
    """
    model = found[0].context.model
    (bearing,) = circuit_bearings(model)
    film = bearing.options.film
    if film.ball_permittivity is not None or film.roughness != "smooth" or bearing.options.cage is not None:
        raise UsageError("the inversion assumes conducting balls, smooth films and no cage: remove those options")
    films = FilmModel(found, surroundings(bearing.options, bearing.geometry).rings)
    quantiles = np.quantile(values, (0.16, 0.5, 0.84))
    high, middle, low = (films.scale(float(value)) for value in quantiles)
    slope = films.slope(middle)
    return FilmOutcome(
        case=model.name,
        rows=values.size,
        measured_capacitance_pF=(1e12 * quantiles).tolist(),
        expected_capacitance_pF=1e12 * films.capacitance(1.0),
        film_scale=[low, middle, high],
        film_scale_uncertainty=middle * uncertainty / abs(slope),
        sensitivity=slope,
        starvation=middle * model.starvation,
        film_um={ring: [1e6 * middle * float(f(films.films(ring))) for f in (np.min, np.max)] for ring in RINGS},
    )


def read_measured(path: Path, frequency: float | None) -> FloatArray:
    """Read a measured series as capacitances [F].

    Parameters
    ----------
    path : pathlib.Path
        CSV file, ``time [s],capacitance [pF]``, or ``time [s],impedance [kOhm]``, taken as that of a capacitor.
    frequency : float or None
        Of the impedance [Hz].

    Raises
    ------
    UsageError
        With a sentence naming the file and the line.
    """
    try:
        lines = path.read_text(encoding="utf-8-sig").splitlines()
        impedance = "Ohm" in next((line for line in lines if line.strip()), "")
        pairs = read_pairs(path, "resistance" if impedance else "capacitance")
        check_series(pairs)
    except (OSError, ValueError) as error:
        raise UsageError(
            str(error) if isinstance(error, ValueError) else f'cannot read "{path}": {error.strerror}'
        ) from None
    values = np.array([value for _, value in pairs.points])
    if not np.all(values > 0.0):
        where = pairs.where(int(np.argmax(values <= 0.0)))
        raise UsageError(f"{where}: a capacitance or impedance must be greater than 0")
    if not impedance:
        return values
    if frequency is None:
        raise UsageError(f'"{path}" contains impedances: give their frequency, --frequency "10 kHz"')
    return np.asarray(1.0 / (2.0 * math.pi * frequency * values))
