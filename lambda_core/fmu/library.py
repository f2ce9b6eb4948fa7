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
from lambda_core.fmu.variables import Variable, control
from lambda_core.laws.jit.portable import data_code, features, known_processor, object_code
from lambda_core.laws.kernels import cache_folder
from lambda_core.solver import records as R
from lambda_core.solver.faults import ROLES
from lambda_core.solver.integrator.memory import COUNT
from lambda_core.solver.status import Status

SOURCES = Path(__file__).parent / "source"
_OPTIONS = ("-O2", "-std=gnu11", "-shared", "-fPIC", "-fvisibility=hidden", "-ffp-contract=off", "-Wall", "-s")
_ZIG_TARGET = ("-target", "x86_64-linux-gnu.2.17")  # of Linux distributions since 2014
_COMPILERS = ("cc", "gcc", "clang")
# What a processor must have that is called so.
_NAMED = {
    "x86-64-v2": ("sse4.2", "popcnt"),
    "x86-64-v3": ("avx2", "fma", "bmi", "bmi2"),
    "x86-64-v4": ("avx2", "fma", "bmi", "bmi2", "avx512f", "avx512vl", "avx512dq", "avx512bw", "avx512cd"),
}
# Where the processor says that it has them: leaf of the instruction cpuid, register (1: ebx, 2: ecx), bit.
_CPUID = {
    "sse4.2": (1, 2, 20),
    "popcnt": (1, 2, 23),
    "avx": (1, 2, 28),
    "fma": (1, 2, 12),
    "bmi": (7, 1, 3),
    "avx2": (7, 1, 5),
    "bmi2": (7, 1, 8),
    "avx512f": (7, 1, 16),
    "avx512dq": (7, 1, 17),
    "avx512cd": (7, 1, 28),
    "avx512bw": (7, 1, 30),
    "avx512vl": (7, 1, 31),
}
_WIDE = {"avx512": 0xE6, "avx": 0x6}  # registers that the system must keep for features that begin so


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
    sources = [*(SOURCES / f"{file}.c" for file in ("core", interface)), *(folder / file for file in parts.objects)]
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


def header_text(frozen: Frozen, variables: Sequence[Variable]) -> str:
    """Return what the library's C has to know of a case."""
    image, fault = frozen.image, frozen.image.place(frozen.fault) + _at(R.SCRATCH, "fault")
    numbers = {
        "IMAGE_SIZE": image.size,
        "HOST": image.place(frozen.host),
        "CONTROL_TIME": control(frozen, "time"),
        "CONTROL_STOP": control(frozen, "stop"),
        "SAMPLES_WAITING": image.place(frozen.memory.count) + _at(COUNT, "samples_waiting"),
        "FAULT_ROLE": fault + _at(R.FAULT, "role"),
        "FAULT_STATUS": fault + _at(R.FAULT, "status"),
        "FAULT_BALL": fault + _at(R.FAULT, "ball"),
        "FAULT_INPUTS": fault + _at(R.FAULT, "inputs"),
        "LOSSES": image.place(frozen.scratch.rates),
        "INTEGRALS": image.place(frozen.memory.integrals),
        "LOSS_COUNT": frozen.losses,
        "RELATIVE_SPEED": frozen.rate("relative_speed"),
        "RELATIVE_ANGLE": frozen.integral("relative_speed"),
        "STATUS_OK": int(Status.OK),
        "STATUS_REFUSED": int(Status.REFUSED),
        "STATUS_STEP_TOO_SMALL": int(Status.STEP_TOO_SMALL),
        "VARIABLES": len(variables),
    }
    needed = _needed()
    lines = ['#include "token.h"']
    lines += [f"#define LB_{name} {number}" for name, number in numbers.items()]
    lines += [f'#define LB_PROCESSOR "{known_processor()} ({", ".join(needed)})"']
    kept = next((mask for head, mask in _WIDE.items() if any(name.startswith(head) for name in needed)), 0)
    lines += [f"#define LB_REGISTERS {kept}"]
    places = ", ".join(f"{{{leaf}, {register}, {bit}}}" for leaf, register, bit in map(_CPUID.__getitem__, needed))
    lines += [f"static const unsigned lb_needs[][3] = {{{places}}};"]
    lines += [f"static const uint32_t lb_relocations[][2] = {{{_pairs(image.relocations)}}};"]
    lines += [f"static const uint32_t lb_fixes[][2] = {{{_pairs(image.fixes)}}};"]
    lines += [f"static const char *const lb_roles[] = {{{', '.join(map(_quoted, ROLES))}}};"]
    rows = (f"{{{v.kind:d},{v.place},{v.count},{v.stride},{v.scale!r},{v.begin}}}" for v in variables)
    lines += [f"static const lb_variable lb_variables[] = {{{', '.join(rows)}}};"]
    lines += [f"static const char *const lb_names[] = {{{', '.join(_quoted(v.name) for v in variables)}}};"]
    return "\n".join(lines) + "\n"


def _needed() -> tuple[str, ...]:
    """Return what a processor must have for code of this process."""
    name = known_processor()
    return _NAMED[name] if name in _NAMED else tuple(each for each in _CPUID if each in features())


def _at(kind: object, name: str) -> int:
    return int(kind.fields[name][1])  # type: ignore[attr-defined]


def _pairs(pairs: Sequence[tuple[int, int]]) -> str:
    return ",".join(f"{{{a},{b}}}" for a, b in pairs)


def _quoted(text: str) -> str:
    return f'"{text}"'
