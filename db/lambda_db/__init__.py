"""Store bearings, lubricants, materials and cages in SQLite.

Every value has its source and grade.
"""
