"""Figures of sweeps, one subject a file; `tribodyn.grid.pictures` names them."""
