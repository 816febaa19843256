"""Dormand-Prince 8(7), explicit, of diffrax."""

import diffrax

from tribodyn.solve.methods import DiffraxMethod

METHOD = DiffraxMethod(diffrax.Dopri8, stages=13, proportional=0.2, integral=0.4)
