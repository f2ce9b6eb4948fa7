"""Built-in comparison methods: catalogue friction, analytical capacitance, rating life, kinematics."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from lambda_core.plugins import Method


def register_methods(register: Callable[[Method], None]) -> None:
    """Register every built-in method: call it from the hook ``lambda_methods``."""
    from lambda_plugins.methods.capacitance import ANALYTICAL_CAPACITANCE
    from lambda_plugins.methods.kinematic import KINEMATIC
    from lambda_plugins.methods.quasistatic import QUASI_STATIC
    from lambda_plugins.methods.rating_life import ISO_281, ISO_TS_16281
    from lambda_plugins.methods.schaeffler import SCHAEFFLER
    from lambda_plugins.methods.skf import SKF

    for method in (QUASI_STATIC, SKF, SCHAEFFLER, ANALYTICAL_CAPACITANCE, ISO_281, ISO_TS_16281, KINEMATIC):
        register(method)
