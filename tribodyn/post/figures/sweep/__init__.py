"""Figures of sweeps, one subject a file; `tribodyn.sweep.pictures` names them."""
