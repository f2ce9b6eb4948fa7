"""List, check and create plugin packages."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Sequence

    from lambda_core.discovery.registry import OtherKind
    from lambda_core.discovery.survey import FaultCard, Inventory, ModelCard, PartCard


def plugins() -> Inventory:
    """Return what is installed, and plugins not in use.

    Returns
    -------
    Inventory
        Models, methods, views and data folders with their distributions; faults with the reason.
    """
    from lambda_core.discovery.manager import registry
    from lambda_core.discovery.survey import inventory

    return inventory(registry())


def plugin_parts(kind: OtherKind) -> list[PartCard]:
    """Return everything installed of one kind, with its parameters.

    Parameters
    ----------
    kind : str
        "method", "view", "observer", "event", "section" or "profile".

    Returns
    -------
    list of PartCard
    """
    from lambda_core.discovery.manager import registry
    from lambda_core.discovery.survey import part_cards

    return part_cards(registry(), kind)


def plugin_model(label: str) -> ModelCard:
    """Return everything about one model.

    Parameters with units, limits and sources, validity, reference.

    Parameters
    ----------
    label : str
        "role/name", for example "traction/ree-eyring".

    Returns
    -------
    ModelCard

    Raises
    ------
    UsageError
        When `label` is not of that form or there is no such role.
    PluginError
        When the role has no such model, or it cannot be imported.
    """
    from lambda_core.discovery.manager import registry
    from lambda_core.discovery.survey import model_card

    return model_card(registry(), label)


def plugin_faults(names: Sequence[str] = ()) -> list[FaultCard]:
    """Return the plugins that could not be taken into use.

    Parameters
    ----------
    names : sequence of str
        Distributions; all when empty.

    Returns
    -------
    list of FaultCard
        With the reason of each.
    """
    from lambda_core.discovery.manager import registry
    from lambda_core.discovery.survey import broken

    return broken(registry(), names)


def new_plugin(name: str, folder: str | Path = ".") -> list[Path]:
    """Write the sources of a small plugin package.

    Parameters
    ----------
    name : str
        Lower case and hyphens, for example "my-traction".
    folder : path-like
        Where the package's folder `name` is made.

    Returns
    -------
    list of pathlib.Path
        The files that were written.

    Raises
    ------
    UsageError
        When the name is taken or not of that form, or the folder exists or cannot be written.
    """
    from lambda_core.discovery.scaffold import new_plugin as write

    return write(name, Path(folder))
