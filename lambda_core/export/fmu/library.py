"""Build the shared library of a bearing."""

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
from lambda_core.export.fmu.frozen import Frozen
from lambda_core.export.fmu.header import header_text
from lambda_core.export.fmu.variables import Variable
from lambda_core.laws.jit.emission import Target
from lambda_core.laws.jit.portable import MEMORY_SOURCE, data_code, fuses, object_codes
from lambda_core.laws.kernels import cache_folder

SOURCES = Path(__file__).parent / "source"
_OPTIONS = ("-O2", "-std=gnu11", "-shared", "-fPIC", "-fvisibility=hidden", "-ffp-contract=off", "-Wall", "-s")
_OWN_MATHEMATICS = ("-O3", "-fno-builtin", "-fno-math-errno")  # loops over coefficients unrolled: five times as fast
_COMPILERS = ("cc", "gcc", "clang")


@dataclass(frozen=True)
class Platform:
    """A system that a library can be built for.

    Attributes
    ----------
    title : str
    folders : dict of int to str
        In an FMU, by version of the standard. Version 2 names none for ARM: that of version 3.
    suffix : str
        Of a library.
    target : Target
        For what compiled code is made.
    zig : str
        The same as zig names it.
    """

    title: str
    folders: dict[int, str]
    suffix: str
    target: Target
    zig: str


PLATFORMS = {
    "linux": Platform(
        "Linux on x86-64", {2: "linux64", 3: "x86_64-linux"}, "so", Target(),
        "x86_64-linux-gnu.2.17",  # of distributions since 2014
    ),
    "windows": Platform(
        "Windows on x86-64", {2: "win64", 3: "x86_64-windows"}, "dll", Target("x86_64-w64-windows-gnu"),
        "x86_64-windows-gnu",
    ),
    "linux-arm": Platform(
        "Linux on 64-bit ARM", {2: "aarch64-linux", 3: "aarch64-linux"}, "so", Target("aarch64-unknown-linux-gnu"),
        "aarch64-linux-gnu.2.17",
    ),
    "mac-arm": Platform(
        "macOS on Apple's processors", {2: "aarch64-darwin", 3: "aarch64-darwin"}, "dylib",
        Target("arm64-apple-macosx11.0.0"), "aarch64-macos.11.0",
    ),
    "mac-intel": Platform(
        "macOS on x86-64", {2: "darwin64", 3: "x86_64-darwin"}, "dylib", Target("x86_64-apple-macosx11.0.0"),
        "x86_64-macos.11.0",
    ),
}  # fmt: skip


def compiler(platform: str = "linux") -> tuple[str, ...]:
    """Return the C compiler's command for a platform.

    It is the system's compiler for its own platform, or that of the extra ``fmu``.

    Raises
    ------
    UsageError
        When there is none.
    """
    for name in _COMPILERS if platform == "linux" else ():
        if shutil.which(name):
            return (name,)
    if find_spec("ziglang") is not None:
        return (sys.executable, "-P", "-m", "ziglang", "cc", "-target", PLATFORMS[platform].zig)
    missing = "there is no C compiler (cc, gcc, clang) here: install one, or take the one of the extra fmu"
    if platform != "linux":
        missing = f"for {PLATFORMS[platform].title} a library is built by the compiler of the extra fmu"
    raise UsageError(f'{missing}: pip install "lambda-bearing[fmu]"')


def build(parts: Parts, interface: str, folder: Path, name: str, platform: str) -> Path:
    """Build the library of a bearing.

    Parameters
    ----------
    interface : str
        The file of :data:`SOURCES` that speaks to the host: "fmi2" or "fmi3".
    folder : Path
        For the library and what it is made of.
    name : str
        Of the library's file.
    platform : str
        Key of :data:`PLATFORMS`.

    Raises
    ------
    UsageError
        When there is no C compiler, or it fails.
    """
    command, own = compiler(platform), ("mathematics",) if parts.alike else ()
    folder = folder / platform
    folder.mkdir()
    for file, content in (parts.files | parts.objects[platform]).items():
        (folder / file).write_bytes(content)
    library = folder / f"{name}.{PLATFORMS[platform].suffix}"
    sources = [
        SOURCES / f"{file}.c"
        for file in ("core", "limits", "states", "circuit", "follow", "slopes", "start", interface, *own)
    ]
    sources += [MEMORY_SOURCE, *(folder / file for file in parts.objects[platform])]
    options = (*_OPTIONS, *(_OWN_MATHEMATICS if own else ()), *(("-DLB_FUSED",) if own and fuses() else ()))
    arguments = [*command, *options, f"-I{folder}", *map(str, sources), "-o", str(library), "-lm"]
    done = subprocess.run(arguments, capture_output=True, text=True, stdin=subprocess.DEVNULL, check=False)
    if done.returncode != 0:
        raise UsageError(f"the C compiler {' '.join(command)} fails: {done.stderr.strip()[:2000]}")
    return library


@dataclass(frozen=True)
class Parts:
    """Parts of a library except its interface.

    Attributes
    ----------
    files : dict of str to bytes
        Headers by name.
    objects : dict of str to (dict of str to bytes)
        Machine code by platform.
    token : str
        By which the libraries and their description know each other.
    alike : bool
        Whether functions of mathematics are the program's own, with the same bits on every platform.
    """

    files: dict[str, bytes]
    objects: dict[str, dict[str, bytes]]
    token: str
    alike: bool


def library_parts(frozen: Frozen, variables: Sequence[Variable], platforms: Sequence[str]) -> Parts:
    """Return what the libraries of a bearing are made of.

    For Linux alone functions of mathematics are those of its C library, as in a run of the program there.

    Raises
    ------
    SolverError
        When a law needs Python to run.
    """
    targets = [PLATFORMS[platform].target for platform in platforms]
    alike, image = list(platforms) != ["linux"], frozen.image.bytes()
    codes = object_codes(frozen.entries, frozen.image.functions, cache_folder(), targets, alike=alike)
    objects = {
        platform: {**code, "image.o": data_code("lb_image", image, target)}
        for platform, target, code in zip(platforms, targets, codes, strict=True)
    }
    header = header_text(frozen, variables).encode()
    digest = hashlib.sha256(b"".join([header, *(part for each in objects.values() for part in each.values())]))
    digits = digest.hexdigest()
    token = "{" + "-".join(digits[a:b] for a, b in ((0, 8), (8, 12), (12, 16), (16, 20), (20, 32))) + "}"
    files = {"case.h": header, "token.h": f'#define LB_TOKEN "{token}"\n'.encode()}
    return Parts(files, objects, token, alike)
