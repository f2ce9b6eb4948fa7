"""Compute area, moments and shear factor of round sections."""

from __future__ import annotations

import math
from dataclasses import dataclass


@dataclass(frozen=True)
class BodyMaterial:
    """Material of an elastic body, SI."""

    youngs_modulus: float  # [Pa]
    poisson_ratio: float
    density: float  # [kg/m3]
    thermal_expansion: float = 0.0  # [1/K]
    thermal_conductivity: float = 0.0  # [W/(m K)]
    specific_heat: float = 0.0  # [J/(kg K)]

    @property
    def shear_modulus(self) -> float:
        """G = E/(2 (1 + nu)) [Pa]."""
        return self.youngs_modulus / (2.0 * (1.0 + self.poisson_ratio))


@dataclass(frozen=True)
class RoundSection:
    """A circle, hollow or not.

    Attributes
    ----------
    outside_diameter, bore : float
        [m]; a bore of 0 is a solid bar.
    material : BodyMaterial
        What it is made of.
    """

    outside_diameter: float
    bore: float
    material: BodyMaterial

    @property
    def area(self) -> float:
        """Of the cross-section [m2]."""
        return 0.25 * math.pi * (self.outside_diameter**2 - self.bore**2)

    @property
    def second_moment(self) -> float:
        """Second moment of area about a diameter [m4].

        The polar one is twice as large.
        """
        return math.pi / 64.0 * (self.outside_diameter**4 - self.bore**4)

    @property
    def shear_coefficient(self) -> float:
        """Share of the area that carries shear.

        It follows Cowper 1966, J. Appl. Mech. 33, 335, table 1.

        6 (1 + nu)(1 + m^2)^2/[(7 + 6 nu)(1 + m^2)^2 + (20 + 12 nu) m^2], m = bore over outside diameter; for m = 0 it
        is that of the circle, 6 (1 + nu)/(7 + 6 nu).
        """
        nu, square = self.material.poisson_ratio, (self.bore / self.outside_diameter) ** 2
        ring = (1.0 + square) ** 2
        return 6.0 * (1.0 + nu) * ring / ((7.0 + 6.0 * nu) * ring + (20.0 + 12.0 * nu) * square)

    @property
    def bending_stiffness(self) -> float:
        """E I [N m2]."""
        return self.material.youngs_modulus * self.second_moment

    @property
    def shear_stiffness(self) -> float:
        """Kappa G A [N]."""
        return self.shear_coefficient * self.material.shear_modulus * self.area

    @property
    def axial_stiffness(self) -> float:
        """E A [N]."""
        return self.material.youngs_modulus * self.area

    @property
    def torsional_stiffness(self) -> float:
        """G I_p [N m2]."""
        return 2.0 * self.material.shear_modulus * self.second_moment
