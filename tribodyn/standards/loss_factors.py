"""Loss factor H_v of an involute mesh under a constant friction coefficient: η = 1 − μ H_v.

Höhn's formula and the integral that it evaluates, as given by A. Diez-Ibarbia et al., efficiency of spur
gears with a shifting profile, (8)-(11). The tip contact ratios ε1 (pinion, recess) and ε2 (gear, approach)
are the pinion's rotation from the pitch point to the end and to the beginning of contact, in pitches.
"""

import math
from itertools import pairwise

import numpy as np


def hoehn(
    pinion_tip: float, gear_tip: float, pinion_teeth: float, ratio: float, base_helix_angle: float = 0.0
) -> float:
    """H_v = π (u + 1)/(z1 u cos β_b) (1 − ε_α + ε1² + ε2²), Diez-Ibarbia (10); with β_b as Ohlendorf has it.

    For 0 ≤ ε1, ε2 (`pinion_tip`, `gear_tip`) ≤ 1 ≤ ε1 + ε2 only, with the pitch point where one pair alone
    carries the load; beyond, see `equal_loads`. `pinion_teeth` is z1, `ratio` u = z2/z1, < 0 of an internal
    gear.
    """
    total = 1.0 - (pinion_tip + gear_tip) + pinion_tip**2 + gear_tip**2
    return math.pi * (ratio + 1.0) / (pinion_teeth * ratio) * total / math.cos(base_helix_angle)


def of_even_lines(
    pinion_tip: float, gear_tip: float, pinion_teeth: float, ratio: float, base_helix_angle: float
) -> float:
    """H_v = π (u + 1)/(z1 u cos β_b) (ε1² + ε2²)/ε_α of helical involutes: an even load on all lines.

    From P = μ F_n (ω1 + ω2) ξ̄ with the mean distance from the pitch point ξ̄ = (ξ_A² + ξ_E²)/(2 g_α): exact
    over a mesh cycle for whole ε_β, where the lines of contact keep their length.
    """
    mean = (pinion_tip**2 + gear_tip**2) / (pinion_tip + gear_tip)
    return math.pi * (ratio + 1.0) / (pinion_teeth * ratio) * mean / math.cos(base_helix_angle)


def equal_loads(pinion_tip: float, gear_tip: float, pinion_teeth: float, ratio: float) -> float:
    """Evaluate the integral (8) behind Höhn's formula: equal loads on all pairs in contact, however many.

    H_v = 2π (u + 1)/(z1 u) ∫ |ξ|/n(ξ) dξ over −ε2 … ε1, with ξ in pitches from the pitch point and n the
    number of pairs in contact. Piecewise closed form; parameters as for `hoehn`.
    """
    pairs = range(-math.ceil(pinion_tip + gear_tip), math.ceil(pinion_tip + gear_tip) + 1)
    edges = {0.0, -gear_tip, pinion_tip}
    edges |= {pinion_tip - k for k in pairs} | {k - gear_tip for k in pairs}
    inside = sorted(edge for edge in edges if -gear_tip <= edge <= pinion_tip)
    total = 0.0
    for low, high in pairwise(inside):
        middle = (low + high) / 2.0
        loaded = sum(-gear_tip < middle + k < pinion_tip for k in pairs)
        total += abs(middle) * (high - low) / loaded
    return 2.0 * math.pi * (ratio + 1.0) / (pinion_teeth * ratio) * total


def of_rigid_lines(
    pinion_tip: float,
    gear_tip: float,
    overlap: float,
    pinion_teeth: float,
    ratio: float,
    base_helix_angle: float,
    instants: int = 400,
) -> float:
    """H_v of rigid teeth with helix: at every instant an even load along all lines of contact.

    H_v = 2π (u + 1)/(z1 u cos β_b) · mean over a pitch of Σ∫|ξ| dξ/Σ∫dξ, ξ in pitches from the pitch point
    along every line, `overlap` ε_β; the local loss factor of Wimmer (TU München 2006) with this load. It is
    `equal_loads` at ε_β = 0 and `of_even_lines` at whole ε_β. The mean is a sum over `instants`.
    """
    if overlap <= 0.0:
        return equal_loads(pinion_tip, gear_tip, pinion_teeth, ratio) / math.cos(base_helix_angle)
    path = pinion_tip + gear_tip
    ends = (np.arange(instants) + 0.5)[:, None] / instants + np.arange(math.ceil(path + overlap))
    high = np.minimum(ends, path) - gear_tip
    low = np.maximum(ends - overlap, 0.0) - gear_tip
    high = np.maximum(high, low)
    moments = (np.abs(high) * high - np.abs(low) * low).sum(axis=1) / 2.0
    mean = float(np.mean(moments / (high - low).sum(axis=1)))
    return 2.0 * math.pi * (ratio + 1.0) / (pinion_teeth * ratio) * mean / math.cos(base_helix_angle)


def least_line_length(contact_ratio: float, overlap: float, base_helix_angle: float) -> float:
    """Least sum of the lines of contact over the mesh cycle, per face width.

    ⌊ε_α⌋ of spur gears. Of helical ones (ε_α/cos β_b)(1 − n_α n_β/(ε_α ε_β)) with the fractions n_α, n_β of
    ε_α and ε_β, and with (1 − n_α)(1 − n_β) in place of n_α n_β where n_α + n_β > 1.
    """
    if overlap <= 0.0:
        return max(math.floor(contact_ratio), 1) / math.cos(base_helix_angle)
    part, other = contact_ratio % 1.0, overlap % 1.0
    lost = part * other if part + other <= 1.0 else (1.0 - part) * (1.0 - other)
    return contact_ratio * (1.0 - lost / (contact_ratio * overlap)) / math.cos(base_helix_angle)
