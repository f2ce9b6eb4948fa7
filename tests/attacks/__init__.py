"""The program attacked on purpose: ``python -m tests.attacks --help``."""
