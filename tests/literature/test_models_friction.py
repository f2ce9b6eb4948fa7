"""Test laws of friction against the literature."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest

from lambda_core.testing import evaluate

from .oils import FVA3
from .published import Published
from .statics import B6208, B6319, STEEL

T_BATH = 62.5 + 273.15  # where the printed SKF row of Syla et al. 2026, Table 4, agrees with the FVA3 curve
CLEARANCE = 30e-6


def oil() -> dict[str, float]:
    """Return FVA3's data at bath temperature.

    Ambient viscosity, alpha_p and beta from the law itself.
    """

    def ln_eta(p: float, T: float) -> float:
        return float(evaluate("rheology/vogel-dicke", FVA3, p=p, T=T)[0][0])

    return {
        "eta0": math.exp(ln_eta(0.0, T_BATH)),
        "alpha_p": (ln_eta(1e5, T_BATH) - ln_eta(0.0, T_BATH)) / 1e5,
        "beta": (ln_eta(0.0, T_BATH - 0.1) - ln_eta(0.0, T_BATH + 0.1)) / 0.2,
        "k_oil": 0.134,
    }


def rolling_torque(name: str, force: float, rpm: float) -> float:
    """Return the 6319's rolling torque [N mm].

    Power 2 F u_m per contact over the speed, mean over the balls' position.
    """
    speed = rpm * math.pi / 30.0
    u_mean = B6319.mean_velocity(speed)
    sums = []
    for turn in B6319.positions():
        forces = [
            evaluate(
                f"rolling_resistance/{name}",
                u_mean=u_mean,
                load=each.contact.load,
                semi_a=each.contact.semi_a,
                semi_b=each.contact.semi_b,
                R_x=each.R_x,
                R_y=each.R_y,
                E_eff=STEEL,
                **oil(),
            )[0]
            for each in B6319.contacts(force, CLEARANCE, turn)
        ]
        sums.append(2.0 * sum(forces) * u_mean / speed)
    return 1e3 * float(np.mean(sums))


BY_HAND = "quasi-static estimate by hand for the 6319 at 62.5 degC, FVA3, clearance 30 um"
ROLLING = [
    ("goksem-hargreaves", 16.0e3, (212.0, 403.0, 537.0)),
    ("biboulet-houpert", 16.0e3, (248.0, 519.0, 733.0)),
    ("goksem-hargreaves", 24.6e3, (253.0, 481.0, 640.0)),
    ("biboulet-houpert", 24.6e3, (294.0, 614.0, 866.0)),
]


@pytest.mark.parametrize(("name", "force", "torques"), ROLLING)
def test_rolling_torque_of_the_6319(name: str, force: float, torques: tuple[float, ...]) -> None:
    for rpm, torque in zip((500.0, 1500.0, 3000.0), torques, strict=True):
        expected = Published(torque, BY_HAND, "the sum depends on the balls' position by 8 %", rel=0.04)
        expected.check(rolling_torque(name, force, rpm))


def contact_6208(**change: float) -> dict[str, Any]:
    R_x, R_y = B6208.radii(True)
    given = {"load": 600.0, "semi_a": 1.27e-3, "semi_b": 1.36e-4, "R_x": R_x, "R_y": R_y, "E_eff": STEEL}
    running = {"u_mean": 4.15, "eta0": 0.0976, "alpha_p": 20.4e-9, "beta": 0.0, "k_oil": 0.137}
    return given | running | change


def test_two_laws_of_rolling_resistance_differ_by_a_known_amount() -> None:
    """Compare two laws of rolling resistance.

    Biboulet-Houpert lies 0..56 % above Goksem-Hargreaves over speeds and loads of bearings: a model uncertainty.
    """
    excess = []
    for u in (0.5, 2.0, 8.0, 20.0):
        for eta in (0.01, 0.03, 0.1):
            given = contact_6208(u_mean=u, eta0=eta)
            new, old = (
                evaluate(f"rolling_resistance/{n}", **given)[0] for n in ("biboulet-houpert", "goksem-hargreaves")
            )
            excess.append(new / old - 1.0)
    assert min(excess) > -0.02
    assert 0.40 < max(excess) < 0.75


def test_strips_agree_with_the_point_contact_formula() -> None:
    """Compare strips with Houpert's formula of points.

    7.5826 E' R_x^2 (R_y/R_x)^0.4055 W^(1/3) U^0.75 (common form); two routes, 20 %.
    """
    given = contact_6208()
    U = given["eta0"] * given["u_mean"] / (STEEL * given["R_x"])
    W = given["load"] / (STEEL * given["R_x"] ** 2)
    ratio = given["R_y"] / given["R_x"]
    point = 7.5826 * STEEL * given["R_x"] ** 2 * ratio**0.4055 * W ** (1.0 / 3.0) * U**0.75
    strips = evaluate("rolling_resistance/biboulet-houpert", **given)[0]
    Published(point, "Houpert's point-contact formula", "fit of another route, original not seen", rel=0.2).check(
        strips
    )


def inlet_integral(U: float, W: float, G: float) -> float:
    """Return Grubin's inlet integral.

    1/2 int (h - h_c) dp over the inlet of a line contact, over R_x/alpha_p.

    Hertz's gap outside the contact (half-width b) over the film h_c, Reynolds' equation for the reduced pressure
    q = (1 - exp(-alpha p))/alpha; h_c such that q reaches 1/alpha at the edge (Grubin 1949).
    """
    from scipy.integrate import cumulative_trapezoid
    from scipy.optimize import brentq

    b = math.sqrt(8.0 * W / math.pi)  # over R_x
    X = 1.0 + np.geomspace(1e-6, 60.0, 40_000)
    shape = X * np.sqrt(X * X - 1.0) - np.log(X + np.sqrt(X * X - 1.0))
    gap = 0.5 * b * b * shape  # over R_x

    def reduced(film: float) -> np.ndarray[Any, np.dtype[np.float64]]:
        """Return alpha q along the inlet.

        From far ahead to the edge; dq/dx = 12 eta u (h - h_c)/h^3.
        """
        h = film + gap
        slope = 12.0 * U * G * b * gap / h**3
        return np.asarray(-cumulative_trapezoid(slope[::-1], X[::-1], initial=0.0))

    film = float(brentq(lambda h: reduced(h)[-1] - 1.0, 1e-8, 1e-2))
    q = np.minimum(reduced(film), 1.0 - 1e-12)
    p = -np.log1p(-q)  # alpha p
    return 0.5 * float(np.trapezoid(gap[::-1], p))


@pytest.mark.parametrize("G_U", [1e-7, 1e-6, 1e-5])
def test_goksem_hargreaves_is_the_inlet_integral(G_U: float) -> None:
    """Compare with Grubin's inlet integral, solved here.

    F/l = 1/2 int (h - h_c) dp; 25 % for a fit to full solutions.
    """
    W, G = 1e-4, 4700.0
    U = G_U / G
    fitted = 4.318 * G_U**0.658 * W**0.0126
    Published(fitted, "Goksem and Hargreaves 1978", "Grubin's inlet against the fit", rel=0.25).check(
        inlet_integral(U, W, G)
    )


HYSTERESIS = [
    ("loss-factor", 16.0e3, 74.0),
    ("loss-factor", 24.6e3, 131.0),
    ("houpert", 16.0e3, 285.0),
    ("houpert", 24.6e3, 506.0),
]


@pytest.mark.parametrize(("name", "force", "torque"), HYSTERESIS)
def test_hysteresis_torque_of_the_6319(name: str, force: float, torque: float) -> None:
    """Compare hysteresis torque of the 6319.

    Power M u_m/R_x per contact over the speed [N mm], alpha_h = 0.01.
    """
    u_over_speed = B6319.mean_velocity(1.0)
    sums = []
    for turn in B6319.positions():
        total = 0.0
        for each in B6319.contacts(force, CLEARANCE, turn):
            solid = {"semi_a": each.contact.semi_a, "semi_b": each.contact.semi_b, "R_x": each.R_x, "R_y": each.R_y}
            constants = {"loss_factor": 0.01} if name == "loss-factor" else {}
            moment = evaluate(f"elastic_hysteresis/{name}", constants, load=each.contact.load, R_ball=15e-3, **solid)[0]
            total += moment * u_over_speed / each.R_x
        sums.append(1e3 * total)
    Published(torque, BY_HAND, "load distribution and rounding", rel=0.015).check(float(np.mean(sums)))


def test_loss_factor_is_the_work_on_the_front_half_of_the_contact() -> None:
    """Compare with Johnson 1985, section 9.2.

    M = alpha_h int p x dA over the front half = alpha_h (3/16) Q b, by quadrature.
    """
    x = (np.arange(2000) + 0.5) / 2000
    y = (np.arange(4000) + 0.5) / 2000 - 1.0
    X, Y = np.meshgrid(x, y)
    pressure = np.sqrt(np.maximum(1.0 - X**2 - Y**2, 0.0))
    share = float((pressure * X).sum() / (2.0 * pressure.sum()))
    Q, b = 700.0, 1.4e-4
    solid = {"semi_a": 1.2e-3, "semi_b": b, "R_x": 5e-3, "R_y": 0.15, "R_ball": 6e-3}
    found = evaluate("elastic_hysteresis/loss-factor", {"loss_factor": 0.02}, load=Q, **solid)[0]
    assert found == pytest.approx(0.02 * share * Q * b, rel=1e-3)


def test_houpert_corresponds_to_published_loss_factors() -> None:
    """Compare Houpert with published loss factors.

    6319 at C/P = 10, most loaded ball: alpha_h 0.047 on the inner and 0.033 on the outer ring; 8 %.
    """
    contacts = B6319.contacts(16.0e3, CLEARANCE, 0.0)
    for each, expected in zip(contacts[:2], (0.047, 0.033), strict=True):
        solid = {"semi_a": each.contact.semi_a, "semi_b": each.contact.semi_b, "R_x": each.R_x, "R_y": each.R_y}
        moment = evaluate("elastic_hysteresis/houpert", load=each.contact.load, R_ball=15e-3, **solid)[0]
        alpha = moment / (3.0 / 16.0 * each.contact.load * each.contact.semi_b)
        Published(expected, "Houpert 2002 over the classical couple", "varies with the load", rel=0.08).check(alpha)


def test_load_share_of_the_sister_model() -> None:
    """Compare load shares with Wingertszahn et al. 2023.

    B 2.32, C 0.97 (sigma 0.16 um) and B 2.1, C 0.85 (0.10 um) at Lambda = 1.
    """
    label = "asperity_load/zhou-hoeprich"
    assert evaluate(label, Lambda=1.0)[0] == pytest.approx(0.09827, rel=1e-3)
    assert evaluate(label, {"B": 2.1, "C": 0.85}, Lambda=1.0)[0] == pytest.approx(0.12246, rel=1e-3)


def test_mean_shear_stress_of_a_typical_traction_curve() -> None:
    """Compare with Johnson and Tevaarwerk 1977.

    The Eyring branch grows by tau_e ln 10 per decade of the rate of shear.
    """
    slip = np.array([0.01, 0.1])
    tau = evaluate("traction/ree-eyring", {"limit_ratio": 0.3}, slip=slip, p=1e9, T=330.0, ln_eta=math.log(1e6), h=5e-7)
    assert np.diff(tau)[0] == pytest.approx(8e6 * math.log(10.0), rel=1e-3)


def test_flash_temperature_of_a_band_source() -> None:
    """Compare with Jaeger's kernel K_0 (1942).

    Surface of a half-space under a moving band; up to 7 % low.
    """
    from scipy.integrate import quad
    from scipy.special import k0e

    from lambda_core.laws.probe import trial_context

    context = trial_context("ball_inner")
    steel = context.ball
    kappa = steel.thermal_conductivity / (steel.density * steel.specific_heat)
    b, h = 2e-4, 1e-12
    for peclet in (0.3, 1.0, 5.0, 100.0):
        u = 2.0 * kappa * peclet / b

        def rise(x: float, peclet: float = peclet) -> float:
            # T = q b/(pi k) int exp(-Pe (x - s)) K_0(Pe |x - s|) ds over the band -1..1, x and s over b
            def integrand(s: float) -> float:
                z = peclet * (x - s)
                return float(math.exp(-z - abs(z)) * k0e(abs(z)))

            return quad(integrand, -1.0, x, limit=200)[0] + quad(integrand, x, 1.0, limit=200)[0]

        mean = float(np.mean([rise(x) for x in np.linspace(-0.975, 0.975, 40)]))
        exact = 0.5 * b / (math.pi * steel.thermal_conductivity) * mean  # half of the heat into each body
        T = evaluate("contact_temperature/shear-heating", T_in=300.0, u_mean=u, h=h, semi_b=b, tau=1e6, slip=1.0)
        Published(exact, "Jaeger 1942, exact", "form for high Peclet numbers", rel=0.075).check((T[0] - 300.0) / 1e6)
