"""Test FMUs of shafts in rollers, and exports heard."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import Any

import pytest

from lambda_core import api
from lambda_core.domain.errors import UsageError
from lambda_core.export.fmu.unit_file import _write_apart

STEP, STEPS = 1e-4, 20  # [s]
CHANGES = ("solver.duration=0.1 s",)


@pytest.mark.full
def test_a_shaft_in_rollers_and_balls_has_the_bits_of_its_engine(
    c_compiler: tuple[str, ...], host: Any, tmp_path: Path
) -> None:
    """Run a shaft in both kinds, then push it."""
    case = Path(__file__).parents[2] / "examples" / "roller-shafts" / "motor.toml"
    file = api.export_fmu(case, CHANGES, out=tmp_path / "motor.fmu", processor="native")
    instance, engine = host.Instance(host.Unit(file, tmp_path / "unit")).ready(), api.iterate(case, CHANGES, exact=True)
    for k in range(STEPS):
        if k == STEPS // 2:
            assert instance.set("loads.belt.force_z", -2000.0) == host.OK
            engine.give("loads.belt.force_z", -2000.0)
        assert instance.step(STEP) == host.OK, instance.said
        step = engine.step_to(instance.time)
        for name, channels in step.bearings.items():
            films = channels["film_minimum"]
            expected = {
                "load": channels["load"].max(),
                "film_minimum": films[films > 0.0].min(),
                "inner_ring.z": channels["body_position"][0, 2],
                "cage.spin": channels["body_spin"][2],
                "reaction_force_z": step.reactions[name][2],
            }
            found = instance.get([f"bearings.{name}.{what}" for what in expected])
            assert dict(zip(expected, found, strict=True)) == expected, f"{name}, step {k}"
        (torque,) = instance.get(["machine.friction_torque"])
        assert torque == pytest.approx(1e-3 * step.friction_torque_Nmm, rel=1e-12)


def test_the_process_that_exports_is_heard_while_it_compiles(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Hear its sentences one by one, then its error.

    Exports for the usual processor were silent for the minutes in which they compile.
    """
    process = tmp_path / "process"
    process.write_text("#!/bin/sh\ncat > task\necho compiling one\necho compiling another\necho no disk >&2\nexit 2\n")
    process.chmod(0o755)
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr(sys, "executable", str(process))
    heard = list[str]()
    with pytest.raises(UsageError, match="no disk"):
        _write_apart({"fmi": 2}, "x86-64-v3", heard.append)
    assert heard == ["compiling one", "compiling another"]
    assert Path("task").read_text(encoding="utf-8") == '{"fmi": 2}'
