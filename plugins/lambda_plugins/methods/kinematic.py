"""Compute kinematic speeds and frequencies for pure rolling."""

from __future__ import annotations

import math

from lambda_core.formulas.kinematics import ball_speed, cage_speed, diameter_ratio, frequency_orders
from lambda_core.plugins import Method, MethodInputs, MethodRow, MethodTable


def _mean_angle(inputs: MethodInputs) -> float:
    """Return the mean contact angle of loaded balls [rad].

    The load weights it; it is 0 without an equilibrium.
    """
    if inputs.state is None:
        return 0.0
    total = sum(contact.load_inner + contact.load_outer for contact in inputs.state.contacts)
    if total == 0.0:
        return 0.0
    weighted = sum(
        contact.load_inner * contact.angle_inner + contact.load_outer * contact.angle_outer
        for contact in inputs.state.contacts
    )
    return weighted / total


def evaluate(inputs: MethodInputs) -> MethodTable:
    """Compute cage and ball speeds and characteristic frequencies.

    The frequencies are FTF, BPFO, BPFI and BSF.
    """
    angle = _mean_angle(inputs)
    gamma = diameter_ratio(inputs.ball_diameter, inputs.pitch_diameter, angle)
    orders = frequency_orders(inputs.ball_count, inputs.ball_diameter, inputs.pitch_diameter, angle)
    cage = cage_speed(inputs.inner_speed, inputs.outer_speed, gamma)
    ball = ball_speed(inputs.inner_speed, inputs.outer_speed, inputs.ball_diameter, inputs.pitch_diameter, angle)
    to_rpm = 30.0 / math.pi
    rows = [
        MethodRow("kinematics", "cage speed", cage * to_rpm, "rpm", "epicyclic"),
        MethodRow("kinematics", "ball speed", ball * to_rpm, "rpm", "about its own axis, relative to the cage"),
    ]
    hertz = inputs.relative_speed / (2.0 * math.pi)
    for name, order, meaning in (
        ("FTF", orders.cage, "cage relative to the outer ring"),
        ("BPFO", orders.outer_pass, "balls over a spot of the outer ring"),
        ("BPFI", orders.inner_pass, "balls over a spot of the inner ring"),
        ("BSF", orders.ball_spin, "turns of a ball relative to the cage"),
        ("2 BSF", orders.ball_defect, "a spot of a ball over both raceways"),
    ):
        rows.append(MethodRow("kinematics", f"{name} order", order, "1/rev", meaning))
        rows.append(MethodRow("kinematics", name, order * hertz, "Hz", meaning))
    return MethodTable(
        tuple(rows), (f"mean contact angle {math.degrees(angle):.2f} deg, weighted by load", "pure rolling")
    )


KINEMATIC = Method(
    name="kinematic",
    title="Epicyclic speeds and characteristic frequencies",
    reference="Harris and Kotzalas, Rolling Bearing Analysis, 5th ed., vol. 1, ch. 10",
    evaluate=evaluate,
    validity="pure rolling, equal contact angles at both raceways",
    method_api=1,
)
