"""Register the catalogue without heavy imports.

SQLAlchemy is loaded when the catalogue is opened.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from lambda_core.discovery.api import hookimpl

if TYPE_CHECKING:
    from lambda_core.catalogue.protocol import Catalogue


@hookimpl
def lambda_catalogue(seed_folders: list[Any]) -> Catalogue:
    """Open the catalogue with all sources.

    They are the built-in seeds, the folders that plugins bring and the user's own database.
    """
    from lambda_db.catalogue import open_catalogue

    return open_catalogue(seed_folders)
