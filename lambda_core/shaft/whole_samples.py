"""Samples of a shaft in motion, between the engine and the files."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from lambda_core.domain.arrays import FloatArray


@dataclass(frozen=True)
class WholeSamples:
    """What was sampled: of the whole, and of every bearing as a run of it alone writes it."""

    whole: dict[str, FloatArray]
    each: list[dict[str, FloatArray]]

    @classmethod
    def joined(cls, blocks: list[WholeSamples]) -> WholeSamples:
        """Return blocks, one after the other in time, as one."""
        whole = _joined([block.whole for block in blocks])
        return cls(whole, [_joined([block.each[i] for block in blocks]) for i in range(len(blocks[0].each))])


def _joined(blocks: list[dict[str, FloatArray]]) -> dict[str, FloatArray]:
    return {name: np.concatenate([block[name] for block in blocks]) for name in blocks[0]}
