"""Build one bearing as FMUs once per session."""

from __future__ import annotations

import importlib.util
import platform
import sys
from collections.abc import Callable
from pathlib import Path
from types import ModuleType
from typing import Any

import pytest

from lambda_core import api
from lambda_core.domain.errors import UsageError

HERE = Path(__file__).parent
CASE, CHANGES = "6208-axial-1300", ("solver.duration=0.2 s",)
CIRCUIT_OF_SHAFT = ("electric.seed=3", "electric.bearings.right.insulation=2 nF")  # in the FMU of the shaft
CIRCUIT = ("electric.seed=3", "electric.grounding.insulation=2 nF")  # in the FMU of version 3 by force
VARIED = ("lubricant.temperature=30..60 degC", "bearing.clearance=9..19 um")  # in the FMU of version 2 by force


@pytest.fixture(scope="session")
def host() -> ModuleType:
    """Return the module host.

    It is in this folder, which is no package.
    """
    place = importlib.util.spec_from_file_location("fmu_host", HERE / "host.py")
    assert place is not None
    assert place.loader is not None
    module = importlib.util.module_from_spec(place)
    sys.modules["fmu_host"] = module
    place.loader.exec_module(module)
    return module


@pytest.fixture(scope="session")
def c_compiler() -> tuple[str, ...]:
    """Return the C compiler's command.

    Tests that need one are skipped where there is none.
    """
    from lambda_core.export.fmu.library import compiler

    if (platform.system(), platform.machine()) != ("Linux", "x86_64"):
        pytest.skip("FMUs are built on Linux x86-64 only")
    try:
        return compiler()
    except UsageError as error:
        pytest.skip(str(error))


@pytest.fixture(scope="session")
def exported(
    c_compiler: tuple[str, ...], once: Callable[[str, Callable[[Path], object]], Path]
) -> Callable[[int, str], Path]:
    """Return a function that exports an FMU.

    Of a version and a coupling.
    """

    def export(fmi: int, couple: str) -> Path:
        vary = VARIED if (fmi, couple) == (2, "force") else ()
        changes = CHANGES + (CIRCUIT if (fmi, couple) == (3, "force") else ())
        name = f"{couple}{fmi}"

        def fill(folder: Path) -> None:
            out = folder / f"{name}.fmu"
            api.export_fmu(CASE, changes, out=out, fmi=fmi, couple=couple, vary=vary, processor="native")  # type: ignore[arg-type]

        return once(f"fmu-{name}", fill) / f"{name}.fmu"

    return export


@pytest.fixture(scope="session")
def shaft(once: Callable[[str, Callable[[Path], object]], Path]) -> Path:
    """Return the case of a geared shaft.

    It has two bearings.
    """

    def fill(folder: Path) -> None:
        api.init_case("box", template="geared-shaft", path=folder / "box.toml")

    return once("fmu-shaft-case", fill) / "box.toml"


@pytest.fixture(scope="session")
def machine_unit_file(
    c_compiler: tuple[str, ...], shaft: Path, once: Callable[[str, Callable[[Path], object]], Path]
) -> Path:
    """Return the FMU of the shaft.

    With an option that varies and a circuit.
    """

    def fill(folder: Path) -> None:
        vary = ("lubricant.temperature=60..80 degC",)
        changes = ("solver.duration=0.1 s", *CIRCUIT_OF_SHAFT)
        api.export_fmu(shaft, changes, out=folder / "box.fmu", fmi=2, vary=vary, processor="native")

    return once("fmu-shaft", fill) / "box.fmu"


@pytest.fixture(scope="session")
def machine_unit(host: ModuleType, machine_unit_file: Path, tmp_path_factory: pytest.TempPathFactory) -> Any:
    """Return the FMU of the shaft, unpacked."""
    return host.Unit(machine_unit_file, tmp_path_factory.mktemp("shaft-unit"))
