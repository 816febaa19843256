"""Figures of sweeps, one subject a file; `tribodyn.post.sweep_plots` names them."""
