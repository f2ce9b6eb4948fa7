"""Draw live traces of a run."""

from __future__ import annotations

from collections.abc import Sequence

from lambda_core.api import Progress
from lambda_gui.plots import Plot, padded

_LEGEND = 12  # lines that a plot needs for a legend
Points = Sequence[tuple[float, float]]


class Trace(Plot):
    """Drawing of a run's messages.

    It is drawn again for every new size and theme.
    """

    _history: Sequence[Progress] = ()

    def on_mount(self) -> None:
        """Draw in the colours of each new theme."""
        super().on_mount()
        self.app.theme_changed_signal.subscribe(self, lambda _: self._fill())

    def on_resize(self) -> None:
        """Draw for the new size."""
        self._fill()

    def follow(self, history: Sequence[Progress]) -> None:
        """Take what the run has said."""
        self._history = history
        self._fill()

    def _fill(self) -> None:
        if self._history and self.size.width > 10 and self.size.height > 4:
            self.draw(self._history)
            self.refresh()

    def draw(self, history: Sequence[Progress]) -> None:
        """Draw."""
        raise NotImplementedError

    def line(self, points: Points, colour: str, label: str = "") -> None:
        """Draw a line through points."""
        if points:
            x, y = zip(*points, strict=True)
            self.plt.plot(list(x), list(y), color=self.colour(colour), marker="braille", label=label or None)

    def axes(self, history: Sequence[Progress], low: float, high: float) -> None:
        """Scale both axes.

        x runs to the end of the run.
        """
        self.ticks(low, high, "y", max(2, self.size.height // 4))
        last = history[-1]
        end = max(last.cage_revolutions_wanted, last.cage_revolutions, 1e-6)
        self.ticks(0.0, end, "x", max(2, self.size.width // 12))
        self.name_x("cage revolutions")


class TorqueTrace(Trace):
    """Friction torque with mean and band.

    The present value, its running mean, and the band of 95 % confidence.
    """

    def draw(self, history: Sequence[Progress]) -> None:
        """Draw."""
        self.clear("friction torque [N mm]")
        now = [
            (p.cage_revolutions, p.friction_torque_now_Nmm) for p in history if p.friction_torque_now_Nmm is not None
        ]
        mean = [(p.cage_revolutions, p.friction_torque_Nmm) for p in history if p.friction_torque_Nmm is not None]
        edges: list[list[tuple[float, float]]] = [[], []]
        for p in history:
            if p.friction_torque_ci_Nmm is not None and p.friction_torque_Nmm is not None:
                for edge, sign in zip(edges, (-1.0, 1.0), strict=True):
                    edge.append((p.cage_revolutions, p.friction_torque_Nmm + sign * p.friction_torque_ci_Nmm))
        self.line(now, "secondary", "now")
        self.line(edges[0], "accent", "95 %")
        self.line(edges[1], "accent")
        self.line(mean, "primary", "mean")  # last: a narrow band must not hide it
        values = [y for points in (now, mean, *edges) for _, y in points]
        if values:
            self.axes(history, *padded(min(values), max(values), 0.02 * abs(values[-1])))


class CageTrace(Trace):
    """Cage speed over inner ring speed.

    It shows its value without slip, too.
    """

    def draw(self, history: Sequence[Progress]) -> None:
        """Draw."""
        is_low = self.size.height < _LEGEND  # its legend would hide the lines
        self.clear("cage / inner ring, grey: epicyclic" if is_low else "cage speed / inner ring speed")
        points = [(p.cage_revolutions, p.cage_speed_ratio) for p in history if p.cage_speed_ratio is not None]
        reference = [(p.cage_revolutions, p.epicyclic_ratio) for p in history if p.epicyclic_ratio is not None]
        self.line(reference, "secondary", "" if is_low else "epicyclic")
        self.line(points, "success", "" if is_low else "cage")
        ratios = [y for _, y in (*points, *reference)]
        if ratios:
            self.axes(history, *padded(min(ratios), max(ratios), 0.004))


class LoadTrace(Trace):
    """The load of each element on the inner ring now."""

    def draw(self, history: Sequence[Progress]) -> None:
        """Draw."""
        self.clear("loads on the inner ring now [N]")
        loads = list(history[-1].inner_loads_N)
        if not loads:
            return
        numbers = [float(number) for number in range(1, len(loads) + 1)]
        self.plt.bar(numbers, loads, color=self.colour("accent"), marker="sd", width=0.6)
        self.plt.xticks(numbers, [f"{number:.0f}" for number in numbers])
        self.name_x("rolling element")
        self.ticks(0.0, 1.05 * max(*loads, 1.0), "y", max(2, self.size.height // 4))
