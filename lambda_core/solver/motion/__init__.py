"""Evaluate right-hand side, energy and Jacobian in compiled code."""
