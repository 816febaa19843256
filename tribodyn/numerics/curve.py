"""A function given by points."""

import numpy as np
from numpy.typing import NDArray

Table = tuple[NDArray[np.float64], NDArray[np.float64]]
"""(abscissae, strictly increasing; ordinates), both in SI units."""
