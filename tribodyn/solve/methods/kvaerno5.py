"""Kværnø 5(4), stiffly accurate singly diagonally implicit, of diffrax."""

import diffrax

from tribodyn.solve.methods import DiffraxMethod

METHOD = DiffraxMethod(diffrax.Kvaerno5, stages=7, proportional=0.0, integral=1.0)
