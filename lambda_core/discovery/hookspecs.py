"""Declare the hooks that plugins implement (pluggy project ``lambda_core``)."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import TYPE_CHECKING, Any

import pluggy

from lambda_core.laws.law import LazyLaw
from lambda_core.views.method import Method

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    from lambda_core.catalogue.protocol import Catalogue
    from lambda_core.views.chart import ViewData
    from lambda_core.views.observer import Event, Observer
    from lambda_core.views.roller_profile import RollerProfile
    from lambda_core.views.scene import Scene
    from lambda_core.views.section import Section
    from lambda_core.views.view import Figure, View

PROJECT = "lambda_core"
hookspec = pluggy.HookspecMarker(PROJECT)
hookimpl = pluggy.HookimplMarker(PROJECT)


@hookspec
def lambda_laws(register: Callable[[Callable[..., int] | LazyLaw], None]) -> None:
    """Register laws of other modules.

    ``register(function)``, with ``@law(...)`` above it; those of the entry point's module need no call.

    A package with many laws registers ``LazyLaw("traction", "my-law", "package.module:function")``
    instead, which imports the module when the law is chosen.
    """


@hookspec
def lambda_methods(register: Callable[[Method], None]) -> None:
    """Register comparison methods (case -> table), compared with the simulation."""


@hookspec
def lambda_views(register: Callable[[View], None]) -> None:
    """Register views: ``register(View("my-view", "What it shows", "result", data, view_api=1))``."""


@hookspec
def lambda_observers(register: Callable[[Observer], None]) -> None:
    """Register observers.

    They write their own channels into a run's result: ``register(Observer("wear", ...))``.
    """


@hookspec
def lambda_events(register: Callable[[Event], None]) -> None:
    """Register events.

    A run records them or ends at them: ``register(Event("cage-instability", ...))``.
    """


@hookspec
def lambda_sections(register: Callable[[Section], None]) -> None:
    """Register sections of the report of a run: ``register(Section("noise-class", ...))``."""


@hookspec
def lambda_profiles(register: Callable[[RollerProfile], None]) -> None:
    """Register profiles of rollers: ``register(RollerProfile("my-profile", ...))``."""


@hookspec(firstresult=True)
def lambda_figure(data: ViewData) -> Figure | None:
    """Draw the data of a view without drawing.

    Views with a drawing of their own do not call it.
    """


@hookspec(firstresult=True)
def lambda_frames(scene: Scene) -> Iterator[NDArray[np.uint8]] | None:
    """Draw the frames of an animation in order.

    They are RGB, shape (height, width, 3), all of one even size.
    """


@hookspec
def lambda_data(register: Callable[[Any], None]) -> None:
    """Register catalogue rows.

    ``register(path)`` takes a folder of seed files of this package.

    A folder ``measured`` in it holds measured series: for each a TOML file that describes it, and a CSV file of the
    same name with its points.
    """


@hookspec(firstresult=True)
def lambda_catalogue(seed_folders: list[Any]) -> Catalogue | None:
    """Open the catalogue.

    It has the built-in seeds and the folders that plugins bring.
    """
