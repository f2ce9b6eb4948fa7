"""The command palette finds every option of the case by its name or its help."""

from __future__ import annotations

from functools import partial

from textual.command import DiscoveryHit, Hit, Hits, Provider

from lambda_core.schema.case import Case
from lambda_core.schema.problems import field_at, option_paths
from lambda_gui.builder import BuilderScreen

_LINE = 70  # characters that fit under a hit on a narrow screen


def _in_one_line(text: str) -> str:
    return text if len(text) <= _LINE else f"{text[: _LINE - 1].rstrip()}…"


class OptionSearch(Provider):
    """Go to an option."""

    async def search(self, query: str) -> Hits:
        """Yield the options that match."""
        if not isinstance(self.screen, BuilderScreen):
            return
        matcher = self.matcher(query)
        for path in option_paths(Case):
            info = field_at(Case, path)
            about = info.description if info is not None else ""
            score = max(matcher.match(path), matcher.match(path.replace("_", " ")), 0.8 * matcher.match(about or ""))
            if score > 0.0 and self.screen.has_option(path):
                go = partial(self.screen.go_to, tuple(path.split(".")))
                yield Hit(score, matcher.highlight(path), go, help=_in_one_line(about or ""))

    async def discover(self) -> Hits:
        """Yield the options that are changed most often."""
        if not isinstance(self.screen, BuilderScreen):
            return
        for path in ("loads.radial", "loads.axial", "operation.speed", "lubricant.temperature"):
            info = field_at(Case, path)
            go = partial(self.screen.go_to, tuple(path.split(".")))
            yield DiscoveryHit(path, go, help=info.description if info is not None else "")
