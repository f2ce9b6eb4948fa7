"""Accept laws as Python objects where a case has names.

The packages below discovery know a law by its marks only; the registry of this process takes what is gathered here.
"""

from __future__ import annotations

import hashlib
import inspect
import linecache
import pickle
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

MARK = "lambda_law"  # attribute of a function that is the kernel of a law
NOTEBOOK = "notebook"  # stands where the name of a package, or of a script, would


@dataclass(frozen=True)
class InlineLaw:
    """One law that was handed over."""

    project: str  # name of the script, or NOTEBOOK
    digest: str  # of the text that it comes from
    role: str
    name: str
    item: Any  # the law, or its kernel

    @property
    def label(self) -> str:
        """The name by which a case chooses it."""
        return f"{self.project}:{self.name}"


_laws: dict[tuple[str, str], InlineLaw] = {}  # by role and label
_listeners: list[Callable[[], None]] = []


def when_changed(listener: Callable[[], None]) -> None:
    """Call a function for every new inline law.

    A law is new that was not passed before.
    """
    _listeners.append(listener)


def inline_laws() -> tuple[InlineLaw, ...]:
    """Return every law that was handed over in this process."""
    return tuple(_laws.values())


def take_laws(laws: tuple[InlineLaw, ...]) -> None:
    """Take laws that another process was handed."""
    if not laws:
        return
    _laws.update({(law.role, law.label): law for law in laws})
    for listener in _listeners:
        listener()


def packed() -> bytes:
    """Return every inline law as bytes.

    Functions are packed by their code; empty without a law.
    """
    if not _laws:
        return b""
    from numba import cloudpickle

    data: bytes = cloudpickle.dumps(inline_laws())  # type: ignore[no-untyped-call]
    return data


def unpack(data: bytes) -> None:
    """Take the inline laws of another process.

    :func:`packed` returned them; known ones are left out.
    """
    laws: tuple[InlineLaw, ...] = pickle.loads(data) if data else ()
    known = {(law.role, law.label): law.digest for law in _laws.values()}
    take_laws(tuple(law for law in laws if known.get((law.role, law.label)) != law.digest))


def is_law(item: object) -> bool:
    """Tell whether an object is a law.

    A function with ``@law(...)`` above it is one.
    """
    law = getattr(item, MARK, item)
    return all(hasattr(law, name) for name in ("role", "name", "kernel", "parameters"))


def name_of(item: Any) -> str:
    """Return the name of an inline law.

    A case chooses the law by it; this process keeps the law.
    """
    law = getattr(item, MARK, item)
    project, digest = _origin(law.kernel)
    handed = InlineLaw(project, digest, law.role, law.name, item)
    if _laws.get((law.role, handed.label)) != handed:
        take_laws((handed,))
    return handed.label


def named(value: Any) -> Any:
    """Return tables with every law as its name.

    They are the tables of a case, or lists of values.
    """
    if isinstance(value, Mapping):
        return {key: named(item) for key, item in value.items()}
    if isinstance(value, list | tuple):
        return [named(item) for item in value]
    return name_of(value) if is_law(value) else value


def _origin(kernel: Any) -> tuple[str, str]:
    """Return the script of a kernel and digest.

    The digest is that of the script's text; of a notebook, of the function's text.
    """
    code = getattr(kernel, "__code__", None)
    path = Path(code.co_filename if code is not None else "")
    if path.suffix == ".py" and path.is_file() and "ipykernel" not in str(path):
        return path.name, digest_of(path.read_bytes())
    try:
        linecache.checkcache()
        text = inspect.getsource(kernel)
    except (OSError, TypeError):
        text = code.co_code.hex() if code is not None else repr(kernel)
    return NOTEBOOK, digest_of(text.encode())


def digest_of(text: bytes) -> str:
    """Return 12 digits of a text's SHA-256.

    They are the first ones.
    """
    return hashlib.sha256(text).hexdigest()[:12]
