"""Test that every oil has the parameters of its laws."""

from __future__ import annotations

import numpy as np
from lambda_db.catalogue import SqlCatalogue

from lambda_core.discovery.manager import registry
from lambda_core.laws.par import make_par
from lambda_core.laws.probe import trial_context
from lambda_core.testing import evaluate


def test_every_oil_feeds_its_laws(catalogue: SqlCatalogue) -> None:
    rows = catalogue.lubricants(limit=1000)
    assert len(rows) > 10
    for row in rows:
        assert row.rheology in row.parameters["rheology"], row.name
        for role, models in row.parameters.items():
            for name, values in models.items():
                law = registry().model(role, name)
                written = {key: value.text() for key, value in values.items()}
                make_par(law, law.parameters.model_validate(written), trial_context("ball_inner"))


def test_rheology_laws_of_one_oil_agree_at_ambient_pressure(catalogue: SqlCatalogue) -> None:
    """Compare laws at ambient pressure to 5 %.

    The laws share two viscosities. FVA3A within 12 %: its Vogel constants and nu100 have two sources.
    """
    for row in catalogue.lubricants(limit=1000):
        found = []
        for name, values in row.parameters["rheology"].items():
            written = {key: value.text() for key, value in values.items()}
            ln_eta, _ = evaluate(f"rheology/{name}", written, p=0.0, T=np.array([313.15, 353.15, 373.15]))
            found.append(ln_eta)
        spread = np.ptp(np.array(found), axis=0)
        assert np.all(spread < (0.12 if row.name == "FVA3A" else 0.05)), (row.name, spread)
