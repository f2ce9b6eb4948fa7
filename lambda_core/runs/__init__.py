"""Run, step, resume, cross-check and estimate cases."""
