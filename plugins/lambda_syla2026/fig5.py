"""Repeat Fig. 5: onset of altered running of the 6220."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence

from pydantic import Field

from lambda_core.results.record import Record
from lambda_syla2026.apart import Apart, apart
from lambda_syla2026.boundary import (
    CASE,
    CRITERIA,
    LIMITS,
    STANDARD_ERRORS,
    STILL_TURNS,
    TURNS,
    Ray,
    Setting,
    search,
)
from lambda_syla2026.job_runner import Job, JobResult, JobRunner
from lambda_syla2026.trends import BoundaryPoint, Line, Step, bars, lines, steps

LOADS = (2.0, 5.0, 10.0)  # F_stat [kN]
VARIANTS = {
    "A": "the outer ring moves, the inner ring with its shaft is axially free",
    "B": "both rings move together: only balls and cage feel inertia",
}
# The declared range. It ends at a quarter of the lowest axial resonance, that of the cage on the balls that only
# centrifugal force holds: up to there an undamped oscillator follows within 1/(1 - 1/16), 7 %, of its static
# deflection, so the acceleration governs. Its lower end leaves five periods to average over.
FREQUENCIES = (5.0, 6.7, 8.9, 12.0, 16.0)  # [Hz]
BEYOND = (24.0, 40.0)  # [Hz] what follows above, on the map but in no slope
QUICK_LOADS = (2.0, 5.0)
QUICK_FREQUENCIES = (6.0, 14.0)
RATIO, QUICK_RATIO = 1.2, 1.5  # of a bracket's ends
QUICK_SHARE = 0.4  # of the cage turns
MIDDLE = 8.9  # [Hz] frequency at which the assumptions are varied
VARIATIONS: dict[str, tuple[Setting, ...]] = {
    "speed 1000 and 3000 1/min": (Setting("A", 5.0, 1000.0), Setting("A", 5.0, 3000.0)),
    "shaft mass 2 and 20 kg": tuple(
        Setting("A", 5.0, extra=(f"bodies.inner_ring.shaft_mass={m} kg",)) for m in (2, 20)
    ),
    "oil at 40 and 80 degC": tuple(Setting("A", 5.0, extra=(f"lubricant.temperature={t} degC",)) for t in (40, 80)),
    "clearance 12 and 36 um (ends of CN)": tuple(
        Setting("A", 5.0, extra=(f"bearing.clearance={c} um",)) for c in (12, 36)
    ),
    "machined brass and polyamide cage": tuple(
        Setting("A", 5.0, extra=(f"bodies.cage.type={cage}",)) for cage in ("brass-machined", "pa66")
    ),
}


class Resonance(Record):
    """Axial resonances of the inner ring and loose parts.

    Inner ring with shaft on the bearing's stiffness; parts that only centrifugal force holds.
    """

    load_N: float
    stiffness_N_per_um: float
    mass_kg: float
    frequency_Hz: float
    ball_Hz: float = Field(description="an unloaded ball that rolls across the outer groove")
    cage_Hz: float = Field(description="the cage on all unloaded balls, without play in its pockets")


class Variation(Record):
    """Effect of one assumption on the boundary.

    It is the velocity over that of the base case at the same frequency.
    """

    what: str
    criterion: str
    ratios: list[float | None]


class Fig5(Record):
    """The stability map."""

    frequency_range_Hz: tuple[float, float]
    resonances: list[Resonance]
    points: list[BoundaryPoint]
    lines: list[Line]
    steps: list[Step]
    variations: list[Variation]
    still: dict[str, dict[str, float]] = Field(description="S_0 and T_0 without excitation")
    apart: list[Apart] = Field(description="variant A, 5 kN, 8.9 Hz: dynamic over quasi-static; empty when quick")
    bars: list[str]
    notes: list[str]


def fig5(runner: JobRunner, *, quick: bool = False) -> Fig5:
    """Find the boundaries.

    Parameters
    ----------
    quick : bool
        Variant A only, two loads and frequencies, wider brackets, fewer cage turns, no variations.
    """
    declared, ratio, share = (QUICK_FREQUENCIES, QUICK_RATIO, QUICK_SHARE) if quick else (FREQUENCIES, RATIO, 1.0)
    rays = [
        Ray(Setting(variant, load, share=share), frequency)
        for variant in (("A",) if quick else VARIANTS)
        for load in (QUICK_LOADS if quick else LOADS)
        for frequency in (declared if quick else (*declared, *BEYOND))
    ]
    varied = [] if quick else [Ray(setting, MIDDLE) for pair in VARIATIONS.values() for setting in pair]
    resonances = _resonances(runner)
    still = search(runner, [*rays, *varied], ratio)
    top = declared[-1]
    points = [_point(ray, criterion, still[ray.setting], top) for ray in rays for criterion in CRITERIA]
    return Fig5(
        frequency_range_Hz=(declared[0], declared[-1]),
        resonances=resonances,
        points=points,
        lines=lines(points),
        steps=steps(points),
        variations=_variations(points, varied, still) if varied else [],
        still={_name(setting): {c: answer[c] for c in CRITERIA} for setting, answer in still.items()},
        apart=[] if quick else apart(runner),
        bars=bars(points, resonances, declared),
        notes=_notes(quick, ratio, share),
    )


def _name(setting: Setting) -> str:
    extra = f", {setting.speed:g} 1/min" if setting.speed != 1500.0 else ""
    return ", ".join([f"{setting.variant}, {setting.load:g} kN{extra}", *setting.extra])


def _resonances(runner: JobRunner) -> list[Resonance]:
    jobs = [Job(CASE, Setting("A", load).changes(), "axial resonance") for load in LOADS]
    return [
        Resonance(
            load_N=1e3 * load,
            stiffness_N_per_um=answer["stiffness_N_per_um"],
            mass_kg=answer["mass_kg"],
            frequency_Hz=answer["resonance_Hz"],
            ball_Hz=answer["ball_Hz"],
            cage_Hz=answer["cage_Hz"],
        )
        for load, answer in zip(LOADS, runner.all(jobs), strict=True)
    ]


def _point(ray: Ray, criterion: str, still: JobResult, top: float) -> BoundaryPoint:
    def velocity(acceleration: float | None) -> float | None:
        return None if acceleration is None else acceleration / (2.0 * math.pi * ray.frequency)

    found = ray.boundary(criterion, still)
    low, high = ray.bracket(criterion, still)
    return BoundaryPoint(
        variant=ray.setting.variant,
        load_N=1e3 * ray.setting.load,
        criterion=criterion,
        frequency_Hz=ray.frequency,
        velocity_m_per_s=velocity(found.acceleration if found else None),
        acceleration_m_per_s2=found.acceleration if found else None,
        own_error=found.own_error if found else None,
        still_error=found.still_error if found else None,
        low_m_per_s=velocity(low),
        high_m_per_s=velocity(high),
        runs=len(ray.tried),
        declared=ray.frequency <= top,
        failed=ray.lost,
    )


def _variations(
    points: Sequence[BoundaryPoint], varied: Sequence[Ray], still: Mapping[Setting, JobResult]
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
            ratios = [None if value is None or base is None else value.acceleration / base for value in values]
            found.append(Variation(what=what, criterion=criterion, ratios=ratios))
    return found


def _notes(quick: bool, ratio: float, share: float) -> list[str]:
    notes = [
        "assumed, as the paper prints none of it: 1500 1/min, FVA3 at 60 degC, clearance in the middle of CN, "
        "F_stat 2, 5 and 10 kN, shaft of 5 kg, catalogue geometry of the 6220, its steel cage",
        *(f"variant {name}: {what}" for name, what in VARIANTS.items() if name == "A" or not quick),
        f"S: rms over azimuth outside the static load zone of (orbital over kinematic speed - 1), over at least "
        f"{share * TURNS:g} cage turns and whole excitation periods; altered where it differs by more than "
        f"{LIMITS['S']:.0%} and {STANDARD_ERRORS:g} standard errors from the run without excitation",
        f"T: share of time in which the inner ring presses a ball outside the static load zone; altered where it has "
        f"grown by more than {LIMITS['T']:g} and {STANDARD_ERRORS:g} standard errors (the limit is an assumption)",
        f"bisection along each ray until the bracket's ends differ by less than a factor {ratio:g}",
        "the inner ring does not tilt: a shaft on two bearings does not rock about the loaded balls of one",
        f"15 strips per contact, the motion starts from rest at its turning point, one cage turn is discarded; the run "
        f"without excitation averages {share * STILL_TURNS:g} turns",
        "unloaded balls and cage are held axially by centrifugal force in the outer groove alone: an unloaded ball "
        "rolls across it with (omega_cage/2 pi) sqrt(5 r_m/(7 (r_o - D_w/2))), the cage on n of them with "
        "sqrt(n k/(m_cage + 7 n m_ball/5)), k = m_ball r_m omega_cage^2/(r_o - D_w/2); play in the pockets lowers it",
    ]
    return [*notes, "quick: variant A, two loads and frequencies, fewer turns, no variations"] if quick else notes
