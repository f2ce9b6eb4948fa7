"""Compare beams with Timoshenko's equations and closed forms."""

from __future__ import annotations

import json
import math
from pathlib import Path

import numpy as np
import pytest
from scipy.linalg import expm
from scipy.optimize import brentq

from lambda_core.domain.errors import CaseError
from lambda_core.formulas.elastic.body import Disc, shaft_body
from lambda_core.formulas.elastic.reduced import FORMAT, read_reduced, write_reduced
from lambda_core.formulas.elastic.sections import BodyMaterial, RoundSection
from lambda_core.formulas.elastic.whirl import craig_bampton, natural_frequencies, whirls

STEEL = BodyMaterial(210e9, 0.3, 7850.0)
LENGTH = 0.4
BARS = [RoundSection(0.04, 0.0, STEEL), RoundSection(0.05, 0.03, STEEL)]


def transfer(section: RoundSection, square: float, length: float) -> np.ndarray:
    """Return the transfer matrix.

    For deflection, lean, moment and shear from one end to the other.

    Timoshenko 1921, Phil. Mag. 41, 744: E I lean'' + kappa G A (w' - lean) + rho I omega^2 lean = 0 and
    kappa G A (w'' - lean') + rho A omega^2 w = 0.
    """
    a, i, rho = section.area, section.second_moment, section.material.density
    slopes = np.zeros((4, 4))
    slopes[0, 1], slopes[0, 3] = 1.0, 1.0 / section.shear_stiffness
    slopes[1, 2] = 1.0 / section.bending_stiffness
    slopes[2, 1], slopes[2, 3] = -rho * i * square, -1.0
    slopes[3, 0] = -rho * a * square
    return np.asarray(expm(slopes * length))


def exact(section: RoundSection, ends: str, count: int) -> list[float]:
    """Return the first roots of the frequency equation [rad/s]."""
    rows, columns = {"pinned": ([0, 2], [1, 3]), "free": ([2, 3], [0, 1])}[ends]

    def closing(omega: float) -> float:
        return float(np.linalg.det(transfer(section, omega**2, LENGTH)[np.ix_(rows, columns)]))

    wave = math.sqrt(section.bending_stiffness / (section.material.density * section.area)) * (math.pi / LENGTH) ** 2
    found: list[float] = []
    grid = wave * np.geomspace(0.5, 30.0, 120)
    values = [closing(omega) for omega in grid]
    for a, b, at_a, at_b in zip(grid[:-1], grid[1:], values[:-1], values[1:], strict=True):
        if at_a * at_b < 0.0 and len(found) < count:
            found.append(float(brentq(closing, a, b)))
    return found


@pytest.mark.parametrize("section", BARS, ids=["solid", "hollow"])
@pytest.mark.parametrize("ends", ["pinned", "free"])
def test_bending_modes_against_the_exact_frequency_equation(section: RoundSection, ends: str) -> None:
    """Compare the first five modes to 0.1 %.

    A bar ten and eight diameters long, elements one diameter long.
    """
    body = shaft_body([(LENGTH, section)])
    last = 6 * (body.positions.size - 1)
    kept = [i for i in range(body.mass.shape[0]) if i % 6 in (1, 5)]  # the horizontal plane alone
    held = sorted(set(range(body.mass.shape[0])) - set(kept))
    if ends == "pinned":
        held += [1, last + 1]
    frequencies, _ = natural_frequencies(body.stiffness, body.mass, held, 8)
    bending = [f for f in frequencies if f > 100.0][:5]
    np.testing.assert_allclose(bending, exact(section, ends, 5), rtol=1e-3)


def test_exact_roots_are_those_of_the_closed_form() -> None:
    """Compare with the closed form of a pinned bar.

    It bends in sines: the smaller root of a quadratic in omega^2 (Timoshenko 1921), for each n.
    """
    section = BARS[0]
    ei, kga = section.bending_stiffness, section.shear_stiffness
    m, j = section.material.density * section.area, section.material.density * section.second_moment
    for n, root in enumerate(exact(section, "pinned", 5), start=1):
        p = n * math.pi / LENGTH
        quadratic = [m * j / kga, -(m + m * p**2 * ei / kga + j * p**2), ei * p**4]
        assert root == pytest.approx(math.sqrt(min(np.roots(quadratic).real)), rel=1e-9)


def test_shear_coefficients_of_cowper() -> None:
    """Compare with Cowper's values for circle and tube.

    Cowper 1966, J. Appl. Mech. 33, 335: circle 6(1+nu)/(7+6 nu), thin tube 2(1+nu)/(4+3 nu), nu = 0.3.
    """
    assert BARS[0].shear_coefficient == pytest.approx(7.8 / 8.8, rel=1e-12)
    assert RoundSection(1.0, 0.9999, STEEL).shear_coefficient == pytest.approx(2.6 / 4.9, rel=1e-6)


def test_tip_of_a_cantilever() -> None:
    """Compare the tip's displacement with closed forms.

    F l^3/(3 E I) + F l/(kappa G A), F l^2/(2 E I); force along y, moment about y, tension, torque (exact).
    """
    section = BARS[1]
    body = shaft_body([(LENGTH, section)], fineness=100.0)
    free, tip = slice(6, None), body.mass.shape[0] - 12
    flexibility = np.linalg.inv(body.stiffness[free, free])[tip:, tip:]
    ei, kga = section.bending_stiffness, section.shear_stiffness
    assert flexibility[1, 1] == pytest.approx(LENGTH**3 / (3.0 * ei) + LENGTH / kga, rel=1e-9)
    assert flexibility[5, 1] == pytest.approx(LENGTH**2 / (2.0 * ei), rel=1e-9)
    assert flexibility[2, 4] == pytest.approx(-(LENGTH**2) / (2.0 * ei), rel=1e-9)
    assert flexibility[0, 0] == pytest.approx(LENGTH / section.axial_stiffness, rel=1e-9)
    assert flexibility[3, 3] == pytest.approx(LENGTH / section.torsional_stiffness, rel=1e-9)


def test_a_stepped_beam_between_supports() -> None:
    """Compare a stepped beam with two cantilevers.

    Two halves of different stiffness, load in the middle: each half is a cantilever of l/2 under F/2 (exact).
    """
    body = shaft_body([(0.5 * LENGTH, BARS[0]), (0.5 * LENGTH, BARS[1])], places=[0.5 * LENGTH])
    # energy: sum of both halves, deflection at the load is twice the energy over the force
    half, force = 0.5 * LENGTH, 1000.0
    energy = sum(
        (0.5 * force) ** 2 * (half**3 / (6.0 * s.bending_stiffness) + half / (2.0 * s.shear_stiffness)) for s in BARS
    )
    last = 6 * (body.positions.size - 1)
    rows = np.setdiff1d(np.arange(body.mass.shape[0]), [0, 1, 2, 3, last + 1, last + 2])
    loads = np.zeros(body.mass.shape[0])
    loads[body.rows(half).start + 1] = force
    moved = np.zeros_like(loads)
    moved[rows] = np.linalg.solve(body.stiffness[np.ix_(rows, rows)], loads[rows])
    assert moved[body.rows(half).start + 1] == pytest.approx(2.0 * energy / force, rel=1e-9)


def test_a_thin_disc_on_a_stiff_overhang_whirls_as_a_gyroscope() -> None:
    """Compare forward and backward whirl with the closed form.

    J_t w^2 - J_p spin w - k = 0; a symmetric rotor free in space under tilting springs; - is forward, + backward.
    """
    section = RoundSection(0.01, 0.0, STEEL)
    body = shaft_body([(0.02, section)], discs=[Disc(0.01, 1.0, 1e-3, 2e-3)], fineness=2.0)
    weight = STEEL.density * section.area * 0.02
    transverse, polar = 1e-3 + weight * (0.005**2 / 4.0 + 0.02**2 / 12.0), 2e-3 + 0.5 * weight * 0.005**2
    stiffness = body.stiffness.copy()
    rows = body.rows(0.01)
    for i, k in zip(range(rows.start, rows.stop), (1e7, 1e7, 1e7, 1e7, 100.0, 100.0), strict=True):
        stiffness[i, i] += k
    spin = 300.0
    found = whirls(stiffness, body.mass, body.gyroscopic, spin, nodes=body.positions.size, count=2)
    root = math.sqrt((polar * spin) ** 2 + 4.0 * transverse * 100.0)
    expected = [(root - polar * spin) / (2.0 * transverse), (root + polar * spin) / (2.0 * transverse)]
    assert [one.frequency for one in found] == pytest.approx(expected, rel=1e-4)
    tilts = [one.shape[[rows.start + 4, rows.start + 5]] for one in found]
    # axis (tilt_z, -tilt_y): against the spin at the lower frequency, with it at the higher one
    assert [math.copysign(1.0, (t[1] * np.conj(-t[0])).imag) for t in tilts] == [-1.0, 1.0]


def test_reduction_keeps_statics_and_the_low_modes() -> None:
    """Compare a Craig-Bampton reduction with the full beam.

    Craig and Bampton 1968: flexibility at the kept nodes exact, first three bending modes to 1e-3.
    """
    body = shaft_body([(LENGTH, BARS[0])], places=[0.1])
    small = craig_bampton(body, [0.0, 0.1, LENGTH], 12)
    assert small.mass.shape == (30, 30)
    assert small.total_mass == pytest.approx(STEEL.density * BARS[0].area * LENGTH, rel=1e-9)
    spring = 1e7
    frequencies = []
    flexibilities = []
    for one in (body, small):
        k = one.stiffness.copy()
        for place in (0.0, LENGTH):
            rows = one.rows(place)
            k[rows, rows] += np.diag([spring] * 3 + [spring * 1e-2] * 3)
        flexibilities.append(np.linalg.inv(k)[one.rows(0.1), one.rows(0.1)])
        frequencies.append(natural_frequencies(k, one.mass, count=7)[0])
    np.testing.assert_allclose(flexibilities[1], flexibilities[0], rtol=1e-6, atol=1e-14)
    np.testing.assert_allclose(frequencies[1], frequencies[0], rtol=1e-3)


def test_a_reduced_body_is_read_as_it_was_written(tmp_path: Path) -> None:
    body = craig_bampton(shaft_body([(LENGTH, BARS[0])], places=[0.1]), [0.0, 0.1, LENGTH], 4)
    write_reduced(body, tmp_path / "housing.json")
    read = read_reduced(tmp_path / "housing.json")
    for name in ("positions", "stiffness", "mass", "gyroscopic"):
        assert np.array_equal(getattr(read, name), getattr(body, name))


@pytest.mark.parametrize(
    ("change", "where", "words"),
    [
        ({"format": "x"}, "format", "must be"),
        ({"nodes": "here"}, "nodes", "list of numbers"),
        ({"mass": [[1.0, 2.0]]}, "mass", "1 by 2"),
        ({"stiffness": (np.diag(np.ones(18)) + np.eye(18, k=1)).tolist()}, "stiffness", "symmetric"),
        ({"mass": (-np.eye(18)).tolist()}, "mass", "negative"),
    ],
)
def test_mistakes_of_a_reduced_body_are_named(
    change: dict[str, object], where: str, words: str, tmp_path: Path
) -> None:
    data = {"format": FORMAT, "nodes": [0.0, 0.1, 0.2], "mass": np.eye(18).tolist(), "stiffness": np.eye(18).tolist()}
    (tmp_path / "body.json").write_text(json.dumps({**data, **change}))
    with pytest.raises(CaseError) as caught:
        read_reduced(tmp_path / "body.json")
    assert any(problem.where == where and words in problem.message for problem in caught.value.problems)
