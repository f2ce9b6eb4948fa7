"""List hard regimes of rollers."""

from __future__ import annotations

from typing import Any

import numpy as np

from benchmarks.regime_list import Regime, Samples, ramp

_OIL = {"name": "FVA3", "temperature": "70 degC"}


def _case(designation: str, speed: str = "1500 rpm", **loads: str) -> dict[str, Any]:
    return {
        "name": designation.lower().replace(" ", "-"),
        "bearing": {"designation": f"SKF {designation}"},
        "lubricant": _OIL,
        "loads": loads,
        "operation": {"speed": speed},
    }


NU, NJ = _case("NU 208", radial="5 kN"), _case("NJ 208", radial="5 kN", axial="1 kN")
TAPERED = _case("32216", radial="6 kN", axial="6 kN")
FULL = _case("NCF 3008 CV", radial="5 kN")
NEEDLE = _case("NA 4905", radial="2 kN")


def _turned(samples: Samples) -> tuple[float, float]:
    """Return first and last inner ring speed [rad/s]."""
    return float(samples["body_spin"][0, 0]), float(samples["body_spin"][-1, 0])


def _carried(samples: Samples) -> tuple[float, float, float]:
    """Return first, smallest and last inner raceway load [N]."""
    total = samples["load"][:, :, 0].sum(axis=1)
    return float(total[0]), float(total.min()), float(total[-1])


ROLLER_REGIMES = (
    Regime(
        "NU 208 started from rest", ramp("operation.speed", "0 rpm", "1500 rpm", "2 ms", "12 ms"), 0.015,
        lambda s: bool(abs(_turned(s)[0]) < 1e-9 and _turned(s)[1] > 150.0), NU,
    ),
    Regime(
        "32216 reversed", ramp("operation.speed", "500 rpm", "-500 rpm", "2 ms", "15 ms"), 0.02,
        lambda s: bool(_turned(s)[0] > 50.0 and _turned(s)[1] < -50.0), TAPERED,
    ),
    Regime(
        "NU 208, complete separation and re-contact", ramp("loads.radial", "5 kN", "-5 kN", "2 ms", "5 ms"), 0.015,
        lambda s: bool(_carried(s)[1] < 100.0 and _carried(s)[2] > 1000.0), NU,
    ),
    Regime(
        "NJ 208, load step up", ramp("loads.radial", "1 kN", "20 kN", "2 ms", "2.1 ms"), 0.01,
        lambda s: bool(_carried(s)[2] > 5.0 * _carried(s)[0]), NJ,
    ),
    Regime(
        "32216 at 12 000 1/min", ("operation.speed=12000 rpm",), 0.005, lambda s: bool(_turned(s)[1] > 1250.0), TAPERED
    ),
    Regime(
        "full complement NCF 3008, 50 1/min", ("operation.speed=50 rpm",), 0.05,
        lambda s: bool(_turned(s)[1] > 5.0 and s["asperity_share"].max() > 0.05), FULL,
    ),
    Regime(
        "NU 208 in cold oil", ("lubricant.temperature=20 degC",), 0.01,
        lambda s: bool(np.abs(s["pocket_force"]).max() < 100.0), NU,
    ),
    Regime(
        "needles NA 4905 without load", ("loads.radial=0 N",), 0.02, lambda s: bool(_carried(s)[2] < 200.0), NEEDLE
    ),
)  # fmt: skip
