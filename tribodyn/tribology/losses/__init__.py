"""Losses of a gearbox outside its loaded meshes, one published formula a function."""
