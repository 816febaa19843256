"""Lanes: the laws compiled for vectors of cases, one case per lane."""

from tribodyn.numerics.processes.libraries import without_file

without_file("numba")  # which all modules here import
