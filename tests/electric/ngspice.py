"""Write and run a network of nine balls in ngspice.

``python tests/electric/ngspice.py`` records its results anew.

Written for ngspice 39.3 (Debian 12). Capacitances change with time as charge expressions, so that charge is conserved.
All admittances are multiplied by one number, which leaves voltages as they are and suits ngspice's tolerances.
"""

from __future__ import annotations

import math
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).parents[1]))

from electric.networks import one_bearing, switching

from lambda_core.analysis.electric.circuit_integrator import Films
from lambda_core.domain.arrays import FloatArray

RECORDED = Path(__file__).with_name("ngspice_nine_balls.csv")
STOP, TURN, RISE = 1e-3, 1e-3, 5e-7  # span; in which the balls pass the load zone once; of an edge [s]
CIRCUIT = one_bearing(50e-12, 800e-12, 5e-12, brush=1e-7, coating=300e-12, bridge=2e-7)
LEAK, METAL = 2e-8, 1e-5  # conductance of a film; of the outer film of ball 4, which metal bridges [S]
_SCALE = 1e6


def nine_balls(samples: int = 4001) -> Films:
    """Return nine balls, one film bridged.

    They pass a load zone.
    """
    time = np.linspace(0.0, STOP, samples)
    phase = 2.0 * np.pi * ((np.arange(9) / 9)[None, :, None] + time[:, None, None] / TURN)
    capacitance = 40e-12 + 25e-12 * np.cos(phase) + np.array([0.0, 5e-12])
    each = np.ones_like(capacitance)
    conductance = LEAK * each
    conductance[:, 3, 1] = METAL
    return Films(time, capacitance, conductance, 0.0 * each, 0.0 * each, each, 0.0 * each)


def deck(out: Path) -> str:
    """Return the deck.

    `out` gets time, potential of the inner and of the outer ring.
    """
    points = " ".join(f"{t:.12g} {v:.12g}" for t, v in zip(*switching(STOP, rise=RISE), strict=True))
    lines = ["* nine balls between two rings", f"Vcm cm 0 PWL({points})"]
    fixed = (("cm", "u", CIRCUIT.winding), ("u", "0", CIRCUIT.rotor), ("u", "o", CIRCUIT.bearings[0].rings))
    fixed += (("o", "0", CIRCUIT.bearings[0].coating),)
    lines += [f"C{i} {a} {b} {value * _SCALE:.12g}" for i, (a, b, value) in enumerate(fixed)]
    lines += [
        f"Rbrush u 0 {1.0 / (CIRCUIT.brush * _SCALE):.12g}",
        f"Rbridge o 0 {1.0 / (CIRCUIT.bearings[0].bridge * _SCALE):.12g}",
    ]
    for ball in range(9):
        for ring, offset in (("u", 0.0), ("o", 5.0)):
            angle = f"{2.0 * math.pi * ball / 9:.15g}+{2.0 * math.pi / TURN:.15g}*time"
            value = f"({40.0 + offset}+25*cos({angle}))*{1e-12 * _SCALE:.6g}"
            lines.append(f"C{ring}{ball} {ring} b{ball} q='V({ring},b{ball})*{value}'")
            leak = METAL if (ball, ring) == (3, "o") else LEAK
            lines.append(f"R{ring}{ball} {ring} b{ball} {1.0 / (leak * _SCALE):.12g}")
    lines += [
        ".options reltol=1e-5 abstol=1e-7 vntol=1e-7 chgtol=1e-11 method=gear",
        f".tran 50n {STOP} 0 50n uic",
        ".control",
        "run",
        f"wrdata {out} v(u) v(o)",
        "quit",
        ".endc",
        ".end",
    ]
    return "\n".join(lines) + "\n"


def run() -> tuple[FloatArray, FloatArray]:
    """Return voltages by ngspice.

    Times [s] and voltages between the rings [V], away from the edges of the source.
    """
    with tempfile.TemporaryDirectory() as folder:
        path, out = Path(folder) / "deck.cir", Path(folder) / "out.txt"
        path.write_text(deck(out))
        subprocess.run(["ngspice", "-b", str(path)], check=True, capture_output=True)
        table = np.loadtxt(out)
    edges = switching(STOP, rise=RISE)[0]
    time = np.arange(2e-6, STOP, 2.5e-6)
    time = time[np.abs(time[:, None] - edges[None, :]).min(axis=1) > 2 * RISE]
    return time, np.interp(time, table[:, 0], table[:, 1] - table[:, 3])


if __name__ == "__main__":
    rows = zip(*run(), strict=True)
    RECORDED.write_text("time [s],bearing voltage [V]\n" + "".join(f"{t:.9g},{v:.9g}\n" for t, v in rows))
