"""Define kernel types by role for type checkers.

A test compares them with :data:`lambda_core.domain.roles.ROLES`. A role with optional arguments has no type of its own:
its kernels name as many of these as they want.
"""

from __future__ import annotations

from typing import Any, Protocol

from lambda_core.domain.arrays import FloatArray


class NormalContactKernel(Protocol):
    """Kernel of the role normal_contact."""

    def __call__(self, delta: float, R_x: float, R_y: float, E_eff: float, par: Any, out: FloatArray) -> int: ...


class RheologyKernel(Protocol):
    """Kernel of the role rheology."""

    def __call__(self, p: FloatArray, T: FloatArray, par: Any, ln_eta: FloatArray, rho: FloatArray) -> int: ...


class FilmThicknessKernel(Protocol):
    """Kernel of the role film_thickness."""

    def __call__(
        self,
        u_mean: float,
        cos2: float,
        load: float,
        R_x: float,
        R_y: float,
        E_eff: float,
        eta0: float,
        alpha_p: float,
        par: Any,
        out: FloatArray,
    ) -> int: ...


class ThermalCorrectionKernel(Protocol):
    """Kernel of the role thermal_correction."""

    def __call__(
        self,
        u_mean: float,
        u_slide: float,
        p_max: float,
        E_eff: float,
        eta0: float,
        beta: float,
        k_oil: float,
        par: Any,
        out: FloatArray,
    ) -> int: ...


class SupplyKernel(Protocol):
    """Kernel of the role supply."""

    def __call__(
        self,
        u_mean: float,
        load: float,
        semi_a: float,
        semi_b: float,
        R_x: float,
        h_cen: float,
        h_min: float,
        par: Any,
        out: FloatArray,
    ) -> int: ...


class ContactTemperatureKernel(Protocol):
    """Kernel of the role contact_temperature."""

    def __call__(
        self,
        T_in: float,
        u_mean: float,
        h: float,
        semi_b: float,
        tau: FloatArray,
        slip: FloatArray,
        par: Any,
        T: FloatArray,
    ) -> int: ...


class TractionKernel(Protocol):
    """Kernel of the role traction."""

    def __call__(
        self,
        slip: FloatArray,
        p: FloatArray,
        T: FloatArray,
        ln_eta: FloatArray,
        h: FloatArray,
        par: Any,
        tau: FloatArray,
    ) -> int: ...


class RollingResistanceKernel(Protocol):
    """Kernel of the role rolling_resistance."""

    def __call__(
        self,
        u_mean: float,
        load: float,
        semi_a: float,
        semi_b: float,
        R_x: float,
        R_y: float,
        E_eff: float,
        eta0: float,
        alpha_p: float,
        beta: float,
        k_oil: float,
        par: Any,
        out: FloatArray,
    ) -> int: ...


class ElasticHysteresisKernel(Protocol):
    """Kernel of the role elastic_hysteresis."""

    def __call__(
        self,
        load: float,
        semi_a: float,
        semi_b: float,
        R_x: float,
        R_y: float,
        R_ball: float,
        par: Any,
        out: FloatArray,
    ) -> int: ...


class AsperityLoadKernel(Protocol):
    """Kernel of the role asperity_load."""

    def __call__(self, Lambda: float, par: Any, out: FloatArray) -> int: ...


class BoundaryFrictionKernel(Protocol):
    """Kernel of the role boundary_friction."""

    def __call__(self, slip: FloatArray, p: FloatArray, u_mean: float, par: Any, mu: FloatArray) -> int: ...


class MixingKernel(Protocol):
    """Kernel of the role mixing."""

    def __call__(
        self,
        psi: float,
        Lambda: float,
        load: float,
        p_max: float,
        semi_a: float,
        semi_b: float,
        par: Any,
        out: FloatArray,
    ) -> int: ...


class ContactStateKernel(Protocol):
    """Kernel of the role contact_state."""

    def __call__(
        self,
        t: float,
        load: float,
        semi_a: float,
        semi_b: float,
        p_max: float,
        u_mean: float,
        u_slide: float,
        spin: float,
        h: float,
        Lambda: float,
        psi: float,
        power: float,
        T_film: float,
        T_in: float,
        par: Any,
        out: FloatArray,
    ) -> int: ...


class CageContactKernel(Protocol):
    """Kernel of the role cage_contact."""

    def __call__(
        self, r: FloatArray, v_rel: FloatArray, omega_rel: FloatArray, eta0: float, par: Any, out: FloatArray
    ) -> int: ...


class FluidDragKernel(Protocol):
    """Kernel of the role fluid_drag."""

    def __call__(
        self, v_orbit: float, omega_spin: float, azimuth: float, nu: float, rho: float, par: Any, out: FloatArray
    ) -> int: ...


class PermittivityKernel(Protocol):
    """Kernel of the role permittivity."""

    def __call__(self, p: FloatArray, T: FloatArray, rho: FloatArray, par: Any, eps_r: FloatArray) -> int: ...


class CapacitanceKernel(Protocol):
    """Kernel of the role capacitance."""

    def __call__(
        self,
        C_hertz: float,
        h: float,
        semi_a: float,
        semi_b: float,
        R_x: float,
        R_y: float,
        U: float,
        G: float,
        W: float,
        eps_r0: float,
        par: Any,
        out: FloatArray,
    ) -> int: ...


class SurfaceKernel(Protocol):
    """Kernel of the role surface."""

    def __call__(self, azimuth: float, contact_angle: float, par: Any, out: FloatArray) -> int: ...


class ForceElementKernel(Protocol):
    """Kernel of the role force_element."""

    def __call__(
        self,
        t: float,
        place: FloatArray,
        tilt: FloatArray,
        v_rel: FloatArray,
        omega_rel: FloatArray,
        par: Any,
        out: FloatArray,
    ) -> int: ...


class TimeFunctionKernel(Protocol):
    """Kernel of the role time_function."""

    def __call__(self, t: float, par: Any, out: FloatArray) -> int: ...


class BreakdownKernel(Protocol):
    """Kernel of the role breakdown."""

    def __call__(
        self, h: float, h_min: float, sigma: float, area: float, u_1: float, u_2: float, par: Any, out: FloatArray
    ) -> int: ...


class DischargeKernel(Protocol):
    """Kernel of the role discharge."""

    def __call__(self, V: float, h: float, area: float, par: Any, out: FloatArray) -> int: ...
