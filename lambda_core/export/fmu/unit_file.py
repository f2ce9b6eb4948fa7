"""Write a case as a co-simulation unit (FMU)."""

from __future__ import annotations

import json
import os
import platform
import re
import subprocess
import sys
import tempfile
import zipfile
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import TYPE_CHECKING, Any

from lambda_core.domain.blas_threads import one_blas_thread
from lambda_core.domain.errors import SolverError, UsageError, unknown_name
from lambda_core.laws.pack import compiled_here

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Mapping

    from lambda_core.case.case_io import Source
    from lambda_core.model.bearing_model import BearingModel
    from lambda_core.model.machine_model import MachineModel
    from lambda_core.solver.drivers.coupling import Coupling

PROCESSORS = {
    "x86-64-v3": "of Intel since 2013 and AMD since 2015",
    "x86-64-v4": "with AVX-512",
    "x86-64-v2": "of Intel since 2008 and AMD since 2011",
    "native": "of this machine",
}
_SERVING = "from lambda_core.export.fmu.unit_file import serve; serve()"
_CPU, _FEATURES = "NUMBA_CPU_NAME", "NUMBA_CPU_FEATURES"
_VERSIONS = (2, 3)
_STEP = 1e-4  # [s] between communication points, as a proposal
_STAYS = "the contact angles that radii are taken at, and mean loads that laws ask for, stay those of the exported case"
_END = 0.1  # [s]
_FIXED_TIME = (1980, 1, 1, 0, 0, 0)  # of files in the archive: the same case makes the same bytes


def export_fmu(
    source: Source,
    overrides: Iterable[str] = (),
    *,
    out: str | Path | None = None,
    fmi: int = 2,
    couple: Coupling = "force",
    vary: Iterable[str] = (),
    platforms: Iterable[str] = ("linux",),
    processor: str = "x86-64-v3",
    overwrite: bool = False,
    announce: Callable[[str], None] | None = None,
) -> Path:
    """Write a bearing or a machine as a co-simulation FMU.

    Its library holds the compiled solver, the laws of the case and its data at the equilibrium of t = 0; it needs the C
    library and nothing else.

    Parameters
    ----------
    source, overrides
        A case as for :func:`check`.
    out : path-like, optional
        The file; default: the name of the case with ``.fmu`` in this folder.
    fmi : int
        Version of the standard: 2 or 3.
    couple : "force" or "motion"
        What the host gives: loads on the inner ring, which the bearing moves; or the poses of both rings, on which the
        bearing puts reactions. To a machine it gives loads at markers, loads and gears, and the speed of the shaft.
    vary : iterable of str
        Options ``path=low..high`` that the host may change: temperatures as inputs, all others as tunable parameters.
    platforms : iterable of str
        Systems that the FMU has a library for: "linux", "windows", "linux-arm", "mac-arm", "mac-intel". All but Linux
        are built by the compiler of the extra ``fmu``; with one of them functions of mathematics are the program's
        own, and which products and sums are rounded as one is the same for all: all have the same bits.
    processor : str
        The least processor of x86-64 that runs it: "x86-64-v3" (default), "x86-64-v2", "x86-64-v4", or "native".
    overwrite : bool
        Overwrite a file that stands there.
    announce : callable, optional
        Called with a sentence before something is compiled.

    Returns
    -------
    Path
        The file.

    Raises
    ------
    UsageError
        For an unknown version, coupling, platform or processor, a case that cannot be coupled so, a file that
        exists, a folder that takes none, on another system, or without a C compiler.
    CaseError, SolverError
        With a sentence about the case or its equilibrium.
    """
    from lambda_core.case.case_io import read_case
    from lambda_core.case.case_writer import standalone_toml
    from lambda_core.domain.files import check_folder, check_new, check_target
    from lambda_core.domain.lists import listed
    from lambda_core.export.fmu.varied import varied
    from lambda_core.model.api import check
    from lambda_core.solver.drivers.coupling import check_coupling, check_known

    wanted = tuple(dict.fromkeys(listed(platforms, "platforms")))
    if fmi not in _VERSIONS:
        raise UsageError(f"FMI {fmi} is not supported: choose 2 or 3")
    check_known(couple)
    if processor not in PROCESSORS:
        raise UsageError(unknown_name("processor", processor, PROCESSORS))
    if (platform.system(), platform.machine()) != ("Linux", "x86_64"):
        raise UsageError(f"FMUs are built on Linux x86-64 only, not on {platform.system()} {platform.machine()}")
    from lambda_core.export.fmu.library import PLATFORMS, compiler

    if not wanted:
        raise UsageError(f"no system is given: choose {', '.join(PLATFORMS)}")
    for name in wanted:
        if name not in PLATFORMS:
            raise UsageError(unknown_name("platform", name, PLATFORMS))
        compiler(name)
    loaded = read_case(source, overrides)
    options = tuple(listed(vary, "vary"))
    varied(options, loaded)
    check_coupling(check(loaded), couple)
    target = check_target(Path(out) if out is not None else Path(f"{_plain(loaded.name)}.fmu"))
    check_folder(check_new(target, overwrite).parent, target)
    task = {"case": standalone_toml(loaded), "out": str(target.absolute()), "fmi": fmi, "couple": couple}
    task |= {"vary": options, "platforms": wanted}
    if processor == os.environ.get(_CPU, "native"):
        write(task, announce)
    else:
        if announce is not None:
            announce(f"exporting for {processor} (compiling takes one to ten minutes the first time)")
        _write_apart(task, processor, announce)
    return target


def _plain(name: str) -> str:
    return re.sub(r"[^\w.-]+", "-", name).strip("-.") or "bearing"


def write(task: Mapping[str, Any], announce: Callable[[str], None] | None = None) -> None:
    """Write an FMU with the code of this process's processor."""
    with compiled_here(), one_blas_thread():
        _write(task, announce)


def _write(task: Mapping[str, Any], announce: Callable[[str], None] | None) -> None:
    from importlib.metadata import version

    from lambda_core.analysis.thermal.temperatures import ready
    from lambda_core.case.case_io import apply_overrides, read_case, toml_tables
    from lambda_core.export.fmu.description import About, description
    from lambda_core.export.fmu.frozen import freeze
    from lambda_core.export.fmu.library import PLATFORMS, build, library_parts
    from lambda_core.export.fmu.variables import variables
    from lambda_core.export.fmu.varied import varied

    fmi, text = task["fmi"], task["case"]
    case = read_case(toml_tables(text, "case"))
    options = {option.path: option for option in varied(task["vary"], case)}

    def changed(values: Mapping[str, float]) -> BearingModel | MachineModel:
        return ready(apply_overrides(case, (options[path].change(value) for path, value in values.items())))

    frozen = freeze(ready(case, (), announce), task["couple"], announce, tuple(options.values()), changed)
    kind = "rolling bearing" if frozen.machine is None else "shaft in rolling bearings"
    seen = variables(frozen)
    parts = library_parts(frozen, seen, task["platforms"])
    about = About(
        name=frozen.name,
        text=f"{kind}, coupled by {task['couple']}, started at its equilibrium; {_STAYS}",
        identifier="bearing_" + re.sub(r"\W", "_", frozen.name, flags=re.ASCII),
        token=parts.token,
        tool=f"lambda-bearing {version('lambda-bearing')}",
        end=frozen.duration or _END,
        step=_STEP,
    )
    with tempfile.TemporaryDirectory(prefix="lambda-bearing-") as made:
        files = {"modelDescription.xml": description(about, seen, fmi), "resources/case.toml": text.encode()}
        names = task["platforms"]
        with ThreadPoolExecutor() as compilers:
            built = list(
                compilers.map(lambda each: build(parts, f"fmi{fmi}", Path(made), about.identifier, each), names)
            )
        for platform, library in zip(names, built, strict=True):
            files[f"binaries/{PLATFORMS[platform].folders[fmi]}/{library.name}"] = library.read_bytes()
    _zip(files, Path(task["out"]))


def _zip(parts: Mapping[str, bytes], target: Path) -> None:
    """Write an archive and move it in place.

    It has a temporary name in its folder first.
    """
    target.parent.mkdir(parents=True, exist_ok=True)
    part = target.with_name(f".{target.name}.part")
    try:
        with zipfile.ZipFile(part, "w", zipfile.ZIP_DEFLATED) as archive:
            for name, content in parts.items():
                about = zipfile.ZipInfo(name, _FIXED_TIME)
                about.external_attr = (0o755 if name.startswith("binaries/") else 0o644) << 16
                archive.writestr(about, content, zipfile.ZIP_DEFLATED)
        part.replace(target)
    finally:
        part.unlink(missing_ok=True)


def _write_apart(task: Mapping[str, Any], processor: str, announce: Callable[[str], None] | None) -> None:
    """Write an FMU in a separate process.

    Numba fixes the processor when it is imported. What the process announces is announced here.
    """
    # A named processor has its own features and no others.
    settings = {_CPU: processor, _FEATURES: ""} if processor != "native" else {}
    clean = {name: value for name, value in os.environ.items() if name not in (_CPU, _FEATURES)}
    heard, spoken = os.pipe()
    with open(heard, encoding="utf-8") as sentences, ThreadPoolExecutor() as listener:
        telling = listener.submit(_tell, sentences, announce)
        try:  # in this thread: a request to stop ends the process
            done = subprocess.run(
                [sys.executable, "-P", "-W", "ignore", "-c", _SERVING], input=json.dumps(task), stdout=spoken,
                stderr=subprocess.PIPE, text=True, env=clean | settings, check=False,
            )  # fmt: skip
        finally:
            os.close(spoken)
        telling.result()
    if done.returncode == 0:
        return
    said = done.stderr.strip() or f"the process that writes it ended with {done.returncode}"
    raise (UsageError if done.returncode == UsageError.exit_code else SolverError)(said)


def _tell(sentences: Iterable[str], announce: Callable[[str], None] | None) -> None:
    """Announce what another process says, to its end."""
    for sentence in sentences:
        if announce is not None:
            announce(sentence.rstrip())


def serve() -> None:
    """Do one task from standard input.

    It is all the work of a process; what it announces goes to standard output.
    """
    from lambda_core.domain.errors import LambdaError

    try:
        write(json.load(sys.stdin), lambda text: print(text, flush=True))
    except LambdaError as error:
        print(error, file=sys.stderr)
        raise SystemExit(error.exit_code) from None
