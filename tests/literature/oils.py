"""Provide oils with published constants."""

from __future__ import annotations

from typing import Any

# Wingertszahn et al. 2023, Lubricants 11, 369, Table A1 (measured): mineral oil FVA3, ISO VG 100.
FVA3: dict[str, Any] = {
    "vogel_k": 0.062,
    "vogel_b": 1021.7,
    "vogel_c": 101.5517,
    "dicke_a1": 327.7918,
    "dicke_a2": 2.9862,
    "dicke_b1": 4.419e-3,
    "dicke_b2": 3.0115e-4,
    "density_15": "887.6 kg/m3",
    "density_slope": -0.6,
}

# Syla et al. 2026, Lubricants 14, 154, Table 5: a mineral oil.
_DENSITY: dict[str, Any] = {
    "rho_s": 1073.465942,
    "alpha_s": 0.0005911,
    "a1": 0.08970567,
    "a2": 6348.426753,
    "a3": -27.52010404,
    "a4": 0.04547532,
    "a5": -0.00002769,
}
BODE_VISCOSITY = _DENSITY | {
    "visc_a1": 0.03380703,
    "visc_a2": 2.82632938,
    "visc_a3": 785.285992,
    "visc_a4": 0.00162619,
}
BODE_PERMITTIVITY = _DENSITY | {"k1": 0.00379557, "k2": 0.00258151, "k3": 0.00130612}

# Class values of a mineral oil ISO VG 100, VI about 95; alpha_p at 40 degC after Gold.
VG100: dict[str, Any] = {
    "kinematic_viscosity_40": "100 mm2/s",
    "kinematic_viscosity_100": "11.2 mm2/s",
    "density_15": "885 kg/m3",
    "density_slope": -0.57,
    "alpha_p": "18.78 1/GPa",
}

# What models without defaults need: role/name -> parameters.
REQUIRED: dict[str, dict[str, Any]] = {
    "supply/inlet-distance": {"distance": 2.0},
    "supply/oil-layer": {"layer": "5 um"},
    "supply/side-flow": {"layer": "5 um", "time": "1 h"},
    "discharge/arc-voltage": {"voltage": "3 V"},
    "rheology/vogel-dicke": FVA3,
    "rheology/bode": BODE_VISCOSITY,
    "rheology/roelands": VG100,
    "rheology/barus-limited": VG100,
    "permittivity/bode": BODE_PERMITTIVITY,
    "elastic_hysteresis/scheuermann": {"coefficient": 1e-6, "exponent": 1.3},
}
