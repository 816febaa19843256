"""Lanes: the laws compiled for vectors of cases, one case per lane."""
