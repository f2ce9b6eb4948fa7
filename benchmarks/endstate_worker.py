"""Print hashes of results as JSON.

Runs in the interpreter of the version under test.

Uses nothing but ``lambda_core.api`` and h5py, so that it also runs with versions whose packages are arranged
differently.
"""

from __future__ import annotations

import hashlib
import importlib.util
import json
import sys
import tempfile
from pathlib import Path
from typing import Any

import h5py
import numpy as np

from lambda_core import api


def end_state(case: str, overrides: dict[str, Any], duration: float) -> dict[str, str]:
    """Return the hash of every channel.

    Of `case` at the first step past `duration` [s].
    """
    changed = api.case(case).with_(**overrides, solver={"duration": f"{duration!r} s"})
    last = None
    for step in api.iterate(changed):
        last = step
    if last is None:
        raise SystemExit(f"{case}: no step was taken")
    found = {name: _hash(values) for name, values in last.channels.items()}
    return found | {"time": _hash(last.time_s)}


def bearing_case(entry: dict[str, Any]) -> Any:
    """Return the case of an entry.

    A built-in one with changes, or one that is complete.
    """
    if "from" in entry:
        return api.case(entry["from"]).with_(**entry.get("changes", {}))
    return {"name": "endstate"} | entry["case"]


def bearing_run(entry: dict[str, Any], folder: Path) -> dict[str, str]:
    """Return the hashes of one bearing's run.

    Of every channel and table; resumed where `entry` says so.
    """
    path = folder / "run.h5"
    api.run(bearing_case(entry), [f"solver.duration={entry.get('stop', entry['duration'])}"], out=path)
    if "stop" in entry:
        api.resume(path, [f"solver.duration={entry['duration']}"])
    return _result(api.result(path))


def shaft_run(entry: dict[str, Any], folder: Path) -> dict[str, str]:
    """Return the hashes of a machine's run.

    Of every channel and table of the machine and of each of its bearings.
    """
    case = {"name": "endstate"} | entry["case"]
    case = case if has_one_notation() else older_notation(case)
    if hasattr(api, "shaft_run"):  # a version whose machines write a folder
        return _folder_run(case, entry, folder / "run")
    path = folder / "run.h5"
    api.run(case, [f"solver.duration={entry.get('stop', entry['duration'])}"], out=path)
    if "stop" in entry:
        api.resume(path, [f"solver.duration={entry['duration']}"])
    result = api.result(path)
    found = {}
    for bearing, own in result.bearings.items():
        found |= {f"{bearing}/{name}": value for name, value in _result(own).items()}
    machine = result.of_machine()
    found |= {f"shaft/{channel.name}": _hash(machine[channel.name]) for channel in machine.channels}
    seats = result.machine["bearings"]
    found["shaft/bearing_positions"] = _hash([seats[name]["position"] for name in result.bearings])
    return found | {"shaft/lump_positions": _hash(machine.labels("lump"))}


def _folder_run(case: dict[str, Any], entry: dict[str, Any], out: Path) -> dict[str, str]:
    """Return the hashes of a folder's run.

    An old version, whose machines write a folder.
    """
    stop, end = (_seconds(entry[name]) if name in entry else None for name in ("stop", "duration"))
    api.shaft_run(case, out=out, duration=stop or end)
    if stop:
        api.shaft_resume(out, duration=end)
    found = {}
    for path in sorted(out.glob("*.h5")):
        if path.name != "shaft.h5":
            found |= {f"{path.stem}/{name}": value for name, value in _result(api.result(path)).items()}
    with h5py.File(out / "shaft.h5") as file:
        for name, values in file.items():
            if isinstance(values, h5py.Dataset) and values.dtype.kind == "f":
                found[f"shaft/{name}"] = _hash(values[:])
    return found


def has_one_notation() -> bool:
    """Tell whether this version writes every degree of freedom alike."""
    return importlib.util.find_spec("lambda_core.case.holding") is not None


def older_notation(case: dict[str, Any]) -> dict[str, Any]:
    """Return a case in the old notation.

    Of a shaft: positions, markers, springs, motions of locked seats.
    """
    found: dict[str, Any] = json.loads(json.dumps(case))
    found |= {"springs": found.pop("connections")} if "connections" in found else {}
    for table in ("bearings", "gears", "discs", "loads", "springs"):
        for part in found.get(table, {}).values():
            at = part.pop("at")
            part["marker" if at in found.get("markers", {}) else "position"] = at
            for dof, held in list(part.get("support", {}).items()):
                if isinstance(held, dict):
                    part["support"] |= {dof: "locked", f"motion_{dof}": held["motion"]}
    return found


def _seconds(text: str) -> float:
    number, unit = text.split()
    return float(number) * {"s": 1.0, "ms": 1e-3}[unit]


def _result(result: Any) -> dict[str, str]:
    """Return the hash of a result.

    All samples of every channel, the integrals and the circuit's tables.
    """
    found = {channel.name: _hash(result[channel.name]) for channel in result.channels}
    found |= {"integrals": _hash(result.integrals()), "revolutions": _hash(result.revolutions())}
    for table in ("circuit", "discharges"):
        found |= {f"{table}.{name}": _hash(values) for name, values in getattr(result, table)().items()}
    return found


def _hash(values: Any) -> str:
    return hashlib.sha256(np.ascontiguousarray(values, dtype=np.float64).tobytes()).hexdigest()[:16]


def answer(question: dict[str, Any]) -> dict[str, dict[str, str]]:
    """Return channel -> hash of every case that `question` names."""
    states = {name: end_state(name, question["overrides"], question["duration"]) for name in question["cases"]}
    for kind, run in (("bearings", bearing_run), ("shafts", shaft_run)):
        for name, entry in question[kind].items():
            with tempfile.TemporaryDirectory() as folder:
                states[name] = run(entry, Path(folder))
    return states


if __name__ == "__main__":
    json.dump(answer(json.load(sys.stdin)), sys.stdout)
