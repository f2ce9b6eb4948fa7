"""Hold compiled code of the electric network.

Nothing is imported before a network is integrated.

The folder's sources are hashed into the name of the compiled-code cache; only the entry point of
:mod:`lambda_core.analysis.electric.compiled.switching` is cached.
"""
