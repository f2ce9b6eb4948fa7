"""Build the pack of machine code of a wheel.

The build of a wheel runs ``python -m lambda_core.export.fmu.pack_builder FOLDER``, with the sources of the wheel in
front of all others. :mod:`lambda_core.laws.pack` uses what is written here.
"""

from __future__ import annotations

import hashlib
import json
import os
import shutil
import subprocess
import sys
import tempfile
from collections.abc import Callable, Mapping
from importlib.metadata import version
from importlib.util import find_spec
from pathlib import Path
from typing import Any

from lambda_core.domain.errors import LambdaError
from lambda_core.domain.installed import OWN, project_of
from lambda_core.domain.roles import ROLES
from lambda_core.laws.pack import MANIFEST, law_name, seal, sources

LEVEL = "x86-64-v3"
_GENERIC = "aarch64"
_OPTIONS = ("-O2", "-std=gnu11", "-shared", "-fPIC", "-fvisibility=hidden", "-Wall", "-s")
_CPU, _FEATURES = "NUMBA_CPU_NAME", "NUMBA_CPU_FEATURES"


def build_pack(folder: Path, announce: Callable[[str], None]) -> None:
    """Write libraries and their manifest into an empty folder.

    Parameters
    ----------
    announce : callable
        Called with a sentence before something that takes long.

    Raises
    ------
    UsageError, SolverError, PluginError
        When there is no C compiler, or something cannot be compiled.
    """
    from lambda_core.export.fmu.library import PLATFORMS, compiler
    from lambda_core.laws.jit.portable import MEMORY_SOURCE, object_codes
    from lambda_core.laws.kernels import cache_folder

    compiler()
    names = [name for name in PLATFORMS if name == "linux" or find_spec("ziglang")]
    functions, pointers = _functions(announce)
    announce(f"linking {len(functions)} functions for {', '.join(names)}")
    targets = [PLATFORMS[name].target for name in names]
    libraries = {}
    for name, objects in zip(names, object_codes((), pointers, cache_folder(), targets, alike=False), strict=True):
        file = folder / f"{name}.{PLATFORMS[name].suffix}"
        _link(compiler(name), objects, [Path(__file__).with_name("pack.c"), MEMORY_SOURCE], file)
        level = LEVEL if PLATFORMS[name].target.is_x86 else _GENERIC
        digest = hashlib.sha256(file.read_bytes()).hexdigest()
        libraries[name] = {"file": file.name, "sha256": digest, "level": level}
    content = {
        "sources": sources(),
        "made_by": f"numba {version('numba')} llvmlite {version('llvmlite')}",
        "libraries": libraries,
        "functions": functions,
    }
    (folder / MANIFEST).write_text(json.dumps({"seal": seal(content), "content": content}, indent=1))


def _functions(announce: Callable[[str], None]) -> tuple[dict[str, Any], list[Any]]:
    """Compile units and laws.

    Return what the manifest lists of each by name, and their pointers in this order.
    """
    from lambda_core.analysis.electric.circuit_integrator import compiled
    from lambda_core.analysis.electric.compiled import switching
    from lambda_core.discovery.api import registry
    from lambda_core.laws.jit.machine_code import Pointer
    from lambda_core.laws.kernels import compile_kernel
    from lambda_core.solver import entry

    entry.begin(announce, (*entry.UNITS, *entry.OF_ROLLERS))
    models = registry()
    said: dict[str, Any] = {}
    pointers: list[Any] = []
    for role in ROLES:
        for name in models.names(role):
            law = models.model(role, name)
            if project_of(law.distribution) != OWN:
                continue
            kernel = f"{law.kernel.__module__}:{law.kernel.__qualname__}"
            said[law_name(law)] = {"place": len(pointers), "kernel": kernel}
            pointers.append(compile_kernel(law).pointer)
    entry.wait()
    for name in (*entry.UNITS, *entry.OF_ROLLERS):
        signature = entry.signature(name)
        said[name] = {"place": len(pointers), "kinds": _written(signature)}
        pointers.append(entry.call_and_pointer(name)[1])
    said["circuit"] = {"place": len(pointers), "kinds": _written(switching.integrate_sig)}
    pointers.append(Pointer(compiled(None), switching.integrate_sig))
    return said, pointers


def _written(signature: Any) -> list[Any]:
    """Return the kinds of a function's arguments.

    They have the form that :func:`lambda_core.laws.pack.kind_from` reads.
    """
    return [_kind(each) for each in signature.args]


def _kind(kind: Any) -> Any:
    from numba import types

    from lambda_core.laws.jit.references import Reference

    if isinstance(kind, Reference):
        return kind.attribute
    if isinstance(kind, types.Array):
        is_record = isinstance(kind.dtype, types.Record)
        return [kind.dtype.size if is_record else str(kind.dtype), kind.ndim]
    if isinstance(kind, types.FunctionType):
        return "function"
    if isinstance(kind, types.BaseTuple):
        parts: Any = kind
        return {"tuple": [_kind(each) for each in parts.types]}
    return {types.float64: "float", types.int64: "int"}.get(kind, str(kind))


def _link(command: tuple[str, ...], objects: Mapping[str, bytes], sources: list[Path], library: Path) -> None:
    from lambda_core.domain.errors import UsageError

    with tempfile.TemporaryDirectory() as made:
        files = [Path(made, name) for name in objects]
        for file in files:
            file.write_bytes(objects[file.name])
        linked = Path(made, library.name)  # among what some linkers leave there
        line = [*command, *_OPTIONS, *map(str, [*sources, *files]), "-o", str(linked), "-lm"]
        done = subprocess.run(line, capture_output=True, text=True, stdin=subprocess.DEVNULL, check=False)
        if done.returncode == 0:
            shutil.copy(linked, library)
    if done.returncode != 0:
        raise UsageError(f"the C compiler {' '.join(command)} fails: {done.stderr.strip()[:2000]}")


def main() -> int:
    """Build the pack in the folder.

    The command names the folder; the processor is set before Numba is imported.
    """
    if os.environ.get(_CPU) != LEVEL:
        settings = {_CPU: LEVEL, _FEATURES: "", "LAMBDA_BEARING_CODE": "native"}
        again = [sys.executable, "-P", "-W", "ignore", "-m", __spec__.name, *sys.argv[1:]]
        return subprocess.run(again, env=os.environ | settings, check=False).returncode
    try:
        build_pack(Path(sys.argv[1]), lambda text: print(text, file=sys.stderr, flush=True))
    except LambdaError as error:
        print(error, file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
