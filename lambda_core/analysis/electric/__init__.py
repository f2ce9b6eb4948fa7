"""Compute a bearing as a part of an electric circuit.

A reader of contact samples; nothing here acts back on the motion.
"""
