"""Offer the built-in views of results and studies.

matplotlib is imported when a view is drawn.
"""

from __future__ import annotations

from collections.abc import Callable

from lambda_core.plugins import View


def register_views(register: Callable[[View], None]) -> None:
    """Register every built-in view: call it from the hook ``lambda_views``."""
    from lambda_plugins.views import (
        arcs,
        azimuth,
        cage,
        capacitance,
        catalogues,
        channel,
        comparison,
        contact_map,
        electric,
        element_speeds,
        energy,
        friction,
        heat,
        machine,
        operating_point,
        ring,
        ring_shape,
        rollers,
        study,
        vibration,
    )

    for module in (
        azimuth,
        arcs,
        contact_map,
        friction,
        catalogues,
        energy,
        heat,
        element_speeds,
        cage,
        ring,
        ring_shape,
        rollers,
        capacitance,
        electric,
        machine,
        operating_point,
        channel,
        vibration,
        comparison,
        study,
    ):
        for view in module.VIEWS:
            register(view)
