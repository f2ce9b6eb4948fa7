"""Choose bearings by load, speed and required life."""

from __future__ import annotations

import math
import re
from collections import Counter
from collections.abc import Callable, Iterable, Sequence
from contextlib import closing
from typing import TYPE_CHECKING, Any

from pydantic import Field

from lambda_core.catalogue.protocol import BearingRow, RollerRow
from lambda_core.domain.errors import CaseError, LambdaError, UsageError, unknown_name
from lambda_core.domain.number_text import hours, number
from lambda_core.domain.unit_systems import SI, UnitSystem
from lambda_core.domain.units import parse, show
from lambda_core.elements.ball.kinds import kinds
from lambda_core.elements.roller.roller_bearing import FAMILIES, RIBS
from lambda_core.formulas.life import (
    basic_rating_life,
    contamination_range,
    dynamic_equivalent_load,
    life_hours,
    life_modification_factor,
    reference_viscosity,
    static_equivalent_load,
)
from lambda_core.formulas.ratings import fatigue_load_limit, static_factor
from lambda_core.model.checks.operating_limits import MINIMUM_LOAD
from lambda_core.model.fresh_case import HALF_LOADED
from lambda_core.results.record import INTERFACE, Record
from lambda_core.studies.roller_choice import against_load, against_thrust, is_of_kind

if TYPE_CHECKING:
    from lambda_core.domain.call_types import Count

    AnyRow = BearingRow | RollerRow

_ALL = 1_000_000  # rows of the catalogue
_TRIALS = 3  # equilibria that are solved at most for every bearing that is shown
_LEAST_SAFETY = 1.0  # static, unless more is asked for
_OF_ONE = {"have": "has", "are": "is", "do": "does", "need": "needs", "fit": "fits"}


class Candidate(Record):
    """Catalogue bearing computed for the operating point."""

    designation: str
    maker: str
    kind: str
    bore_mm: float
    outside_mm: float
    width_mm: float
    mass_kg: float | None
    basic_life_h: float | None = Field(description="L_10h of ISO 281")
    life_h: float | None = Field(description="rating life that counts, from the load of every ball or roller")
    life_name: str = Field(description="L_10rh, or L_nmrh where e_C is given")
    static_safety: float | None
    speed_share: float | None = Field(description="speed over the limiting speed of the catalogue")
    friction_torque_Nmm: float | None
    power_loss_W: float | None
    met: bool = Field(description="whether all requirements and limits are met")
    reason: str = Field(description="verdict, or why it could not be computed")


def _of_one(why: str) -> str:
    """Return a reason of several bearings as that of one."""
    return re.sub(r"^\w+|(?<=and )\w+", lambda verb: _OF_ONE.get(verb[0], verb[0]), why)


class Choice(Record):
    """Bearings for an operating point, and why others fail."""

    interface: int = INTERFACE
    question: str
    candidates: list[Candidate] = Field(description="those that meet everything first, the smallest first")
    left_out: dict[str, int] = Field(description="reason -> number of bearings of the catalogue")

    def text(self, units: UnitSystem = SI) -> str:
        """Return the table of bearings.

        The reasons why other bearings were left out follow it.
        """
        torque = f"torque {units.unit('N mm')}"
        head = ("bearing", f"d x D x B {units.unit('mm')}", "life", "C0/P0", "n/limit", torque, "")
        rows = [head, *(_cells(one, units) for one in self.candidates)]
        widths = [max(len(row[i]) for row in rows) for i in range(len(head) - 1)]
        lines = [
            "  ".join([row[0].ljust(widths[0]), *(cell.rjust(w) for cell, w in zip(row[1:-1], widths[1:], strict=True)),
                       row[-1]]).rstrip()
            for row in rows
        ]  # fmt: skip
        if not self.candidates:
            lines = ["no bearing of the catalogue fits"]
        reasons = sorted(self.left_out.items(), key=lambda one: -one[1])
        left = "; ".join(f"{count} {why if count > 1 else _of_one(why)}" for why, count in reasons)
        return "\n".join([units.sentence(self.question), "", *lines, *(["", f"left out: {left}"] if left else [])])


def _cells(one: Candidate, units: UnitSystem) -> tuple[str, ...]:
    sizes = " x ".join(f"{units.value(size, 'mm'):.4g}" for size in (one.bore_mm, one.outside_mm, one.width_mm))
    return (
        f"{one.maker} {one.designation}",
        sizes,
        "-" if one.life_h is None else f"{one.life_name} {hours(one.life_h)}",
        number(one.static_safety),
        "-" if one.speed_share is None else f"{100.0 * one.speed_share:.0f} %",
        units.number(one.friction_torque_Nmm, "N mm", 0),
        "ok" if one.met else one.reason,
    )


def choose(
    *,
    radial: str,
    speed: str,
    life: str,
    axial: str = "0 N",
    bore: str | None = None,
    outside: str | None = None,
    kind: str | None = None,
    maker: str | None = None,
    oil: str = "mineral-vg68",
    temperature: str = "70 degC",
    contamination: float | str | None = None,
    static_safety: float = _LEAST_SAFETY,
    limit: Count = 10,
    announce: Callable[[str], None] | None = None,
) -> Choice:
    """Choose bearings for an operating point, smallest first.

    All bearings are looked at by ISO 281 and by their limits; the smallest of those that fit are then solved with
    the load of every ball or roller (ISO/TS 16281), and judged as :func:`quasistatic` judges a case. Rollers that carry
    thrust on one side are looked at with it on that side.

    Parameters
    ----------
    radial, axial : str
        Loads with their units.
    speed : str
        Of the inner ring.
    life : str
        Required rating life, "20000 h".
    bore, outside : str, optional
        This bore; at most this outside diameter.
    kind, maker : str, optional
        Only these.
    oil, temperature : str
        Lubricant of the catalogue and its temperature in operation.
    contamination : float or str, optional
        e_C or a level of ISO 281: modified lives count then.
    static_safety : float
        Least C_0/P_0.
    limit : int
        Bearings to show.
    announce : callable, optional
        Called with a sentence before something takes longer.

    Returns
    -------
    Choice
        Candidates with their verdict, and for how many bearings which reason stood against them.

    Raises
    ------
    UsageError
        For a value without a unit, or an unknown kind or maker.
    CaseError
        For an unknown oil, a value that is out of range, or a level of contamination that there is none of.
    """
    from lambda_core.case.case_io import read_case
    from lambda_core.discovery.api import registry

    known = dict.fromkeys((*kinds(), *FAMILIES, *RIBS))
    if kind is not None and kind not in known:
        raise UsageError(unknown_name("kind of bearing", kind, known))
    wanted = _Wanted(radial, axial, speed, life, bore, outside, static_safety)
    shared = {
        "lubricant": {"name": oil, "temperature": temperature},
        "loads": {"radial": radial, "axial": axial},
        "operation": {"speed": speed},
        "bodies": {"inner_ring": {"tilt_y": "locked", "tilt_z": "locked"}},
        "requirements": {"life": life, "static_safety": static_safety},
        **({} if contamination is None else {"life": {"contamination": contamination}}),
    }
    # mistakes, once for all candidates; numbers may come as texts from the command line
    read = read_case({"name": "choice", "bearing": {"designation": "any"}, **shared})
    contamination = None if contamination is None else read.life.contamination
    with closing(registry().catalogue()) as catalogue:
        every: list[AnyRow] = [*catalogue.bearings("", _ALL), *catalogue.rollers()]
        rows = [row for row in every if _is_from(row, maker) and _is_of_kind(row, kind)]
        if maker is not None and not any(_is_from(row, maker) for row in every):
            raise UsageError(unknown_name("maker", maker, sorted({row.maker for row in every})))
        left: Counter[str] = Counter()
        fitting = []
        viscosity = _viscosity(rows, shared, announce) if contamination is not None else None
        for row in rows:
            reason = wanted.against(row, viscosity, contamination)
            if reason:
                left[reason] += 1
            else:
                fitting.append(row)
        fitting.sort(key=_volume)
        candidates = _solved(fitting, shared, limit, announce)
    more = len(fitting) - len(candidates)
    if more > 0:
        left["fit as well by ISO 281 and are larger"] = more
    candidates.sort(key=lambda one: (not one.met, one.outside_mm**2 * one.width_mm))
    return Choice(question=wanted.question(oil, temperature), candidates=candidates[:limit], left_out=dict(left))


def _is_of_kind(row: AnyRow, kind: str | None) -> bool:
    return is_of_kind(row, kind) if isinstance(row, RollerRow) else kind in (None, row.kind)


def _is_from(row: AnyRow, maker: str | None) -> bool:
    return maker is None or row.maker.upper() == maker.upper()


class _Wanted:
    """The operating point and the requirements, in SI."""

    def __init__(
        self, radial: str, axial: str, speed: str, life: str, bore: str | None, outside: str | None, safety: float
    ) -> None:
        self.radial, self.axial = abs(_si(radial, "force")), abs(_si(axial, "force"))
        self.speed, self.life = abs(_si(speed, "rotational_speed")), _si(life, "time") / 3600.0
        self.bore = None if bore is None else _si(bore, "length")
        self.outside = None if outside is None else _si(outside, "length")
        self.safety = safety
        if self.radial == 0.0 and self.axial == 0.0:
            raise UsageError("a bearing is chosen by its load: give a radial or an axial one")

    def question(self, oil: str, temperature: str) -> str:
        """Return what was asked for in one line."""
        loads = f"radial {show(self.radial, 'force', 4)}, axial {show(self.axial, 'force', 4)}"
        return (
            f"{loads}, {show(self.speed, 'rotational_speed', 4)}, {number(self.life, 0)} h required, "
            f"static safety {self.safety:g}, {oil} at {temperature}"
        )

    def against(self, row: AnyRow, viscosity: float | None, contamination: float | str | None) -> str:
        """Return the objections to a bearing.

        They are in plural words; the text is empty where there are none.
        """
        if self.bore is not None and not math.isclose(row.bore_diameter.value, self.bore, rel_tol=1e-6):
            return "have another bore"
        if self.outside is not None and row.outside_diameter.value > self.outside:
            return "are larger outside"
        if row.limiting_speed is not None and self.speed > row.limiting_speed.value:
            return "are too slow"
        if isinstance(row, RollerRow):
            loads, wanted = (self.radial, self.axial), (self.life, self.safety)
            refused = against_thrust(row, *loads, self.speed)
            return refused or against_load(row, loads, self.speed, wanted, viscosity, contamination)
        if row.dynamic_rating is None or row.static_rating is None or row.ball_diameter is None:
            return "have no ratings or inner geometry in the catalogue"
        return self._by_kind(row) or self._by_load(row, viscosity, contamination)

    def _by_kind(self, row: BearingRow) -> str:
        """Return the objection to a kind alone.

        It cannot carry this load as a single bearing.
        """
        if self.axial < kinds()[row.kind].least_thrust * self.radial:
            return f"need more axial load as {row.kind} bearings"
        if row.needs_thrust and row.contact_angle is not None:
            least = HALF_LOADED * math.tan(row.contact_angle.value) * self.radial
            if self.axial < least:
                return "have angular contact and need more axial load or a second bearing"
        return ""

    def _by_load(self, row: BearingRow, viscosity: float | None, contamination: float | str | None) -> str:
        """Return the objections by load.

        They concern life, static safety or minimum load (ISO 281, ISO 76).
        """
        assert row.dynamic_rating is not None
        assert row.static_rating is not None
        of_kind = kinds()[row.kind]
        aligning, rows = of_kind.on_sphere, of_kind.rows * of_kind.arcs
        angle = row.contact_angle.value if row.contact_angle is not None and not of_kind.is_radial else 0.0
        dynamic, static = row.dynamic_rating.value, row.static_rating.value
        mean = 0.5 * (row.bore_diameter.value + row.outside_diameter.value)
        pitch = row.pitch_diameter.value if row.pitch_diameter is not None else mean
        gamma = row.ball_diameter.value * math.cos(angle) / pitch if row.ball_diameter is not None else 0.2
        factor = static_factor(gamma, on_sphere=aligning)
        kind = (angle, rows)
        load = dynamic_equivalent_load(self.radial, self.axial, static, factor, *kind, on_sphere=aligning).load
        resting = static_equivalent_load(self.radial, self.axial, *kind, on_sphere=aligning)
        if static < self.safety * resting:
            return "have too little static safety"
        if self.speed > 0.0 and load < MINIMUM_LOAD * dynamic:
            return "are loaded below 0.01 C"
        life = life_hours(basic_rating_life(dynamic, load), self.speed)
        if viscosity is not None and contamination is not None and self.speed > 0.0:
            dirt = contamination_range(contamination, pitch)[0] if isinstance(contamination, str) else contamination
            limit = row.fatigue_limit.value if row.fatigue_limit is not None else fatigue_load_limit(static, pitch)
            ratio = viscosity / reference_viscosity(self.speed, pitch)
            life *= life_modification_factor(ratio, dirt, limit, load) if ratio >= 0.1 else 0.0
        return "do not reach the life" if life < self.life else ""


def _si(text: str, quantity: str) -> float:
    """Read a value with its unit.

    A UsageError gives the right form.
    """
    try:
        return parse(text, quantity)
    except ValueError as error:
        raise UsageError(str(error)) from None


def _volume(row: AnyRow) -> float:
    return row.outside_diameter.value**2 * row.width.value


def _case(row: AnyRow, shared: dict[str, Any]) -> dict[str, Any]:
    found = {"name": "choice", "bearing": {"designation": row.designation, "maker": row.maker}, **shared}
    if isinstance(row, RollerRow):  # mounted the way round that takes the thrust
        found["loads"] = {**shared["loads"], "axial": shared["loads"]["axial"].lstrip("+-")}
    return found


def _viscosity(rows: Sequence[AnyRow], shared: dict[str, Any], announce: Callable[[str], None] | None) -> float | None:
    """Return the oil's kinematic viscosity in operation [m2/s].

    It comes from the solution of one bearing.
    """
    from lambda_core.results.quasistatic import QuasiStatic
    from lambda_core.runs.api import quasistatic

    radial = [row for row in rows if isinstance(row, RollerRow) or kinds()[row.kind].is_radial]
    known = [row for row in radial if row.pitch_diameter is not None and row.dynamic_rating]
    if not known:
        return None
    row = max(known, key=lambda one: one.dynamic_rating.value if one.dynamic_rating else 0.0)
    pressed = row.contact_angle is not None and isinstance(row, RollerRow)  # tapered; the loads leave the oil as it is
    loads = {"radial": "1 kN", "axial": "1 kN" if pressed else "0 N"}
    found = quasistatic(_case(row, {**shared, "loads": loads}), announce=announce)
    assert isinstance(found, QuasiStatic)
    ratio = found.rating.viscosity_ratio if found.rating is not None else None
    if ratio is None or row.pitch_diameter is None:
        return None
    return ratio * reference_viscosity(
        parse(shared["operation"]["speed"], "rotational_speed"), row.pitch_diameter.value
    )


def _solved(
    rows: Iterable[AnyRow], shared: dict[str, Any], limit: int, announce: Callable[[str], None] | None
) -> list[Candidate]:
    """Solve the smallest bearings until enough meet everything."""
    found: list[Candidate] = []
    for row in rows:
        if sum(one.met for one in found) >= limit or len(found) >= _TRIALS * limit:
            break
        found.append(_candidate(row, shared, announce))
    return found


def _candidate(row: AnyRow, shared: dict[str, Any], announce: Callable[[str], None] | None) -> Candidate:
    """Solve one bearing and judge it."""
    from lambda_core.results.quasistatic import QuasiStatic
    from lambda_core.results.rating import life_that_counts
    from lambda_core.runs.api import quasistatic

    sizes = (row.bore_diameter, row.outside_diameter, row.width)
    bore, outside, width = (round(1e3 * size.value, 6) for size in sizes)
    named: dict[str, Any] = {
        "designation": row.designation, "maker": row.maker, "kind": row.kind, "bore_mm": bore, "outside_mm": outside,
        "width_mm": width, "mass_kg": row.mass.value if isinstance(row, BearingRow) and row.mass is not None else None,
    }  # fmt: skip
    try:
        found = quasistatic(_case(row, shared), announce=announce)
    except LambdaError as error:
        if isinstance(error, CaseError) and any(problem.where == "lubricant.name" for problem in error.problems):
            raise  # the same of all bearings
        nothing: dict[str, Any] = dict.fromkeys(
            ("basic_life_h", "life_h", "static_safety", "speed_share", "friction_torque_Nmm", "power_loss_W")
        )
        return Candidate(**named, **nothing, life_name="", met=False, reason=str(error).splitlines()[-1].strip())
    assert isinstance(found, QuasiStatic)
    assert found.rating is not None
    assert found.verdict is not None
    name, life = life_that_counts(found.rating)
    share = next((one.share for one in found.verdict.margins if one.name == "n"), None)
    return Candidate(
        **named, basic_life_h=found.rating.basic_life_h, life_h=life, life_name=name,
        static_safety=found.rating.static_safety, speed_share=share, friction_torque_Nmm=found.friction_torque_Nmm,
        power_loss_W=found.power_loss_W, met=found.verdict.met, reason=found.verdict.sentence,
    )  # fmt: skip
