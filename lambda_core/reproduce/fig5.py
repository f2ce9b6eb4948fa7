"""Fig. 5: above which axial excitation the balls of the 6220 run differently."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from itertools import pairwise

import numpy as np
from pydantic import Field

from lambda_core.reproduce.boundary import CASE, CRITERIA, LIMITS, STANDARD_ERRORS, TURNS, Ray, Setting, search
from lambda_core.reproduce.workshop import Answer, Job, Workshop
from lambda_core.simulate.summary import Record

LOADS = (2.0, 5.0, 10.0)  # F_stat [kN]
VARIANTS = {
    "A": "the outer ring moves, the inner ring with its shaft is axially free",
    "B": "both rings move together: only balls and cage feel inertia",
}
# Half the lowest axial resonance is the upper end: above it the rings' motion against each other is amplified.
FREQUENCIES = (15.0, 20.0, 26.0, 34.0, 44.0)  # [Hz]
QUICK_FREQUENCIES = (20.0, 40.0)
RATIO, QUICK_RATIO = 1.2, 1.5  # of a bracket's ends
MIDDLE = 26.0  # [Hz] frequency at which the assumptions are varied
VARIATIONS: dict[str, tuple[Setting, ...]] = {
    "speed 1000 and 3000 1/min": (Setting("A", 5.0, 1000.0), Setting("A", 5.0, 3000.0)),
    "shaft mass 2 and 20 kg": tuple(
        Setting("A", 5.0, extra=(f"bodies.inner_ring.shaft_mass={m} kg",)) for m in (2, 20)
    ),
    "oil at 40 and 80 degC": tuple(Setting("A", 5.0, extra=(f"lubricant.temperature={t} degC",)) for t in (40, 80)),
    "clearance 15 and 41 um (ends of CN)": tuple(
        Setting("A", 5.0, extra=(f"bearing.clearance={c} um",)) for c in (15, 41)
    ),
}


class BoundaryPoint(Record):
    """One point of a boundary."""

    variant: str
    load_N: float
    criterion: str
    frequency_Hz: float
    velocity_m_per_s: float | None = Field(description="velocity amplitude of the excitation; null: none found")
    acceleration_m_per_s2: float | None
    low_m_per_s: float | None = Field(description="largest amplitude that was simulated and left the running unaltered")
    high_m_per_s: float | None = Field(description="smallest amplitude that altered it")
    runs: int


class Line(Record):
    """One boundary over frequency."""

    variant: str
    load_N: float
    criterion: str
    slope: float | None = Field(description="of log velocity over log frequency, least squares")
    falls: bool = Field(description="monotonically with frequency")


class Resonance(Record):
    """Axial resonance of the inner ring with its shaft on the static load's stiffness."""

    load_N: float
    stiffness_N_per_um: float
    mass_kg: float
    frequency_Hz: float


class Variation(Record):
    """What one assumption does to the boundary: velocity over that of the base case at the same frequency."""

    what: str
    criterion: str
    ratios: list[float | None]


class Fig5(Record):
    """The stability map."""

    frequency_range_Hz: tuple[float, float]
    resonances: list[Resonance]
    points: list[BoundaryPoint]
    lines: list[Line]
    variations: list[Variation]
    still: dict[str, dict[str, float]] = Field(description="S_0 and T_0 without excitation")
    bars: list[str]
    notes: list[str]


def fig5(workshop: Workshop, *, quick: bool = False) -> Fig5:
    """Find the boundaries.

    Parameters
    ----------
    quick : bool
        Variant A only, two frequencies, wider brackets, no variations.
    """
    frequencies, ratio = (QUICK_FREQUENCIES, QUICK_RATIO) if quick else (FREQUENCIES, RATIO)
    rays = [
        Ray(Setting(variant, load), frequency)
        for variant in (("A",) if quick else VARIANTS)
        for load in LOADS
        for frequency in frequencies
    ]
    varied = [] if quick else [Ray(setting, MIDDLE) for pair in VARIATIONS.values() for setting in pair]
    resonances = _resonances(workshop)
    still = search(workshop, [*rays, *varied], ratio)
    points = [_point(ray, criterion, still[ray.setting]) for ray in rays for criterion in CRITERIA]
    lines = _lines(points)
    return Fig5(
        frequency_range_Hz=(frequencies[0], frequencies[-1]),
        resonances=resonances,
        points=points,
        lines=lines,
        variations=_variations(points, varied, still) if varied else [],
        still={_name(setting): {c: answer[c] for c in CRITERIA} for setting, answer in still.items()},
        bars=_bars(points, lines, resonances, frequencies),
        notes=_notes(quick, ratio),
    )


def _name(setting: Setting) -> str:
    extra = f", {setting.speed:g} 1/min" if setting.speed != 1500.0 else ""
    return ", ".join([f"{setting.variant}, {setting.load:g} kN{extra}", *setting.extra])


def _resonances(workshop: Workshop) -> list[Resonance]:
    jobs = [Job(CASE, Setting("A", load).changes(), "axial resonance") for load in LOADS]
    return [
        Resonance(
            load_N=1e3 * load,
            stiffness_N_per_um=answer["stiffness_N_per_um"],
            mass_kg=answer["mass_kg"],
            frequency_Hz=answer["resonance_Hz"],
        )
        for load, answer in zip(LOADS, workshop.all(jobs), strict=True)
    ]


def _point(ray: Ray, criterion: str, still: Answer) -> BoundaryPoint:
    def velocity(acceleration: float | None) -> float | None:
        return None if acceleration is None else acceleration / (2.0 * math.pi * ray.frequency)

    found = ray.boundary(criterion, still)
    low, high = ray.bracket(criterion, still)
    return BoundaryPoint(
        variant=ray.setting.variant,
        load_N=1e3 * ray.setting.load,
        criterion=criterion,
        frequency_Hz=ray.frequency,
        velocity_m_per_s=velocity(found),
        acceleration_m_per_s2=found,
        low_m_per_s=velocity(low),
        high_m_per_s=velocity(high),
        runs=len(ray.tried),
    )


def _lines(points: Sequence[BoundaryPoint]) -> list[Line]:
    keys = dict.fromkeys((p.variant, p.load_N, p.criterion) for p in points)
    return [_line(key, [p for p in points if (p.variant, p.load_N, p.criterion) == key]) for key in keys]


def _line(key: tuple[str, float, str], points: Sequence[BoundaryPoint]) -> Line:
    pairs = [(p.frequency_Hz, p.velocity_m_per_s) for p in points if p.velocity_m_per_s is not None]
    slope, falls = None, False
    if len(pairs) == len(points):
        frequency, velocity = np.log(np.array(pairs)).T
        slope = float(np.polyfit(frequency, velocity, 1)[0])
        falls = bool(np.all(np.diff(velocity) < 0.0))
    return Line(variant=key[0], load_N=key[1], criterion=key[2], slope=slope, falls=falls)


def _variations(
    points: Sequence[BoundaryPoint], varied: Sequence[Ray], still: Mapping[Setting, Answer]
) -> list[Variation]:
    found, rays = [], iter(varied)
    pairs = {what: [next(rays) for _ in settings] for what, settings in VARIATIONS.items()}
    for what, pair in pairs.items():
        for criterion in CRITERIA:
            base = next(
                p.acceleration_m_per_s2
                for p in points
                if (p.variant, p.load_N, p.criterion, p.frequency_Hz) == ("A", 5e3, criterion, MIDDLE)
            )
            values = [ray.boundary(criterion, still[ray.setting]) for ray in pair]
            ratios = [None if value is None or base is None else value / base for value in values]
            found.append(Variation(what=what, criterion=criterion, ratios=ratios))
    return found


def _bars(
    points: Sequence[BoundaryPoint],
    lines: Sequence[Line],
    resonances: Sequence[Resonance],
    frequencies: Sequence[float],
) -> list[str]:
    """Say which of the paper's trends are met, line by line where not."""

    def name(line: Line) -> str:
        return f"{line.variant} {line.load_N / 1e3:g} kN {line.criterion}"

    rising = [name(line) for line in lines if not line.falls]
    steep = [
        f"{name(line)}: {line.slope:.2f}" for line in lines if line.slope is not None and abs(line.slope + 1) > 0.25
    ]
    steep += [f"{name(line)}: none found" for line in lines if line.slope is None]
    slopes = [line.slope for line in lines if line.slope is not None]
    across = _against_load(points)
    lowest = min(r.frequency_Hz for r in resonances)
    below = frequencies[-1] < lowest

    def verdict(wrong: Sequence[str], what: str) -> str:
        return f"missed: {what}: {'; '.join(wrong)}" if wrong else f"met: {what}"

    return [
        verdict(rising, "every boundary falls monotonically with frequency"),
        verdict(
            steep, f"log-log slope within -1 +- 0.25 (found {min(slopes):.2f} to {max(slopes):.2f})" if slopes else ""
        ),
        verdict(across, "every boundary moves up with the static load"),
        f"{'met' if below else 'missed'}: {frequencies[0]:g} to {frequencies[-1]:g} Hz lie below the lowest axial "
        f"resonance, {lowest:.0f} Hz",
    ]


def _against_load(points: Sequence[BoundaryPoint]) -> list[str]:
    """Return where a boundary does not move up with the load."""
    wrong = []
    for variant, criterion, frequency in dict.fromkeys((p.variant, p.criterion, p.frequency_Hz) for p in points):
        mine = [p for p in points if (p.variant, p.criterion, p.frequency_Hz) == (variant, criterion, frequency)]
        values = [p.velocity_m_per_s for p in sorted(mine, key=lambda p: p.load_N)]
        if any(a is None or b is None or b <= a for a, b in pairwise(values)):
            wrong.append(f"{variant} {criterion} at {frequency:g} Hz")
    return wrong


def _notes(quick: bool, ratio: float) -> list[str]:
    notes = [
        "assumed, as the paper prints none of it: 1500 1/min, FVA3 at 60 degC, clearance in the middle of CN, "
        "F_stat 2, 5 and 10 kN, shaft of 5 kg, catalogue geometry of the 6220, brass cage",
        *(f"variant {name}: {what}" for name, what in VARIANTS.items() if name == "A" or not quick),
        f"S: rms over azimuth outside the static load zone of (orbital over kinematic speed - 1), over at least "
        f"{TURNS:g} cage turns and whole excitation periods; altered where it differs by more than {LIMITS['S']:.0%} "
        f"and {STANDARD_ERRORS:g} standard errors from the run without excitation",
        f"T: share of time in which the inner ring presses a ball outside the static load zone; altered where it has "
        f"grown by more than {LIMITS['T']:g} and {STANDARD_ERRORS:g} standard errors (the limit is an assumption)",
        f"bisection along each ray until the bracket's ends differ by less than a factor {ratio:g}",
        "the inner ring does not tilt: a shaft on two bearings does not rock about the loaded balls of one",
        "15 strips per contact, the motion starts from rest at its turning point, one cage turn is discarded",
    ]
    return [*notes, "quick: variant A, two frequencies, no variations"] if quick else notes
