"""Lanes: the laws compiled for vectors of cases, one case a lane."""
