"""Declare the section electric."""

from __future__ import annotations

from itertools import pairwise
from pathlib import Path
from typing import Any, Literal

from pydantic import PrivateAttr, ValidationInfo, model_validator

from lambda_core.case.option import Section, option
from lambda_core.case.pairs import Pairs, Points, given_pairs
from lambda_core.domain.roles import DEFAULT_MODELS
from lambda_core.domain.units import (
    Capacitance,
    Conductivity,
    Frequency,
    Resistance,
    Time,
    Voltage,
    show,
)


class Inverter(Section):
    """Common-mode voltage of a two-level inverter.

    It has three phases and sine-triangle modulation.
    """

    dc_link: Voltage = option("800 V", "voltage of the dc link", gt=0.0, le=1e6)
    switching_frequency: Frequency = option("10 kHz", "frequency of the triangle", gt=0.0)
    rise_time: Time = option("50 ns", "duration of a switching edge", gt=0.0)
    modulation: float = option(0.8, "amplitude of the sine over that of the triangle", ge=0.0, le=1.0)
    pole_pairs: int = option(4, "of the machine: its fundamental is pole pairs times speed", ge=1)

    @model_validator(mode="after")
    def _edges_fit(self) -> Inverter:
        if self.rise_time * self.switching_frequency > 0.05:
            raise ValueError(
                "`rise_time` is more than 1/20 of a switching period, so that edges would overlap: shorten it"
            )
        return self


class Sine(Section):
    """Sinusoidal common-mode voltage."""

    amplitude: Voltage = option(description="amplitude", gt=0.0, le=1e6)
    frequency: Frequency = option(description="frequency", gt=0.0)
    points: int = option(200, "corners of the polygon per period", ge=16)


class Step(Section):
    """One edge of the common-mode voltage from zero."""

    amplitude: Voltage = option(description="voltage after the edge", ge=-1e6, le=1e6)
    time: Time = option("0 s", "when the edge begins", ge=0.0)
    rise_time: Time = option("50 ns", "duration of the edge", gt=0.0)


class Series(Section):
    """Measured common-mode voltage.

    Straight lines join the pairs; it is constant outside, or repeated.

    Where it is repeated the period is the last time less the first one where the last voltage equals the first;
    otherwise one median step more.
    """

    points: list[tuple[Time, Voltage]] | None = option(
        None, 'pairs of time and voltage, [["0 s", "0 V"], ["1 us", "5 V"], ...]'
    )
    file: str | None = option(None, 'CSV file whose header is "time [s],voltage [V]"', min_length=1)
    repeat: bool = option(False, "begin again behind the last pair; otherwise the last voltage stays")
    _rows: Points = PrivateAttr(default=())

    @model_validator(mode="after")
    def _read(self, info: ValidationInfo) -> Series:
        folder = Path((info.context or {}).get("folder") or ".")
        pairs = given_pairs(self.points, self.file, "voltage", folder)
        check_series(pairs)
        _check_voltages(pairs)
        self._rows = pairs.points
        return self

    @property
    def rows(self) -> Points:
        """Points as (time [s], voltage [V])."""
        return self._rows

    def inlined(self) -> dict[str, Any]:
        """Return the series with its points written out.

        The case then needs no other file.
        """
        repeat = {"repeat": True} if self.repeat else {}
        return {"points": [[show(t, "time"), show(v, "voltage")] for t, v in self.rows], **repeat}


def check_series(pairs: Pairs) -> None:
    """Refuse a measured series with errors.

    It is too short or has gaps; ValueError with the row.
    """
    if len(pairs.points) < 3:
        raise ValueError(f"{pairs.name}: a series needs at least three rows")
    steps = [later[0] - earlier[0] for earlier, later in pairwise(pairs.points)]
    usual = sorted(steps)[len(steps) // 2]
    for index, step in enumerate(steps, 1):
        if step > _GAP * usual:
            raise ValueError(
                f"{pairs.where(index)}: a gap of {step:.4g} s where the rows are {usual:.4g} s apart; "
                "cut the series there, or fill the gap"
            )


def _check_voltages(pairs: Pairs) -> None:
    """Refuse voltages that no machine has: a unit is wrong."""
    for index, (_, voltage) in enumerate(pairs.points):
        if abs(voltage) > _MOST_VOLTAGE:
            raise ValueError(
                f"{pairs.where(index)}: {voltage:.4g} V is more than {_MOST_VOLTAGE:g} V; is the unit right?"
            )


_MOST_VOLTAGE = 1e6  # [V]
_GAP = 20.0  # times the usual distance of rows


class MachineCapacitances(Section):
    """Capacitances of the machine between winding, rotor and frame."""

    winding_rotor: Capacitance = option(
        "50 pF",
        "C_wr, winding to rotor",
        reference="order of magnitude, Muetze and Binder 2007, IEEE TIE 54, 1614",
        gt=0.0,
    )
    rotor_frame: Capacitance = option(
        "800 pF",
        "C_rf, rotor to frame",
        reference="order of magnitude, Muetze and Binder 2007, IEEE TIE 54, 1614",
        ge=0.0,
    )
    other_bearings: Capacitance | None = option(
        None,
        "of all bearings that are not in the file; absent: one more like this, or none where the file is of a machine",
        ge=0.0,
    )


class Grounding(Section):
    """Parts that conduct the current or block it."""

    brush: Resistance | None = option(None, "resistance of a grounding brush on the shaft; absent: no brush", gt=0.0)
    insulation: Capacitance | None = option(
        None, "of a coating or sleeve on the outer ring; absent: the ring touches the frame", gt=0.0
    )
    insulation_resistance: Resistance = option("1 GOhm", "of that coating", gt=0.0)
    shunt: Resistance | None = option(None, "that bridges the insulation, to measure the current", gt=0.0)

    @model_validator(mode="after")
    def _shunt_needs_insulation(self) -> Grounding:
        if self.shunt is not None and self.insulation is None:
            raise ValueError("`shunt` requires `insulation`")
        return self


class Film(Section):
    """The lubricating film and its surroundings as electric parts."""

    conductivity: Conductivity = option(
        "1e-10 S/m", "of the oil", reference="order of magnitude for mineral oils", ge=0.0
    )
    metal_resistance: Resistance = option("1 Ohm", "of a contact whose asperities touch", reference="assumed", gt=0.0)
    roughness: Literal["smooth", "gamma"] = option(
        "smooth", "whether roughness raises the capacitance of the Hertzian area"
    )
    surroundings: Capacitance | None = option(
        None, "of the rings against each other past the balls; absent: shoulders as coaxial cylinders in air", ge=0.0
    )
    seals: Capacitance = option("0 pF", "of seals and shields between the rings, in addition", ge=0.0)
    ball_permittivity: float | None = option(
        None,
        "relative permittivity of balls that insulate; absent: 8 for balls of silicon nitride, all others conduct",
        gt=1.0,
    )


class Cage(Section):
    """Metal cage as a conductor between the balls.

    Absent: a cage of plastic, which does not conduct.
    """

    pocket: Capacitance = option(description="of one ball against the cage", gt=0.0)
    inner: Capacitance = option("0 pF", "of the cage against the inner ring", ge=0.0)
    outer: Capacitance = option("0 pF", "of the cage against the outer ring", ge=0.0)


class Breakdown(Section):
    """Voltage that a film stands."""

    law: str = option(DEFAULT_MODELS["breakdown"], "law of the role breakdown")
    parameters: dict[str, Any] = option({}, "parameters of that law")
    least_voltage: Voltage = option("0.5 V", "below it nothing breaks down under any law", gt=0.0)


class Discharge(Section):
    """The arc in a film that broke down."""

    law: str = option(DEFAULT_MODELS["discharge"], "law of the role discharge")
    parameters: dict[str, Any] = option({}, "parameters of that law")


class Electric(Section):
    """Bearing in the circuit of an electric machine.

    Absent: the circuit is not computed.
    """

    inverter: Inverter | None = option(None, "source: two-level inverter; without any source this with its defaults")
    sine: Sine | None = option(None, "source: sinusoidal common-mode voltage")
    step: Step | None = option(None, "source: one edge of the common-mode voltage")
    series: Series | None = option(None, "source: measured common-mode voltage")
    machine: MachineCapacitances = option({}, "capacitances of the machine")
    grounding: Grounding = option({}, "brush, insulation, shunt")
    film: Film = option({}, "conduction and surroundings of the films")
    cage: Cage | None = option(None, "a cage that conducts")
    breakdown: Breakdown = option({}, "when a film breaks down")
    discharge: Discharge = option({}, "what burns then")
    seed: int = option(1, "key of the random numbers: the same seed gives the same discharges", ge=0, lt=2**31)
    duration: Time | None = option(
        None, "time that is computed; absent: the averaging window of a run, 10 turns of the cage of a case", gt=0.0
    )

    @property
    def source(self) -> Inverter | Sine | Step | Series:
        """Voltage source of the circuit."""
        return self.sine or self.step or self.series or self.inverter or Inverter()

    @property
    def twins(self) -> float:
        """Number of further bearings like the one of the case.

        They count with its capacitance where the case does not give the other bearings'.
        """
        return 1.0 if self.machine.other_bearings is None else 0.0

    def of_bearing(self, name: str) -> Electric:
        """Return the circuit of one bearing.

        The case has one bearing, and this circuit is that of it.
        """
        del name
        return self

    @model_validator(mode="after")
    def _one_source(self) -> Electric:
        given = [name for name in ("inverter", "sine", "step", "series") if getattr(self, name) is not None]
        if len(given) > 1:
            raise ValueError(f"{' and '.join(given)} are both sources: give one of inverter, sine, step, series")
        return self

    def inlined(self) -> Electric:
        """Return the options with a series written out.

        The series is a measured one; the case then needs no other file.
        """
        if self.series is None or self.series.file is None:
            return self
        return self.model_copy(update={"series": Series.model_validate(self.series.inlined())})


class BearingElectric(Section):
    """Circuit options of one bearing of a machine."""

    insulation: Capacitance | None = option(
        None, "of a coating or sleeve on the outer ring; absent: the ring touches the frame", gt=0.0
    )
    insulation_resistance: Resistance = option("1 GOhm", "of that coating", gt=0.0)
    shunt: Resistance | None = option(None, "that bridges the insulation, to measure the current", gt=0.0)
    film: Film = option({}, "conduction and surroundings of its films; absent values are those of electric.film")
    cage: Cage | None = option(None, "a cage that conducts; absent: electric.cage")
    least_voltage: Voltage | None = option(None, "below which its films hold; absent: that of all bearings", gt=0.0)

    @model_validator(mode="after")
    def _shunt_needs_insulation(self) -> BearingElectric:
        if self.shunt is not None and self.insulation is None:
            raise ValueError("`shunt` requires `insulation`")
        return self


class MachineElectric(Electric):
    """All bearings of a machine in one circuit.

    Absent: the circuit is not computed.
    """

    bearings: dict[str, BearingElectric] = option({}, "insulation, films and cage of single bearings, by name")

    @model_validator(mode="after")
    def _insulation_is_a_bearings(self) -> MachineElectric:
        own = {"insulation", "insulation_resistance", "shunt"} & self.grounding.model_fields_set
        if own:
            raise ValueError(f"write {sorted(own)[0]} in [electric.bearings.NAME]: each bearing has its own")
        return self

    @property
    def twins(self) -> float:
        """None: the case has all bearings."""
        return 0.0

    def of_bearing(self, name: str) -> Electric:
        """Return the circuit of one bearing.

        Its own options replace the common ones.
        """
        own = self.bearings.get(name, BearingElectric())
        grounding = {n: getattr(own, n) for n in ("insulation", "insulation_resistance", "shunt")}
        film = {n: getattr(own.film, n) for n in own.film.model_fields_set}
        least = self.breakdown.least_voltage if own.least_voltage is None else own.least_voltage
        return self.model_copy(
            update={
                "grounding": self.grounding.model_copy(update=grounding),
                "film": self.film.model_copy(update=film),
                "cage": own.cage or self.cage,
                "breakdown": self.breakdown.model_copy(update={"least_voltage": least}),
            }
        )
