"""Transverse load factor K_Hα by ISO 6336-1:2019: from the loads of a contact analysis, and by method B."""

import numpy as np

from tribodyn.numerics.shapes import Array, Float


def transverse_load_factor(load: float, accurate_load: float) -> float:
    """K_Hα: maximum load of a tooth over that of the same gears without deviations, at least 1: clause 8.

    It is 1 where the deviations raise no tooth's load, and for gears without deviations, whose modifications
    stay. Both loads are those of `shared_load`: in the middle of the path of spur gears with ε_α < 2 one pair
    carries everything, with deviations as without, and the ratio of the maxima over the whole path would
    always be 1. It is at most the whole load over `accurate_load`, reached where deviations leave one pair.

    Parameters
    ----------
    load, accurate_load : with the deviations and without, N
    """
    return max(1.0, load / accurate_load)


def shared_load(
    load: Float[Array, "position pair"], roll: Float[Array, "position pair"], limits: tuple[float, float]
) -> float:
    """Maximum load of a pair, N, over the positions at which two pairs or more are on their path of contact.

    NaN where there is no such position.

    Parameters
    ----------
    load, roll : (positions, pairs), N and rad
    limits : (first, last), roll angles of the path's ends without load, rad
    """
    first, last = limits
    room = 1e-9 * (last - first)
    together = np.sum((roll >= first - room) & (roll <= last + room), axis=1) >= 2
    return float(np.max(load[together])) if np.any(together) else float("nan")


def transverse_factor_b(
    contact_ratios: tuple[float, float], mesh_stiffness: float, pitch_deviation: float, line_load: float
) -> float:
    """K_Hα by method B: 1 where the deflection exceeds the deviations by far: (73) to (77).

    0.9 + 0.4 c_γα (f_pb − y_α)/(F_tH/b), times ε_γ/2 up to ε_γ = 2, the second term times √(2 (ε_γ − 1)/ε_γ)
    above; at least 1, at most ε_γ/(ε_α Z_ε²).

    Parameters
    ----------
    contact_ratios : (ε_α, ε_β)
    mesh_stiffness : c_γα per face width, Pa
    pitch_deviation : f_pb − y_α, m
    line_load : F_tH/b = F_t K_A K_v K_Hβ/b, N/m
    """
    transverse, overlap = contact_ratios
    total = transverse + overlap
    excess = 0.4 * mesh_stiffness * pitch_deviation / line_load
    if total <= 2.0:
        factor = total / 2.0 * (0.9 + excess)
    else:
        factor = 0.9 + excess * float(np.sqrt(2.0 * (total - 1.0) / total))
    part = min(overlap, 1.0)
    squared = (4.0 - transverse) / 3.0 * (1.0 - part) + part / transverse
    return float(min(max(factor, 1.0), max(total / (transverse * squared), 1.0)))
