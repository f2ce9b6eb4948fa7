"""Call the model of a fit and remember its answers."""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np

from lambda_core.domain.arrays import FloatArray

Model = Callable[[FloatArray], FloatArray]
_UPDATED = 0.3  # of a change, by which an updated Jacobian may miss it before it is computed anew


class ModelCalls:
    """Model that remembers its answers.

    It also keeps the best point so far.

    Parameters
    ----------
    model, jacobian : callable
        Predicted values and their derivatives by the parameters; central differences without the latter.
    step : float64[:], shape (p,)
        Of these differences.
    """

    def __init__(self, model: Model, jacobian: Model | None, step: FloatArray) -> None:
        self._model, self._jacobian, self._step = model, jacobian, step
        self._values: dict[bytes, FloatArray] = {}
        self._slopes: dict[bytes, FloatArray] = {}
        self._last: tuple[FloatArray, FloatArray] | None = None
        self.evaluations = 0
        self.best: tuple[float, FloatArray] = (math.inf, np.zeros(0))

    def values(self, point: FloatArray) -> FloatArray:
        """Return the predicted values at a point."""
        key = point.tobytes()
        if key not in self._values:
            self.evaluations += 1
            self._values[key] = np.asarray(self._model(point), dtype=np.float64)
        return self._values[key]

    def knows(self, point: FloatArray) -> bool:
        """Tell whether the values at a point are known."""
        return point.tobytes() in self._values

    def slopes(self, point: FloatArray) -> FloatArray:
        """Return the derivatives at a point."""
        key = point.tobytes()
        if key not in self._slopes:
            self._slopes[key] = self._computed(point)
            self._last = (point, self._slopes[key])
        return self._slopes[key]

    def near_slopes(self, point: FloatArray, spread: FloatArray) -> FloatArray:
        """Return the derivatives by an update.

        It updates the last ones at a point (Broyden 1965, Math. Comp. 19, 577).
        """
        if self._last is None or point.tobytes() in self._slopes:
            return self.slopes(point)
        before, slopes = self._last
        step = (point - before) / spread
        change = self.values(point) - self.values(before)
        missed = change - (slopes * spread) @ step
        if np.linalg.norm(missed) > _UPDATED * np.linalg.norm(change):
            return self.slopes(point)
        updated = slopes + np.outer(missed, step / (step @ step)) / spread
        self._last = (point, updated)
        return updated

    def last_slopes(self, point: FloatArray, count: int) -> FloatArray:
        """Return derivatives without a call of the model.

        They are those at a point, or the last ones there are.
        """
        found = self._slopes.get(point.tobytes())
        if found is None:
            found = next(reversed(self._slopes.values()), np.zeros((count, point.size)))
        return found

    def _computed(self, point: FloatArray) -> FloatArray:
        if self._jacobian is not None:
            return np.asarray(self._jacobian(point), dtype=np.float64)
        columns = []
        for index, step in enumerate(self._step):
            up, down = point.copy(), point.copy()
            up[index], down[index] = point[index] + step, point[index] - step
            self.evaluations += 2
            columns.append((np.asarray(self._model(up)) - np.asarray(self._model(down))) / (up[index] - down[index]))
        return np.column_stack(columns)
