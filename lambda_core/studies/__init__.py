"""Studies: many points of one case, quasi-static or dynamic, on any executor, resumable."""
