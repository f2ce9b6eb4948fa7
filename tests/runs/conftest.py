"""Share a resolved model and a mock engine."""

from __future__ import annotations

import sys
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING

import pytest

from lambda_core import api
from lambda_core.results.provenance import Provenance

# The fake engine is also used by scripts in processes of their own.
sys.path.insert(0, str(Path(__file__).parent))

if TYPE_CHECKING:
    from fake_engine import MakeProvenance

    from lambda_core.model.bearing_model import BearingModel


@pytest.fixture(scope="session")
def resolved() -> BearingModel:
    return api.check("6319-cp10-1500")


@pytest.fixture
def provenance(resolved: BearingModel) -> MakeProvenance:
    """Make a provenance whose solver has some settings changed."""

    def make(**solver: float) -> Provenance:
        return Provenance.alone(replace(resolved, solver=replace(resolved.solver, **solver)), {"core": "abc"})

    return make
