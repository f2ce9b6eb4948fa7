"""Compute inextensional bending of rings and cages.

The Fourier modes are n >= 2, in a bedding or free. Units are SI.

Radial displacement w = sum of c_n cos(n th) + s_n sin(n th), and a tangential one that keeps the length,
v = -integral of w dth (Love 1927, Theory of Elasticity, art. 293; Timoshenko, Vibration Problems in Engineering).
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from lambda_core.domain.arrays import FloatArray

_PLACES = 180  # on half a ring, at which its diameters are compared
MOST_ORDERS = 12  # waves round a ring that anybody needs: beyond, a ring of a bearing is no thin one any more


@dataclass(frozen=True)
class ElasticRing:
    """A thin ring of one section.

    Attributes
    ----------
    radius : float
        Of the line through the sections' centres [m].
    area, second_moment : float
        Of the section [m2], [m4]; about the axis along the bearing's axis.
    youngs_modulus, density : float
        [Pa], [kg/m3]
    bedding : float
        Radial stiffness of what the ring lies in, per length of its circumference (Winkler) [N/m2].
    """

    radius: float
    area: float
    second_moment: float
    youngs_modulus: float
    density: float
    bedding: float = 0.0

    @staticmethod
    def rectangle(
        radius: float, height: float, width: float, youngs_modulus: float, density: float, *, housing: float = 0.0
    ) -> ElasticRing:
        """Return a ring of a rectangular section in a housing.

        Parameters
        ----------
        radius : float
            Of the line through the sections' centres [m].
        height, width : float
            Of the section, radially and axially [m].
        youngs_modulus, density : float
            [Pa], [kg/m3]
        housing : float
            Force over the displacement of the undeformed ring in its bedding: pi R k [N/m].
        """
        area, moment = height * width, width * height**3 / 12.0
        return ElasticRing(radius, area, moment, youngs_modulus, density, housing / (math.pi * radius))

    def stiffness(self, order: int) -> float:
        """Return the stiffness of a wave [N/m].

        It is k_n = pi E I (n^2 - 1)^2/R^3 + pi R k of the amplitude of cos(n th) or sin(n th).
        """
        bending = math.pi * self.youngs_modulus * self.second_moment * (order**2 - 1) ** 2 / self.radius**3
        return bending + math.pi * self.radius * self.bedding

    def mass(self, order: int) -> float:
        """Return the mass of a wave [kg].

        It is m_n = pi rho A R (1 + 1/n^2), radial and tangential motion together.
        """
        return math.pi * self.density * self.area * self.radius * (1.0 + 1.0 / order**2)

    def frequency(self, order: int) -> float:
        """Return the natural angular frequency of waves [rad/s].

        The pattern has `order` waves.

        Free: n (n^2 - 1)/sqrt(n^2 + 1) sqrt(E I/(rho A R^4)) (Hoppe 1871; Love 1927, art. 293).
        """
        return math.sqrt(self.stiffness(order) / self.mass(order))

    def flexibility(self, angles: FloatArray, orders: int = 10) -> FloatArray:
        """Return the flexibility of a ring [m/N].

        It is the radial displacement outwards under unit radial forces at the same places, shape (m, m).

        Bending alone: translation (n = 1) is the rigid body's. Forces are to be in balance, as far as no bedding holds.

        Parameters
        ----------
        angles : float64[:], shape (m,)
            Azimuths [rad].
        orders : int
            Highest number of waves.
        """
        apart = angles[:, None] - angles[None, :]
        waves = range(2, orders + 1)
        return np.asarray(sum(np.cos(n * apart) / self.stiffness(n) for n in waves), dtype=float)

    def whirl_frequencies(self, order: int, spin: float) -> tuple[float, float]:
        """Return both whirl frequencies of a wave [rad/s].

        They are against and with the spin, in the turning ring's frame.

        Coriolis forces couple both amplitudes: m_n (c'' + ...) with the gyroscopic term 4 spin n/(n^2 + 1), so that
        w = -+ 2 n spin/(n^2 + 1) + sqrt(w_n^2 + (2 n spin/(n^2 + 1))^2); the inward pull of rotation left out. The
        pattern lags behind the ring by 2/(n^2 + 1) of its speed (Bryan 1890, Proc. Camb. Phil. Soc. 7, 101).
        """
        half = 2.0 * order * spin / (order**2 + 1)
        root = math.sqrt(self.frequency(order) ** 2 + half**2)
        return root + half, root - half


def shape(amplitudes: FloatArray, azimuths: FloatArray) -> FloatArray:
    """Return the radial displacement of a ring, outwards [m].

    Parameters
    ----------
    amplitudes : float64[:, :], shape (orders, 2)
        Of cosine and sine of 2, 3, ... waves [m].
    azimuths : float64[:], shape (m,)
        In the ring's frame [rad].
    """
    angles = np.arange(2, 2 + len(amplitudes))[:, None] * azimuths[None, :]
    return np.asarray(amplitudes[:, 0] @ np.cos(angles) + amplitudes[:, 1] @ np.sin(angles), dtype=float)


def ovality(amplitudes: FloatArray) -> FloatArray:
    """Return the largest less the smallest diameter [m].

    Odd numbers of waves leave diameters as they are.

    Parameters
    ----------
    amplitudes : float64[..., :, :], shape (..., orders, 2)
        Of cosine and sine of 2, 3, ... waves [m].
    """
    counts = np.arange(2, 2 + amplitudes.shape[-2], 2)
    angles = counts[:, None] * np.linspace(0.0, np.pi, _PLACES, endpoint=False)
    even = amplitudes[..., ::2, :]
    return np.asarray(2.0 * np.ptp(even[..., 0] @ np.cos(angles) + even[..., 1] @ np.sin(angles), axis=-1))


@dataclass(frozen=True)
class RingWaves:
    """Modelled waves of an elastic ring or cage.

    The orders are 2 to `orders`, with modal damping.

    Attributes
    ----------
    ring : ElasticRing
        The ring in its bedding.
    orders : int
        Highest number of waves round the ring.
    damping_ratio : float
        Of every wave, over critical [-].
    """

    ring: ElasticRing
    orders: int
    damping_ratio: float

    @property
    def counts(self) -> range:
        """Numbers of waves round the ring, rising."""
        return range(2, self.orders + 1)

    def damping(self, order: int) -> float:
        """Return 2 zeta m_n w_n of an amplitude [N s/m]."""
        return 2.0 * self.damping_ratio * self.ring.mass(order) * self.ring.frequency(order)

    def coupling(self, order: int) -> float:
        """Return the Coriolis coefficient of a wave [kg].

        It is 4 n/(n^2 + 1) m_n, a force on one amplitude over the other's rate and the ring's spin.
        """
        return 4.0 * order / (order**2 + 1) * self.ring.mass(order)
