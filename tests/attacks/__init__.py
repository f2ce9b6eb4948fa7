"""Attack the program on purpose: ``python -m tests.attacks --help``."""
