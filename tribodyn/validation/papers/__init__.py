"""Comparison with papers: one file with the rows of each, with its figures and curves beside it."""
