"""Losses of a gearbox at any points of operation, by term and element."""
