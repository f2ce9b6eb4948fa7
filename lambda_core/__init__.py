"""Dynamics of rolling bearings: domain, contact pipeline, integrator, results.

Import what you need from :mod:`lambda_core.api` (running things) or
:mod:`lambda_core.plugins` (extending things); everything else is internal.
"""

__version__ = "0.1.0"
