"""What an uneven line load along the face does to friction, film and pressure, as ratios to the mean.

Friction on the slices of a face is ∫ μ(q) q dz. A coefficient that goes like q^m takes the same at an even
line load W with (W/q̄)^m = ⟨s^(1+m)⟩, s = q/q̄ and ⟨⟩ the mean over the whole face. Laws of lubricated flanks
have a small m, |m| < 0.3, and as m goes to zero this becomes

    W/q̄ = exp ⟨s ln s⟩,

whatever the law: the load-weighted geometric mean of the line load. The next term of ln W is
½ m (⟨s ln² s⟩ − ⟨s ln s⟩²), 5 % of W for a triangle and m = 0.3, 1.5 % of the friction. The film is thinnest,
pressure and flash temperature are largest where s is: that ratio is K_Hβ (ISO 6336-1).
"""

import numpy as np

from tribodyn.numerics.shapes import Array, Float


def friction_ratio(slice_load: Float[Array, "*pair slice"]) -> Float[Array, "*pair"]:
    """W/q̄ of loads (…, slice) ≥ 0, N, of equal slices; at least 1, and 1 where nothing is loaded."""
    share = _share(slice_load)
    return np.exp(np.mean(share * np.log(np.where(share > 0.0, share, 1.0)), axis=-1))


def peak_ratio(slice_load: Float[Array, "*pair slice"]) -> Float[Array, "*pair"]:
    """K_Hβ of loads (…, slice) ≥ 0, N, of equal slices; 1 where nothing is loaded."""
    return np.max(_share(slice_load), axis=-1)


def _share(slice_load: Float[Array, "*pair slice"]) -> Float[Array, "*pair slice"]:
    mean = np.mean(slice_load, axis=-1, keepdims=True)
    return np.where(mean > 0.0, slice_load / np.where(mean > 0.0, mean, 1.0), 1.0)
