"""Test the network against closed forms."""

from __future__ import annotations

import math
from types import SimpleNamespace

import numpy as np
import pytest

from lambda_core.analysis.thermal.losses import Point
from lambda_core.analysis.thermal.network import Network
from lambda_core.analysis.thermal.transient import rise_time, warm_up
from lambda_core.domain.channels import LOSSES

G = (3.0, 0.7, 12.0, 1.9)  # of a chain of four nodes and the surroundings [W/K]
HEAT = (11.0, 0.0, 4.0, 2.5)  # [W]
AMBIENT = 293.15


def chain(heat: tuple[float, ...] = HEAT, conductance: tuple[float, ...] = G) -> Network:
    """Return four nodes in a row.

    The last one is joined to the surroundings.
    """
    matrix = np.zeros((5, 5))
    for i, value in enumerate(conductance):
        matrix[i, i + 1] = matrix[i + 1, i] = value
    return Network(("a", "b", "c", "d", "air"), matrix, np.array([*heat, 0.0]), np.array([np.nan] * 4 + [AMBIENT]))


def test_four_nodes_in_a_chain_have_their_closed_form() -> None:
    # Each link carries everything that was put in before it: T_k = T_a + sum_{i >= k} (q_0 + .. + q_i)/G_i.
    carried = np.cumsum(HEAT)
    expected = [AMBIENT + sum(carried[i] / G[i] for i in range(k, 4)) for k in range(4)]
    found = chain().steady()
    assert found[:4] == pytest.approx(expected, rel=1e-9, abs=1e-9)
    assert found[4] == AMBIENT


def test_heat_put_in_is_heat_that_leaves() -> None:
    network = chain()
    temperatures = network.steady()
    assert network.leaving(temperatures) == pytest.approx(sum(HEAT), rel=1e-12)
    assert network.storing(temperatures)[:4] == pytest.approx(0.0, abs=1e-11)
    flows = network.flows(temperatures)
    assert flows == pytest.approx(-flows.T)
    assert flows[0, 1] == pytest.approx(HEAT[0])


def test_a_node_that_nothing_is_joined_to_has_no_temperature() -> None:
    matrix = np.array([[0.0, 2.0, 0.0], [2.0, 0.0, 0.0], [0.0, 0.0, 0.0]])
    network = Network(("a", "air", "alone"), matrix, np.array([4.0, 0.0, 0.0]), np.array([np.nan, 300.0, np.nan]))
    found = network.steady()
    assert found[0] == pytest.approx(302.0)
    assert math.isnan(found[2])


def test_a_network_without_a_way_out_is_singular() -> None:
    network = Network(
        ("a", "b", "air"),
        np.array([[0.0, 1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 0.0]]),
        np.array([1.0, 0.0, 0.0]),
        np.array([np.nan, np.nan, 300.0]),
    )
    with pytest.raises(np.linalg.LinAlgError):
        network.steady()


class _Constant:
    """Chain with constant heat.

    It takes the place of a bearing.
    """

    def __init__(self, network: Network, capacity: float) -> None:
        self.names, self.held, self._network, self._capacity = network.names, network.held, network, capacity

    def start(self) -> np.ndarray:
        return np.full(5, AMBIENT)

    def capacities(self, points: tuple[Point, ...]) -> np.ndarray:
        return np.where(np.isnan(self.held), self._capacity, np.inf)

    def network(self, points: tuple[Point, ...], temperatures: np.ndarray) -> Network:
        return self._network


def constant_loop(network: Network, capacity: float) -> SimpleNamespace:
    values = np.ones(len(LOSSES) + 9)
    return SimpleNamespace(
        nodes=_Constant(network, capacity),
        solved=lambda seen: (Point(*seen.tolist(), values),),
        count=1,
        thermal=SimpleNamespace(limit=1e4),
        seen=lambda temperatures: np.array([AMBIENT, 0.0]),
        name="chain",
    )


def test_a_chain_over_time_has_its_closed_form() -> None:
    # Equal capacities C and conductances G, the far end free: modes cos((k + 1/2) theta_m), theta_m = (2m - 1) pi/9,
    # with the rates 4 (G/C) sin^2(theta_m/2) (eigenvalues of a chain that is free at one end and held at the other).
    g, c, heat, end = 2.0, 500.0, (10.0, 0.0, 0.0, 0.0), 900.0
    network = chain(heat, (g,) * 4)
    course = warm_up(constant_loop(network, c), end)  # type: ignore[arg-type]
    steady = network.steady()[:4]
    theta = (2.0 * np.arange(1, 5) - 1.0) * math.pi / 9.0
    modes = np.cos(np.outer(np.arange(4) + 0.5, theta))
    weight = np.linalg.solve(modes, AMBIENT - steady)
    for time, temperatures in zip(course.time, course.temperatures, strict=True):
        decay = np.exp(-4.0 * g / c * np.sin(0.5 * theta) ** 2 * time)
        assert temperatures[:4] == pytest.approx(steady + modes @ (weight * decay), abs=5e-3)  # 10 x the integrator's
    assert abs(course.residual) < 1e-9
    assert course.put_in == pytest.approx(10.0 * end, rel=1e-9)
    assert course.time[-1] == end


def test_one_node_has_risen_by_63_percent_after_its_time_constant() -> None:
    network = chain((5.0, 0.0, 0.0, 0.0), (1e6, 1e6, 1e6, 2.0))  # four nodes that are one
    course = warm_up(constant_loop(network, 100.0), 4000.0)  # type: ignore[arg-type]
    share = 1.0 - math.exp(-1.0)
    assert rise_time(course, 0, share) == pytest.approx(400.0 / 2.0, rel=5e-3)  # straight lines between moments
    assert math.isnan(rise_time(course, 4, share))
