"""All compiled code of the core. Nothing here is imported before a run needs it.

The folder's sources are hashed into the name of the compiled-code cache, so an edit
anywhere in it is seen by the next process. Helpers are compiled with `helper`; only the entry
points of :mod:`lambda_core.physics.compiled.entry` are cached.
"""
