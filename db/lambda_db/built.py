"""Find the core database that was built from the seeds."""

from __future__ import annotations

import hashlib
import logging
from contextlib import suppress
from functools import lru_cache
from pathlib import Path

from lambda_db.paths import cache_folder

log = logging.getLogger("lambda_db")
BUILT_IN = Path(__file__).parent / "seeds"


def seed_files(folder: Path) -> list[Path]:
    """Return a folder's seed files in a fixed order."""
    return sorted(path for path in folder.iterdir() if path.suffix in (".csv", ".toml"))


def fingerprint(folders: list[Path]) -> str:
    """Hash everything that a built database depends on.

    The seeds and the code that turns them into tables.
    """
    digest = hashlib.sha256()
    code = sorted(Path(__file__).parent.glob("*.py"))
    for path in [*code, *(file for folder in folders for file in seed_files(folder))]:
        now = path.stat()
        digest.update(f"{path.name}\0".encode() + _content(path, now.st_mtime_ns, now.st_size, now.st_ino))
    return digest.hexdigest()[:16]


@lru_cache(maxsize=1024)
def _content(path: Path, *_: int) -> bytes:
    """Hash a file, again only after a change.

    A catalogue is opened for every check of a case.
    """
    return hashlib.sha256(path.read_bytes()).digest()


def built_name(plugin_folders: list[Path]) -> str:
    """Return the first part of a built database's name."""
    return f"catalogue-{fingerprint([BUILT_IN, *plugin_folders])}"


def digest_of(path: Path) -> str:
    """Return the hash in a built database's name.

    It is at the end.
    """
    now = path.stat()
    return _content(path, now.st_mtime_ns, now.st_size, now.st_ino).hex()[:16]


def is_sound(path: Path) -> bool:
    """Tell whether a built file is unchanged.

    It compares every byte with the digest in the file's name.
    """
    try:
        return path.stem.endswith(f"-{digest_of(path)}")
    except OSError:
        return False


def find_built(plugin_folders: list[Path]) -> Path | None:
    """Return the core database, None where it is missing.

    A damaged file is removed.
    """
    for path in sorted(cache_folder().glob(f"{built_name(plugin_folders)}-*.sqlite")):
        if is_sound(path):
            return path
        log.warning("the catalogue's cache file %s is damaged; building it again", path)
        with suppress(OSError):
            path.unlink()
    return None
