"""Test benchmarks that draw operating points.

The points are drawn alike every time, and verdicts follow their bars.
"""

from __future__ import annotations

from benchmarks.false_convergence import Pair
from benchmarks.static_points import points


def test_points_cover_kinds_speeds_and_loads() -> None:
    drawn = list(points(300))
    assert drawn == list(points(300))
    assert {"deep groove", "angular contact", "self-aligning"} <= {point.kind for point in drawn}
    speeds = [float(point.changes[0].split("=")[1].split()[0]) for point in drawn]
    assert min(speeds) < 5.0
    assert max(speeds) > 10_000.0
    assert {point.changes[1] == "loads.radial=0 N" for point in drawn} >= {False}
    assert any(point.changes[2] == "loads.axial=0 N" for point in drawn)


def test_points_of_rollers_carry_the_thrust_that_their_kind_takes() -> None:
    drawn = list(points(200, rollers=True))
    assert {"NU", "N", "NJ", "NUP", "NCF", "needle", "tapered"} <= {point.kind for point in drawn}
    axial = {
        kind: [float(p.changes[2].split("=")[1].split()[0]) for p in drawn if p.kind == kind]
        for kind in ("NU", "tapered")
    }
    assert not any(axial["NU"])
    assert all(axial["tapered"])


def test_a_pair_is_judged_by_half_width_and_share() -> None:
    assert Pair(100.0, 100.5, 1.0).agrees
    assert Pair(100.0, 100.05, 0.0).agrees
    far = Pair(100.0, 104.0, 1.0)
    assert (far.agrees, far.is_false) == (False, True)
    assert not Pair(100.0, 104.0, 1.0, ("the tolerance is coarse",)).is_false
    assert not Pair(100.0, 100.9, 0.1).is_false
