"""Compare waves and pits of raceways with Wardle and kinematics."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cache

import numpy as np
import pytest
from numpy.typing import NDArray

from lambda_core import api
from lambda_core.elements.ball.geometry import Geometry
from lambda_core.laws.probe import trial_context
from lambda_core.solver.drivers.dynamics import BearingEngine
from lambda_core.testing import evaluate

# What holds for one ring holds for the other by the same formula: the costly ones of the second are run by name.
OUTER_FIRST = pytest.mark.parametrize("ring", ["outer", pytest.param("inner", marks=pytest.mark.slow)])


def one_of_each(few: int, many: int) -> pytest.MarkDecorator:
    """Return each ring and order once.

    The other combinations are run by name.
    """
    twice = [("outer", few), ("inner", many)]
    other = [pytest.param(ring, order, marks=pytest.mark.slow) for ring, order in (("outer", many), ("inner", few))]
    return pytest.mark.parametrize(("ring", "order"), [*twice, *other])


INTERVAL = 1e-4  # [s] of the samples
AMPLITUDE = 0.1e-6  # [m]
STEADY = 0.1  # [s]


@dataclass(frozen=True)
class Vibration:
    """Motion of a vibrating inner ring.

    The 6208 under 700 N of thrust, its start left out.
    """

    times: NDArray[np.float64]
    position: NDArray[np.float64]  # (n, 3) [m]
    tilt: NDArray[np.float64]  # (n, 2) [rad]
    balls: int
    cage: float  # revolutions per second of the balls
    inner: float  # [1/s]
    lever: float  # axial displacement per radial rise of the groove
    residual: float  # of the energy

    def amplitude(self, axis: int, frequency: float) -> float:
        """Return the amplitude of one frequency [m]."""
        return self._amplitude(self.position[:, axis], frequency)

    def rocking(self, frequency: float) -> float:
        """Return the tilt's amplitude [rad].

        At one frequency, about both axes.
        """
        return math.hypot(*(self._amplitude(self.tilt[:, axis], frequency) for axis in (0, 1)))

    def _amplitude(self, values: NDArray[np.float64], frequency: float) -> float:
        """Return the amplitude at one frequency.

        By least squares with a mean and a slope.
        """
        wave = 2.0 * np.pi * frequency * self.times
        basis = np.stack([np.cos(wave), np.sin(wave), np.ones_like(wave), self.times - self.times.mean()], axis=1)
        found = np.linalg.lstsq(basis, values, rcond=None)[0]
        return float(np.hypot(found[0], found[1]))

    def strongest(self, axis: int, above: float = 20.0) -> float:
        """Return the velocity's strongest frequency [Hz]."""
        velocity = np.gradient(self.position[:, axis], INTERVAL)
        spectrum = np.abs(np.fft.rfft(velocity * np.hanning(velocity.size), 8 * velocity.size))
        frequencies = np.fft.rfftfreq(8 * velocity.size, INTERVAL)
        spectrum[frequencies < above] = 0.0
        return float(frequencies[int(np.argmax(spectrum))])


def lever(geometry: Geometry, angle: float) -> float:
    """Return dx/dA of a bearing.

    Under constant thrust; its raceway rises radially by A all around.

    Z Q sin a = F with Q ~ delta^1.5, delta = s - B, B = r_i + r_o - D_w, s the distance of the groove centres: ds = dx
    sin a, da = dx cos a/s, ddelta = ds + A cos a. Then dx = A cos a/[sin a + (2/3)(delta/s) cos^2 a/sin a]. The free
    contact angle gives delta = B (cos a_0/cos a - 1), cos a_0 = 1 - P_d/(2 B) (Harris and Kotzalas 2006, chapter 2, 7).
    """
    b = geometry.groove_radius_inner + geometry.groove_radius_outer - geometry.ball_diameter
    delta = b * ((1.0 - 0.5 * geometry.clearance / b) / np.cos(angle) - 1.0)
    stretch = 2.0 / 3.0 * delta / (b + delta) * np.cos(angle) ** 2 / np.sin(angle)
    return float(np.cos(angle) / (np.sin(angle) + stretch))


@cache
def vibration(ring: str, *choice: str, duration: float = 0.3, tilts: str = "locked") -> Vibration:
    own = [f"forces.ball_{ring}.{item}" for item in choice]
    # Oil below alone would rock the ring: no bath.
    bare = ["gravity.z=0 m/s2", "models.fluid_drag=none"]
    still = [*bare, f"bodies.inner_ring.tilt_y={tilts}", f"bodies.inner_ring.tilt_z={tilts}"]
    model = api.check("6208-axial-700", [*own, *still, f"output.interval={INTERVAL} s"])
    engine = BearingEngine(model)
    done = engine.advance(duration)
    assert done.ok, done.message
    integrals, samples = engine.integrals(), engine.samples()
    lost = sum(value for name, value in integrals.items() if name.startswith(("loss.", "support")))
    keep = samples["time"] > STEADY
    t = samples["time"][keep]

    def turns(angle: NDArray[np.float64]) -> float:
        return float(np.polyfit(t, np.unwrap(angle[keep]), 1)[0] / (2.0 * np.pi))

    orbits = [turns(samples["ball_azimuth"][:, j]) for j in range(model.geometry.ball_count)]
    angle = np.abs(samples["contact_angle"][keep][:, :, 0 if ring == "inner" else 1]).mean()
    return Vibration(
        t,
        samples["body_position"][keep][:, 0],
        samples["body_tilt"][keep][:, 0],
        model.geometry.ball_count,
        float(np.mean(orbits)),
        turns(samples["body_spin_angle"][:, 0]),
        lever(model.geometry, float(angle)),
        (integrals["input"] - lost - integrals["stored"]) / integrals["input_abs"],
    )


def waves(ring: str, order: int) -> Vibration:
    prefix = "parameters.surface"
    return vibration(ring, "models.surface=waviness", f"{prefix}.waves={order}", f"{prefix}.amplitude={AMPLITUDE} m")


@pytest.mark.parametrize("ring", ["inner", "outer"])
def test_waves_as_many_as_balls_move_the_ring_along_its_axis(ring: str) -> None:
    """Find axial motion from as many waves.

    Wardle 1988, k = Z, at Z f_c and Z (f_i - f_c): every ball rises alike, at constant thrust, which gives the
    amplitude.

    Tolerance 3 %: 167 and 246 Hz are slow against the axial resonance at some 1.5 kHz (2 % of magnification), inner and
    outer contact angles differ by 0.1 degrees.
    """
    found = waves(ring, 9)
    frequency = found.balls * (found.cage if ring == "outer" else found.inner - found.cage)
    assert found.amplitude(0, frequency) == pytest.approx(AMPLITUDE * found.lever, rel=0.03)
    assert found.strongest(0) == pytest.approx(frequency, abs=1.0)
    for axis in (1, 2):
        assert found.amplitude(axis, frequency) < 0.02 * AMPLITUDE


@one_of_each(8, 10)
def test_one_wave_more_or_less_moves_the_ring_across_its_axis(ring: str, order: int) -> None:
    """Find radial motion of k = Z +- 1.

    Wardle 1988: at Z f_c and at Z (f_i - f_c) +- f_i, and by A: a displaced circle has one wave.

    Tolerance 5 %: slow against the radial resonance at some 1 kHz, as above.
    """
    found = waves(ring, order)
    passing = found.balls * (found.cage if ring == "outer" else found.inner - found.cage)
    frequency = passing if ring == "outer" else passing + (order - found.balls) * found.inner
    for axis in (1, 2):
        assert found.amplitude(axis, frequency) == pytest.approx(AMPLITUDE, rel=0.05)
    assert found.amplitude(0, frequency) < 0.02 * AMPLITUDE


@pytest.mark.full
@one_of_each(7, 12)
def test_other_orders_move_nothing(ring: str, order: int) -> None:
    """Find less than 5 % from other orders.

    Forces of the balls cancel; the limit refers to the amplitude (rms).
    """
    found = waves(ring, order)
    rms = np.std(found.position - np.polyval(np.polyfit(found.times, found.position, 1), found.times[:, None]), axis=0)
    assert rms.max() < 0.05 * AMPLITUDE


RICH = "[" + ", ".join(f'{{ waves = {k}, amplitude = "{AMPLITUDE} m" }}' for k in (7, 10, 12)) + "]"


@pytest.mark.full
@pytest.mark.parametrize("ring", ["inner", "outer"])
def test_harmonics_act_side_by_side(ring: str) -> None:
    """Add up orders 7, 9, 10 and 12.

    Wardle 1988: small waves in a bearing under thrust do not disturb each other.

    Orders 7, 9, 10 and 12 of one ring at once: 9 = Z moves it along its axis, 10 = Z + 1 across it, 7 and 12 nothing.
    """
    found = vibration(
        ring, "models.surface=waviness", "parameters.surface.waves=9", f"parameters.surface.amplitude={AMPLITUDE} m",
        f"parameters.surface.harmonics={RICH}",
    )  # fmt: skip
    passing = found.balls * (found.cage if ring == "outer" else found.inner - found.cage)
    across = passing if ring == "outer" else passing + found.inner
    assert found.amplitude(0, passing) == pytest.approx(AMPLITUDE * found.lever, rel=0.03)
    for axis in (1, 2):
        assert found.amplitude(axis, across) == pytest.approx(AMPLITUDE, rel=0.05)
    if ring == "inner":  # its lines lie apart: none at those that orders 7 and 12 have on each ball
        for order in (7, 12):
            assert found.amplitude(0, order * (found.inner - found.cage)) < 0.05 * AMPLITUDE * found.lever
    assert abs(found.residual) < 1e-3


@OUTER_FIRST
def test_twice_as_many_waves_as_balls_move_the_ring_at_twice_the_frequency(ring: str) -> None:
    """Find k = i Z at i Z f_c.

    Wardle 1988: here i = 2, and i Z (f_i - f_c) of the other ring.
    """
    found = waves(ring, 18)
    frequency = 2.0 * found.balls * (found.cage if ring == "outer" else found.inner - found.cage)
    assert found.strongest(0) == pytest.approx(frequency, abs=2.0)
    assert found.amplitude(0, frequency) > 0.9 * AMPLITUDE * found.lever
    assert max(found.amplitude(axis, frequency) for axis in (1, 2)) < 0.02 * AMPLITUDE


@pytest.mark.full
@OUTER_FIRST
def test_axial_waves_move_a_ring_along_its_axis_or_rock_it(ring: str) -> None:
    """Find axial motion and rocking from axial waves.

    Wardle 1988: k = i Z moves a ring along its axis, by A; k = i Z +- 1 rocks it: a tilted circle has one.

    The tilt of a circle that the balls follow is A over the pitch radius of 30 mm: within 12 % where the outer ring's
    waves pass, at 167 Hz, slow against the rocking resonance; the inner ring's at 292 Hz are not.
    """

    def moved(order: int) -> Vibration:
        choice = (f"waves={order}", "axial_share=1", f"amplitude={AMPLITUDE} m")
        options = (f"parameters.surface.{option}" for option in choice)
        return vibration(ring, "models.surface=waviness", *options, tilts="free")

    along, across = moved(9), moved(10)
    passing = along.balls * (along.cage if ring == "outer" else along.inner - along.cage)
    rocking = across.rocking(passing if ring == "outer" else passing + along.inner)
    assert along.amplitude(0, passing) == pytest.approx(AMPLITUDE, rel=0.06)
    assert rocking > 50.0 * along.rocking(passing)
    assert across.amplitude(0, passing) < 0.02 * AMPLITUDE
    if ring == "outer":
        assert rocking == pytest.approx(AMPLITUDE / 0.03, rel=0.12)


@pytest.mark.parametrize("ring", ["inner", "outer"])
def test_work_of_the_waves_comes_from_the_drive(ring: str) -> None:
    assert abs(waves(ring, 9).residual) < 1e-3


@pytest.mark.full
@OUTER_FIRST
def test_a_defect_is_struck_at_the_ball_pass_frequency(ring: str) -> None:
    """Find all lines at BPFO and BPFI.

    Z f_c and Z (f_i - f_c) (Harris and Kotzalas 2006, section 8.3), of the axial vibration.
    """
    found = vibration(
        ring, "models.surface=defect", "parameters.surface.width=0.6 mm", "parameters.surface.azimuth=30 deg",
        duration=0.2,
    )  # fmt: skip
    passing = found.balls * (found.cage if ring == "outer" else found.inner - found.cage)
    harmonic = found.strongest(0) / passing
    assert harmonic == pytest.approx(round(harmonic), abs=5e-3)  # a sixth of a line of the spectrum
    at = [found.amplitude(0, i * passing) for i in range(1, 7)]
    neighbour = [found.amplitude(0, (i + 0.5) * passing) for i in range(1, 7)]
    assert min(at) > 10.0 * max(neighbour)
    assert abs(found.residual) < 1e-3


def test_a_ball_drops_into_a_gap_as_far_as_a_circle_on_two_edges() -> None:
    """Compare the drop with R - sqrt(R^2 - b^2/4).

    In the middle, R the reduced radius; parabola for circle 3e-3, without rounding.
    """
    context = trial_context("ball_outer")
    radius = context.radius_x
    exact = radius - math.sqrt(radius * radius - 0.5e-3**2)
    options = {"width": "1 mm", "depth": "1 mm", "azimuth": "0 deg", "rounding": 1e-4}
    out = evaluate("surface/defect", options, context, azimuth=0.0, contact_angle=0.0)
    assert -out[0] == pytest.approx(exact, rel=3e-3)
    edge = 0.5e-3 / (0.5 * context.race_diameter)
    for share, left in ((0.5, 0.25), (0.8, 0.04)):
        out = evaluate("surface/defect", options, context, azimuth=share * edge, contact_angle=0.0)
        assert -out[0] == pytest.approx(exact * left, rel=3e-3)
    assert evaluate("surface/defect", options, context, azimuth=1.01 * edge, contact_angle=0.0)[0] == 0.0


def test_a_shallow_gap_has_a_floor() -> None:
    options = {"width": "4 mm", "depth": "5 um", "azimuth": "180 deg", "extent": "2 mm", "contact_angle": "5 deg"}
    middle = evaluate("surface/defect", options, azimuth=-np.pi, contact_angle=np.radians(5.0))
    assert middle[0] == pytest.approx(-5e-6, rel=1e-12)
    assert middle[1:3] == pytest.approx([0.0, 0.0], abs=1e-12)
    groove = trial_context("ball_inner").groove_radius
    beyond = evaluate("surface/defect", options, azimuth=np.pi, contact_angle=np.radians(5.0) + 1.001e-3 / groove)
    assert beyond[0] == 0.0


def test_harmonics_add_up() -> None:
    """Add up amplitudes, phases and directions.

    A crest on a trough is nothing.
    """
    alone = [
        {"waves": 9, "amplitude": "1 um", "phase": "10 deg"},
        {"waves": 17, "amplitude": "0.3 um", "phase": "40 deg", "axial_share": -1.0},
        {"waves": 4, "amplitude": "2 um"},
    ]
    place = {"azimuth": 0.7, "contact_angle": 0.25}
    single = sum(evaluate("surface/waviness", wave, **place) for wave in alone)
    assert evaluate("surface/waviness", {**alone[0], "harmonics": alone[1:]}, **place) == pytest.approx(single)
    by_hand = 1e-6 * math.cos(0.25) * math.cos(9 * (0.7 - math.radians(10)))
    assert evaluate("surface/waviness", alone[0], **place)[0] == pytest.approx(by_hand)
    opposite = {"waves": 9, "amplitude": "1 um", "phase": "30 deg"}  # half a wave of 40 degrees further
    assert evaluate("surface/waviness", {**alone[0], "harmonics": [opposite]}, **place) == pytest.approx(0.0, abs=1e-17)


@pytest.mark.parametrize(
    ("law", "options"),
    [
        ("surface/waviness", {"waves": 23, "axial_share": -0.4, "phase": "20 deg"}),
        (
            "surface/waviness",
            {"harmonics": [{"waves": 3, "amplitude": "2 um"}, {"waves": 31, "amplitude": "50 nm", "axial_share": 0.7}]},
        ),
        ("surface/defect", {"width": "3 mm", "extent": "4 mm", "azimuth": "0 deg"}),
    ],
)
def test_slopes_are_the_derivatives_of_the_height(law: str, options: dict[str, object]) -> None:
    """Compare slopes with differences of fourth order.

    Correct slopes make the contact conserve energy.
    """
    rng, h = np.random.default_rng(3), 1e-4
    for azimuth, angle in zip(rng.uniform(-0.04, 0.04, 40), rng.uniform(-0.3, 0.3, 40), strict=True):
        found = evaluate(law, options, azimuth=azimuth, contact_angle=angle)

        def height(a: float, b: float) -> float:
            return float(evaluate(law, options, azimuth=a, contact_angle=b)[0])

        for i, (da, db) in enumerate(((h, 0.0), (0.0, h))):
            slope = 8.0 * (height(azimuth + da, angle + db) - height(azimuth - da, angle - db))
            slope -= height(azimuth + 2 * da, angle + 2 * db) - height(azimuth - 2 * da, angle - 2 * db)
            assert found[1 + i] == pytest.approx(slope / (12.0 * h), rel=1e-3, abs=2e-7)
