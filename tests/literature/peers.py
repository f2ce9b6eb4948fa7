"""Provide frozen numbers of other programs."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Peer:
    """Static load case of a deep-groove bearing.

    C = 23.4 kN, grooves 0.52 and 0.53 D_w, E = 210 GPa.
    """

    geometry: tuple[int, float, float]  # Z, D_w, D_pw [mm]
    clearance: float  # diametral [um]
    loads: tuple[float, float, float]  # F_r, F_a [N], M [N m]
    displacement: tuple[float | None, float | None, float | None]  # radial, axial [um], tilt [mrad]
    life: float | None  # L_10r [1e6 revolutions]
    source: str = "MASTA, after the test script of the public repository minzhun/ISO16281"


_BEARING = (7, 11.5, 43.5)

MASTA = {
    "radial": Peer(_BEARING, 0.0, (1000.0, 0.0, 0.0), (15.1101, None, None), 13163.019),
    "axial": Peer(_BEARING, 0.0, (0.0, 1000.0, 0.0), (None, 133.5381, None), 2222.7318),
    "radial, clearance": Peer(_BEARING, 10.0, (1000.0, 0.0, 0.0), (21.223, None, None), 10795.7948),
    "axial, clearance": Peer(_BEARING, 10.0, (0.0, 1000.0, 0.0), (None, 149.1717, None), 3115.8781),
    "combined": Peer(_BEARING, 10.0, (1000.0, 1000.0, 0.0), (19.5923, 146.4603, 2.6872), 1630.5367),
    "moment": Peer(_BEARING, 0.0, (0.0, 0.0, 1.0), (None, None, 3.6957), None),
}
