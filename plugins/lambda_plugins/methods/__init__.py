"""Provide the built-in comparison methods."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from lambda_core.plugins import Method


def register_methods(register: Callable[[Method], None]) -> None:
    """Register every built-in method: call it from the hook ``lambda_methods``."""
    from dataclasses import replace

    from lambda_plugins.methods import rollers, skf_rollers
    from lambda_plugins.methods.capacitance import ANALYTICAL_CAPACITANCE
    from lambda_plugins.methods.kinematic import KINEMATIC
    from lambda_plugins.methods.quasistatic import QUASI_STATIC
    from lambda_plugins.methods.rating_life import ISO_281, ISO_TS_16281
    from lambda_plugins.methods.schaeffler import SCHAEFFLER
    from lambda_plugins.methods.skf import SKF

    for method, of_rollers in (
        (QUASI_STATIC, rollers.evaluate_quasistatic),
        (SKF, skf_rollers.evaluate_rollers),
        (SCHAEFFLER, rollers.evaluate_schaeffler),
        (rollers.HOUPERT, rollers.evaluate_houpert),
        (ANALYTICAL_CAPACITANCE, None),
        (ISO_281, rollers.evaluate_iso281),
        (ISO_TS_16281, rollers.evaluate_iso16281),
        (KINEMATIC, rollers.evaluate_kinematics),
    ):
        register(replace(method, evaluate_rollers=of_rollers))
