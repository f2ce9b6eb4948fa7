"""The hooks that plugins implement (pluggy project name ``lambda_core``)."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import TYPE_CHECKING, Any

import pluggy

from lambda_core.registry.method import Method
from lambda_core.registry.model import LazyModel, Model

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    from lambda_core.registry.catalogue import Catalogue
    from lambda_core.registry.chart import ViewData
    from lambda_core.registry.scene import Scene
    from lambda_core.registry.view import Figure, View

PROJECT = "lambda_core"
hookspec = pluggy.HookspecMarker(PROJECT)
hookimpl = pluggy.HookimplMarker(PROJECT)


@hookspec
def lambda_models(register: Callable[[Model | LazyModel], None]) -> None:
    """Register laws: ``register(model("traction", "my-law", kernel, Parameters, reference=...))``.

    A package with many laws registers ``LazyModel("traction", "my-law", "package.module:MODEL")``
    instead, which imports the module when the law is chosen.
    """


@hookspec
def lambda_methods(register: Callable[[Method], None]) -> None:
    """Register comparison methods (case -> table), shown beside the simulation."""


@hookspec
def lambda_views(register: Callable[[View], None]) -> None:
    """Register views: ``register(View("my-view", "What it shows", "result", data))``."""


@hookspec(firstresult=True)
def lambda_figure(data: ViewData) -> Figure | None:
    """Draw the data of a view that brings no drawing of its own."""


@hookspec(firstresult=True)
def lambda_frames(scene: Scene) -> Iterator[NDArray[np.uint8]] | None:
    """Draw the frames of an animation, one after the other: RGB, shape (height, width, 3), all of one even size."""


@hookspec
def lambda_data(register: Callable[[Any], None]) -> None:
    """Register catalogue rows: ``register(path)`` with a folder of seed files of this package."""


@hookspec(firstresult=True)
def lambda_catalogue(seed_folders: list[Any]) -> Catalogue | None:
    """Open the catalogue over the built-in seeds and the folders that plugins bring."""
