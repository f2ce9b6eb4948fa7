"""Solve a thermal network.

Nodes that store heat, conductances between them, prescribed temperatures.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from lambda_core.domain.arrays import FloatArray


@dataclass(frozen=True)
class Network:
    """Linear thermal network.

    It solves C_i dT_i/dt = q_i + sum_j G_ij (T_j - T_i).

    Attributes
    ----------
    names : tuple of str
        Of the nodes.
    conductance : float64[:, :], shape (n, n)
        G, symmetric with a zero diagonal [W/K].
    heat : float64[:], shape (n,)
        q, put in at each node [W].
    held : float64[:], shape (n,)
        Temperatures of the nodes that are held [K], NaN at those that are found.
    """

    names: tuple[str, ...]
    conductance: FloatArray
    heat: FloatArray
    held: FloatArray

    @cached_property
    def free(self) -> NDArray[np.bool_]:
        """Connected nodes whose temperature is unknown."""
        joined: NDArray[np.bool_] = np.isnan(self.held) & (self.conductance.sum(axis=1) > 0.0)
        return joined

    @cached_property
    def laplacian(self) -> FloatArray:
        """Matrix L of the conductances.

        It has (L T)_i = sum_j G_ij (T_i - T_j) and shape (n, n).
        """
        found: FloatArray = np.diag(self.conductance.sum(axis=1)) - self.conductance
        return found

    def flows(self, temperatures: FloatArray) -> FloatArray:
        """Return the heat flows between all nodes [W].

        An entry is the flow from node i to node j; the array has shape (n, n).
        """
        found: FloatArray = self.conductance * (temperatures[:, None] - temperatures[None, :])
        return found

    def storing(self, temperatures: FloatArray) -> FloatArray:
        """Return the heat that stays in each node [W].

        It is q - L T, shape (n,), and at a held node minus what leaves there.
        """
        found: FloatArray = self.heat - self.laplacian @ temperatures
        return found

    def steady(self) -> FloatArray:
        """Return the steady temperatures [K].

        Every free node passes on what it gets; shape (n,).

        A node that nothing is joined to has the temperature NaN.

        Raises
        ------
        numpy.linalg.LinAlgError
            When no way leads from a free node to a held one.
        """
        free, held = self.free, ~np.isnan(self.held)
        temperatures = self.held.copy()
        pull = self.heat[free] - self.laplacian[np.ix_(free, held)] @ self.held[held]
        temperatures[free] = np.linalg.solve(self.laplacian[np.ix_(free, free)], pull)
        return temperatures

    def leaving(self, temperatures: FloatArray) -> float:
        """Return the heat that leaves at held nodes [W].

        What is put in at them is included.
        """
        held = ~np.isnan(self.held)
        return float(self.heat[held].sum() - (self.laplacian[held] @ np.nan_to_num(temperatures)).sum())
