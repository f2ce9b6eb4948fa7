"""Accept only regular files of a limited size.

The limit is a size that fits into memory.
"""

from __future__ import annotations

import errno
import os
import stat
from pathlib import Path
from tempfile import NamedTemporaryFile

from lambda_core.domain.errors import UsageError

LARGEST_TEXT = 64 * 2**20  # [byte] of a case, a table, a document
_NO_ROOM = (errno.ENOSPC, errno.EDQUOT, errno.EFBIG, errno.EMFILE, errno.ENFILE, errno.ENOMEM, errno.EIO)
_OURS = Path(__file__).parents[1]
_LONGEST_NAME = 100
_NUL = "no name of a file holds a NUL character"
_DEVICES = {"CON", "PRN", "AUX", "NUL", *(f"{port}{number}" for port in ("COM", "LPT") for number in range(1, 10))}
_KINDS = (
    (stat.S_ISDIR, "a folder"),
    (stat.S_ISFIFO, "a pipe"),
    (stat.S_ISSOCK, "a socket"),
    (stat.S_ISCHR, "a device"),
    (stat.S_ISBLK, "a device"),
)


def system_refusal(error: OSError) -> str:
    """Return what the system refused.

    It is a file of somebody's, or room; "" for a mistake of the program.
    """
    if error.errno in _NO_ROOM:
        return f"the system refuses: {os.strerror(error.errno)}"
    name = os.fsdecode(error.filename) if isinstance(error.filename, str | bytes) else ""
    if not name or not error.strerror or Path(name).is_relative_to(_OURS):
        return ""
    return f'cannot use "{name if len(name) < _LONGEST_NAME else name[:_LONGEST_NAME] + "..."}": {error.strerror}'


def kind_of(path: Path) -> str:
    """Return the kind of an irregular file.

    It is a word such as "a folder" or "a pipe", or "" for a regular file or none.
    """
    try:
        mode = path.stat().st_mode
    except OSError:
        return ""
    return "" if stat.S_ISREG(mode) else next((name for test, name in _KINDS if test(mode)), "no file")


def check_target(path: Path) -> Path:
    """Return a path that may be written to.

    It is free, or a regular file.

    Raises
    ------
    UsageError
        For a folder, a device, a pipe or a socket, links to them included: replaced, they would be lost to everybody.
    """
    if "\0" in str(path):
        raise UsageError(f'cannot write "{path}": {_NUL}')
    if path.name.partition(".")[0].rstrip().upper() in _DEVICES:
        raise UsageError(f'cannot write "{path}": Windows opens no file with the name of a device')
    kind = kind_of(path)
    if kind:
        raise UsageError(f'cannot write "{path}": it is {kind}, and only regular files are written')
    return path


def taken(path: Path) -> UsageError:
    """Return the refusal to overwrite a file.

    It is for callers without permission to overwrite.
    """
    return UsageError(f"{path} exists: choose another name (--out), or overwrite it (--force)")


def check_new(path: Path, overwrite: bool) -> Path:
    """Return a path that is free, or may be overwritten.

    Raises
    ------
    UsageError
        When something stands there.
    """
    if path.exists() and not overwrite:
        raise taken(path)
    return path


def check_folder(folder: Path, target: Path | None = None, *, made: bool = False) -> Path:
    """Return a folder that accepts files.

    A temporary file tests it, before the work whose result it is to hold.

    Parameters
    ----------
    folder : pathlib.Path
        The folder.
    target : pathlib.Path, optional
        What is to be written into it, for the sentence; default: the folder itself.
    made : bool
        The folder is made where it does not stand yet; then the nearest one above it is tried.

    Raises
    ------
    UsageError
        When it does not exist, is read-only, or of a kind that takes no new file (/proc).
    """
    target, place = target or folder, folder.absolute()
    try:
        while made and not place.exists():
            place = place.parent
        if not place.is_dir():
            reason = "is not a folder" if place.exists() else "does not exist"
            raise UsageError(f"cannot write {target}: the folder {place} {reason}")
        with NamedTemporaryFile(prefix=".lambda-bearing-", dir=place):
            pass
    except OSError as error:
        raise UsageError(f"cannot write {target}: the folder {place} is not writable ({error.strerror})") from None
    return folder


def read_bytes(path: Path, largest: int = LARGEST_TEXT) -> bytes:
    """Return the content of a regular file.

    Raises
    ------
    OSError
        With a sentence in `strerror`: for what is no regular file, is larger than `largest`, or cannot be read.
    """
    if "\0" in str(path):
        raise OSError(0, _NUL)
    # Opening a pipe would wait for its writer.
    with open(os.open(path, os.O_RDONLY | getattr(os, "O_NONBLOCK", 0) | getattr(os, "O_BINARY", 0)), "rb") as file:
        mode = os.fstat(file.fileno()).st_mode
        if not stat.S_ISREG(mode):
            kind = next((name for test, name in _KINDS if test(mode)), "no file")
            raise OSError(0, f"it is {kind}, not a regular file")
        content = file.read(largest + 1)
    if len(content) > largest:
        raise OSError(0, f"it is larger than {largest // 2**20} MiB")
    return content


def read_text(path: Path, largest: int = LARGEST_TEXT) -> str:
    """Return the text of a regular UTF-8 file.

    It has no byte order mark; errors as :func:`read_bytes`.
    """
    return read_bytes(path, largest).decode("utf-8-sig")


def user_data_folder() -> Path:
    """Return the folder of the user's own data.

    ``LAMBDA_BEARING_DATA`` or the one that the system has for it.
    """
    import platformdirs

    given = os.environ.get("LAMBDA_BEARING_DATA")
    return Path(given) if given else platformdirs.user_data_path("lambda-bearing")
