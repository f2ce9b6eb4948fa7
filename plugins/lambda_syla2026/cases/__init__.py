"""Offer the paper's operating points as case files.

Entry-point group ``lambda_bearing.cases``.
"""
