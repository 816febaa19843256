"""Loss of a mesh under load by published formulas: coefficients of friction, and methods of P_VZP."""
