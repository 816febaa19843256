"""Figures and pages of records, as their studies describe them."""
