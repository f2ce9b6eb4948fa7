"""List every option of the case in the command palette."""

from __future__ import annotations

import re
from functools import partial

from textual.command import DiscoveryHit, Hit, Hits, Provider

from lambda_gui.builder import BuilderScreen
from lambda_gui.nodes import told

# The options that are changed most often; where words fit them as well as others they come first.
_USUAL = ("loads.radial", "loads.axial", "operation.speed", "lubricant.temperature", "shaft.drive")
_AHEAD = 1.5
_LINE = 70  # characters that fit under a hit on a narrow screen


def gist(about: str) -> str:
    """Return the beginning of a description.

    It ends before the first aside: one line under a hit.
    """
    first = re.split(r"[;:(]", about, maxsplit=1)[0].strip()
    return first if len(first) <= _LINE else first.split(",")[0]


class OptionSearch(Provider):
    """Go to an option."""

    _options: list[tuple[str, str, str]] = []  # noqa: RUF012 - path, path in words, what it is; found at each opening

    async def startup(self) -> None:
        """Find the options that stand on some node."""
        if isinstance(self.screen, BuilderScreen):
            root = self.screen.draft.root
            self._options = [(path, path.replace("_", " "), told(root, path)) for path in self.screen.options()]

    async def search(self, query: str) -> Hits:
        """Yield the options that match."""
        if not isinstance(self.screen, BuilderScreen):
            return
        matcher = self.matcher(query)
        for path, spoken, about in self._options:
            score = max(matcher.match(path), matcher.match(spoken), 0.8 * matcher.match(about))
            if score > 0.0:
                score *= _AHEAD if path in _USUAL else 1.0
                go = partial(self.screen.go_to, tuple(path.split(".")))
                yield Hit(score, matcher.highlight(path), go, help=gist(about))

    async def discover(self) -> Hits:
        """Yield the options that are changed most often."""
        if not isinstance(self.screen, BuilderScreen):
            return
        for path in _USUAL:
            if words := told(self.screen.draft.root, path):
                go = partial(self.screen.go_to, tuple(path.split(".")))
                yield DiscoveryHit(path, go, help=gist(words))
