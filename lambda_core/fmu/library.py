"""The shared library of a bearing: the compiled solver, the image, and the interface in C around them."""

from __future__ import annotations

import hashlib
import shutil
import subprocess
import sys
from collections.abc import Sequence
from dataclasses import dataclass
from importlib.util import find_spec
from pathlib import Path

from lambda_core.domain.errors import UsageError
from lambda_core.fmu.frozen import Frozen
from lambda_core.fmu.header import header_text
from lambda_core.fmu.variables import Variable
from lambda_core.laws.jit.portable import MEMORY_SOURCE, data_code, object_code
from lambda_core.laws.kernels import cache_folder

SOURCES = Path(__file__).parent / "source"
_OPTIONS = ("-O2", "-std=gnu11", "-shared", "-fPIC", "-fvisibility=hidden", "-ffp-contract=off", "-Wall", "-s")
_ZIG_TARGET = ("-target", "x86_64-linux-gnu.2.17")  # of Linux distributions since 2014
_COMPILERS = ("cc", "gcc", "clang")


def compiler() -> tuple[str, ...]:
    """Return the command of a C compiler: the system's, or that of the extra ``fmu``.

    Raises
    ------
    UsageError
        When there is none.
    """
    for name in _COMPILERS:
        if shutil.which(name):
            return (name,)
    if find_spec("ziglang") is not None:
        return (sys.executable, "-P", "-m", "ziglang", "cc", *_ZIG_TARGET)
    raise UsageError(
        "there is no C compiler (cc, gcc, clang) here: install one, or take the one of the extra fmu: "
        'pip install "lambda-bearing[fmu]"'
    )


def build(parts: Parts, interface: str, folder: Path, name: str) -> Path:
    """Build the library of a bearing.

    Parameters
    ----------
    interface : str
        The file of :data:`SOURCES` that speaks to the host: "fmi2" or "fmi3".
    folder : Path
        For the library and what it is made of.
    name : str
        Of the library's file.

    Raises
    ------
    UsageError
        When there is no C compiler, or it fails.
    """
    command = compiler()
    for file, content in parts.files.items():
        (folder / file).write_bytes(content)
    library = folder / f"{name}.so"
    sources = [
        *(SOURCES / f"{file}.c" for file in ("core", "follow", "start", interface)),
        MEMORY_SOURCE,
        *(folder / file for file in parts.objects),
    ]
    whole = [*command, *_OPTIONS, f"-I{folder}", *map(str, sources), "-o", str(library), "-lm"]
    done = subprocess.run(whole, capture_output=True, text=True, stdin=subprocess.DEVNULL, check=False)
    if done.returncode != 0:
        raise UsageError(f"the C compiler {command[0]} fails: {done.stderr.strip()[:2000]}")
    return library


@dataclass(frozen=True)
class Parts:
    """What a library is made of, beside the interface.

    Attributes
    ----------
    files : dict of str to bytes
        By name: objects of machine code, headers.
    token : str
        By which the library and its description know each other.
    """

    files: dict[str, bytes]
    token: str

    @property
    def objects(self) -> list[str]:
        """Names of the objects."""
        return [name for name in self.files if name.endswith(".o")]


def library_parts(frozen: Frozen, variables: Sequence[Variable]) -> Parts:
    """Return what the library of a bearing is made of.

    Raises
    ------
    SolverError
        When a law needs Python to run.
    """
    files = {
        "code.o": object_code(frozen.entries, frozen.image.functions, cache_folder()),
        "image.o": data_code("lb_image", frozen.image.bytes()),
        "case.h": header_text(frozen, variables).encode(),
    }
    digest = hashlib.sha256(b"".join(files.values())).hexdigest()
    token = "{" + "-".join(digest[a:b] for a, b in ((0, 8), (8, 12), (12, 16), (16, 20), (20, 32))) + "}"
    return Parts({**files, "token.h": f'#define LB_TOKEN "{token}"\n'.encode()}, token)
