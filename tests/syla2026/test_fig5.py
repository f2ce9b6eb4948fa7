"""Test slopes and verdicts of the stability map."""

from __future__ import annotations

import math

import pytest
from lambda_syla2026.boundary import CRITERIA
from lambda_syla2026.charts import fig5_chart
from lambda_syla2026.fig5 import BEYOND, FREQUENCIES, Fig5, Resonance
from lambda_syla2026.trends import BoundaryPoint, lines, steps
from lambda_syla2026.trends import bars as verdicts

LOADS = (2e3, 5e3, 10e3)
RESONANCES = [
    Resonance(load_N=load, stiffness_N_per_um=2.0, mass_kg=6.0, frequency_Hz=88.0, ball_Hz=83.0, cage_Hz=68.0)
    for load in LOADS
]


def points(slope: float = -1.0, by_load: float = 1.2, own: float = 0.03, still: float = 0.02) -> list[BoundaryPoint]:
    """Return boundaries v = v_0 f^slope.

    In the declared range, one steeper above, `by_load` higher from load to load.
    """
    found = []
    for variant in ("A", "B"):
        for i, load in enumerate(LOADS):
            for criterion in CRITERIA:
                for f in (*FREQUENCIES, *BEYOND):
                    top = FREQUENCIES[-1]
                    v = by_load**i * min(f, top) ** slope * (max(f, top) / top) ** (slope - 1.0)
                    found.append(
                        BoundaryPoint(
                            variant=variant,
                            load_N=load,
                            criterion=criterion,
                            frequency_Hz=f,
                            velocity_m_per_s=v,
                            acceleration_m_per_s2=2.0 * math.pi * f * v,
                            own_error=own,
                            still_error=still,
                            low_m_per_s=0.9 * v,
                            high_m_per_s=1.1 * v,
                            runs=4,
                            declared=f <= top,
                        )
                    )
    return found


def bars(found: list[BoundaryPoint]) -> list[str]:
    return verdicts(found, RESONANCES, FREQUENCIES)


def test_slopes_inside_and_above_the_declared_range() -> None:
    for line in lines(points(-1.1)):
        assert line.slope == pytest.approx(-1.1)
        assert line.slope_beyond == pytest.approx(-2.1)
        assert line.falls


def test_every_bar_is_met_by_constant_acceleration() -> None:
    assert all(bar.startswith("met: ") for bar in bars(points()))


def test_a_steep_slope_is_missed_and_named() -> None:
    wrong = [bar for bar in bars(points(-1.4)) if bar.startswith("missed: ")]
    assert len(wrong) == len(CRITERIA)
    assert all("A 5 kN" in bar and "-1.40" in bar for bar in wrong)


def test_a_rising_boundary_is_missed() -> None:
    assert any(bar.startswith("missed: every boundary falls") for bar in bars(points(0.1)))


def test_a_boundary_that_does_not_move_up_is_missed() -> None:
    wrong = [bar for bar in bars(points(by_load=0.95)) if bar.startswith("missed: ")]
    assert len(wrong) == len(CRITERIA)
    assert all("-5.0 +- 3.2 % to 5 kN (not resolved), -5.0 +- 3.2 % to 10 kN" in bar for bar in wrong)


def test_the_error_of_a_slope_is_that_of_its_points() -> None:
    """Compute a slope's error by least squares.

    sigma/sqrt(sum (x - mean)^2); an error common to all points does not turn a line.
    """
    x = [math.log(f) for f in FREQUENCIES]
    spread = math.sqrt(sum((v - sum(x) / len(x)) ** 2 for v in x))
    for still in (0.0, 0.5):
        for line in lines(points(own=0.03, still=still)):
            assert line.slope_error == pytest.approx(0.03 / spread)


def test_the_error_of_a_step_holds_what_its_points_share() -> None:
    """Compute a step's error by hand.

    Mean over n frequencies: own errors by sqrt(n), those of the runs without excitation in full; two loads.
    """
    for step in steps(points(by_load=1.1, own=0.03, still=0.02)):
        assert step.rise_pct == pytest.approx(10.0)
        expected = math.sqrt(2.0 * (0.03**2 / len(FREQUENCIES) + 0.02**2))
        assert step.error_pct == pytest.approx(110.0 * expected)
        assert step.frequencies_up == step.frequencies == len(FREQUENCIES)


def test_a_rise_within_two_standard_errors_is_missed_and_said() -> None:
    wrong = [bar for bar in bars(points(by_load=1.02, own=0.03, still=0.02)) if bar.startswith("missed: ")]
    assert len(wrong) == len(CRITERIA)
    assert all("2.0 +- 3.5 % to 5 kN (not resolved)" in bar for bar in wrong)


def test_single_points_against_the_load_are_named() -> None:
    found = points()
    i = next(i for i, p in enumerate(found) if (p.variant, p.load_N, p.criterion) == ("B", 10e3, "S"))
    found[i] = found[i].model_copy(update={"acceleration_m_per_s2": 0.8 * (found[i].acceleration_m_per_s2 or 0.0)})
    bar = next(bar for bar in bars(found) if "criterion S: the boundary moves" in bar)
    assert bar.startswith("met: ")
    assert bar.endswith(f"single points fall: B {FREQUENCIES[0]:g} Hz to 10 kN (-4 %)")


def test_where_none_was_found_nothing_is_met() -> None:
    found = [p.model_copy(update={"velocity_m_per_s": None, "acceleration_m_per_s2": None}) for p in points()]
    assert all(bar.startswith("missed: ") for bar in bars(found)[:5])


def test_the_picture_has_a_line_of_constant_acceleration() -> None:
    found = points()
    data = Fig5(
        frequency_range_Hz=(FREQUENCIES[0], FREQUENCIES[-1]),
        resonances=RESONANCES,
        points=found,
        lines=lines(found),
        steps=steps(found),
        variations=[],
        still={},
        apart=[],
        bars=[],
        notes=[],
    )
    panels = fig5_chart(data).panels
    assert len(panels) == 4
    line = panels[0].series[-1]
    assert line.x * line.y == pytest.approx(line.x[0] * line.y[0])
