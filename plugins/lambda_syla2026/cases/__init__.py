"""Bearings and operating points of the paper as case files (entry-point group ``lambda_bearing.cases``)."""
