"""Define a published value with source, tolerance and its reason."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Published:
    """Published value with its tolerance.

    Within `rel` times itself or `abs`, whichever is larger.
    """

    value: float
    source: str
    reason: str  # why this tolerance
    rel: float = 0.0
    abs: float = 0.0

    def check(self, computed: float) -> None:
        """Fail with source, deviation and tolerance unless `computed` agrees."""
        allowed = max(self.rel * abs(self.value), self.abs)
        deviation = computed - self.value
        assert abs(deviation) <= allowed, (
            f"{computed:.6g} instead of {self.value:.6g} ({self.source}); "
            f"deviation {deviation:.3g}, allowed {allowed:.3g} ({self.reason})"
        )
