"""Load capacity by the standards, as functions of numbers: films, temperatures, dynamic factor, load factors.

Everything is in SI units; where a formula has the standard's own, they are converted within it. Temperatures
are absolute, K. Formulas are from memory of the standards, their numbers as in the edition that a docstring
names; `docs/standards.md` lists which are compared with a published example.
"""
