"""Store, average, summarise and cite results.

It has no ``api.py``: a result also runs its case again, so that the functions for users stand above this package, in
:mod:`lambda_core.runs.stored`.
"""
