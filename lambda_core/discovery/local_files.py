"""Load plugins of one file that the user names.

Three ways lead in, each on purpose: ``--plugin FILE.py`` for one call, the variable ``LAMBDA_BEARING_PLUGINS`` for
files and folders, and the folder ``plugins`` with the user's settings. The working directory is none of them, and
a file cannot import its neighbours.
"""

from __future__ import annotations

import os
import pickle
import re
import sys
from collections.abc import Callable, Iterator
from functools import partial
from pathlib import Path
from types import ModuleType

from lambda_core.domain.inline_laws import digest_of, packed, unpack
from lambda_core.domain.installed import ON_VARIABLE, Source
from lambda_core.domain.plugin_errors import PluginError

_texts: dict[Path, bytes] = {}  # of each file as it was first read: all of a process runs the same


def user_folder() -> Path:
    """Return the folder of automatic plugins.

    It is ``plugins`` in the user's settings; its files are in use without being named.
    """
    import platformdirs

    return Path(platformdirs.user_config_dir("lambda-bearing")) / "plugins"


def file_sources() -> list[Source]:
    """Return every plugin file that somebody named.

    None is executed; an unreadable one is reported when it is loaded.
    """
    found: dict[str, Source] = {}
    for path in dict.fromkeys([*_named(), *_texts]):
        source = _source(path)
        if source.project in found and found[source.project].target != source.target:
            other = f"another file of this name is in use, {found[source.project].target}"
            source = Source(source.project, "", source.target, _refusal(other), source.target)
        found.setdefault(source.project if source.version else source.name, source)
    return list(found.values())


def add_file(path: Path) -> Source:
    """Name one more plugin file.

    It counts for this process and those that it starts; it is read now.

    Returns
    -------
    Source
        What it is.
    """
    path = path.absolute()
    _texts.pop(path, None)
    before = os.environ.get(ON_VARIABLE, "")
    files = os.pathsep.join(dict.fromkeys(filter(None, [*before.split(os.pathsep), str(path)])))
    os.environ.update({ON_VARIABLE: files})
    return _source(path)


def guests() -> bytes:
    """Return the files and laws for another process.

    It then has the same plugins as this one; they can be pickled.
    """
    for path in _named():
        _source(path)
    laws = packed()
    return pickle.dumps((_texts, laws)) if laws or _texts else b""


def take_guests(data: bytes) -> bool:
    """Take what :func:`guests` of another process returned.

    Tell whether there are files among it that are new.
    """
    texts, laws = pickle.loads(data) if data else ({}, b"")
    new = any(_texts.get(path) != text for path, text in texts.items())
    _texts.update(texts)
    unpack(laws)
    return new


def _named() -> Iterator[Path]:
    """Yield the files that variable and folder name."""
    for word in filter(None, os.environ.get(ON_VARIABLE, "").split(os.pathsep)):
        path = Path(word)
        yield from sorted(path.glob("*.py")) if path.is_absolute() and path.is_dir() else (path,)
    folder = user_folder()
    if folder.is_absolute() and folder.is_dir():
        yield from sorted(folder.glob("*.py"))


def _source(path: Path) -> Source:
    """Return one file as a plugin.

    It is called by its name and the digest of its text.
    """
    refuse = partial(Source, path.name, "", str(path), target=str(path))
    if path not in _texts:
        if not path.is_absolute():
            return refuse(_refusal(f"{ON_VARIABLE} names files and folders by their whole path"))
        if path.suffix != ".py":
            return refuse(_refusal("a plugin of one file is a Python file, FILE.py"))
        try:
            _texts[path] = path.read_bytes()
        except OSError as error:
            return refuse(_refusal(f"cannot be read: {error.strerror}"))
    text = _texts[path]
    digest = digest_of(text)
    return Source(path.name, digest, str(path), partial(_load, path, text, digest), str(path))


def _refusal(sentence: str) -> Callable[[], object]:
    def load() -> object:
        raise PluginError(sentence)

    return load


def _load(path: Path, text: bytes, digest: str) -> ModuleType:
    """Execute a file as a module.

    The module's name is unique.
    """
    name = f"lambda_file_{re.sub(r'[^0-9A-Za-z_]', '_', path.stem)}_{digest}"
    if name in sys.modules:
        return sys.modules[name]
    module = ModuleType(name)
    module.__file__ = str(path)
    sys.modules[name] = module  # classes look their annotations up there
    try:
        exec(compile(text, str(path), "exec", dont_inherit=True), vars(module))
    except BaseException:
        del sys.modules[name]
        raise
    return module
