"""Tsitouras 5(4), explicit, of diffrax."""

import diffrax

from tribodyn.solve.methods import DiffraxMethod

METHOD = DiffraxMethod(diffrax.Tsit5, stages=6, proportional=0.2, integral=0.4)
