"""Locate the files of the catalogue.

Environment variables move them.
"""

from __future__ import annotations

import os
from pathlib import Path

import platformdirs

from lambda_core.domain.files import user_data_folder

APPLICATION = "lambda-bearing"


def cache_folder() -> Path:
    """Return the folder of the built core database.

    It is ``LAMBDA_BEARING_CACHE`` or the user's cache folder.
    """
    given = os.environ.get("LAMBDA_BEARING_CACHE")
    return Path(given) if given else platformdirs.user_cache_path(APPLICATION)


def user_database() -> Path:
    """Return the file of the user's own rows."""
    return user_data_folder() / "catalogue.sqlite"
