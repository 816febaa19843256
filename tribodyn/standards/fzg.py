"""FZG tests: gears, load stages, and the strength of an oil that a load stage stands for.

Gears of type A and C have 16 and 24 teeth of module 4.5 mm at a centre distance of 91.5 mm (ISO 14635-1;
type C: FVA information sheet 54/7). The permissible film follows by recomputing the test with
`micropitting.method_b`.
"""

import math
from collections.abc import Sequence
from typing import NamedTuple

from tribodyn.standards.contact_path import ContactPath, load_share
from tribodyn.standards.micropitting import Flanks, Load, Oil, method_b, permissible_film

_MODULE, _TEETH, _CENTRES, _ANGLE = 4.5e-3, (16.0, 24.0), 91.5e-3, math.radians(20.0)
#: Tip diameters of type C, m.
_TIPS = (82.46e-3, 118.36e-3)
_WIDTH = 14e-3
#: Ra of the flanks of the micropitting test, m (0.4 to 0.6 µm are allowed), and what they are made of.
_ROUGHNESS = 0.5e-6
_STEEL = Flanks(_ROUGHNESS, 226.4e9, (13780.0, 13780.0), 5.0)
#: Speed at the working pitch circles, m/s, and temperature of the sprayed oil, K, of C-GF/8,3/90.
_PITCH_SPEED, _OIL = 8.3, 363.15
#: Product of the load factors of the test rig: the printed line load of 236.3 N/mm at A at load stage 10 is
#: that many times a third of F_bt/b.
_RIG_FACTOR = 1.2665
#: Pinion's torque by load stage of the micropitting test, N m: FVA information sheet 54/7, from memory.
MICROPITTING_TORQUES = {5: 70.0, 6: 98.9, 7: 132.5, 8: 171.6, 9: 215.6, 10: 265.1}


def test_path() -> ContactPath:
    """Path of contact of the gears of type C."""
    base = [z * _MODULE / 2.0 * math.cos(_ANGLE) for z in _TEETH]
    working = math.acos(sum(base) / _CENTRES)
    return ContactPath(_TEETH, (base[0], base[1]), (_TIPS[0] / 2.0, _TIPS[1] / 2.0), working)


def micropitting_torque(load_stage: float) -> float:
    """Torque on the pinion at a load stage of the micropitting test, 5 to 10, N m; in between interpolated.

    Below 5 and above 10 the nearest stage counts.
    """
    stage = min(max(load_stage, 5.0), 10.0)
    below = min(int(stage), 9)
    low, high = MICROPITTING_TORQUES[below], MICROPITTING_TORQUES[below + 1]
    return low + (stage - below) * (high - low)


class MicropittingTest(NamedTuple):
    """The test gears at A, where their film is thinnest."""

    line_load: float  # F_bb, N/m
    bulk_temperature: float  # θ_M, K
    contact_temperature: float  # θ_B, K
    film_thickness: float  # h, m
    specific_film: float  # λ_GFT


def micropitting_test(load_stage: float, oil: Oil, oil_temperature: float = _OIL) -> MicropittingTest:
    """The gears of type C in C-GF/8,3/90 at a load stage and oil temperature (K), oil sprayed.

    ISO/TR 15144-1:2014, annex A: unmodified flanks of Ra 0.5 µm, method B with the load factors of the rig.
    """
    path = test_path()
    load = Load(
        micropitting_torque(load_stage),
        _PITCH_SPEED / path.pitch_radius[0],
        _WIDTH,
        oil_temperature,
        _RIG_FACTOR,
        lubrication="spray",
    )
    films = method_b(path, _STEEL, load, oil)
    normal = load.factor * load.pinion_torque / path.base_radius[0] / _WIDTH
    return MicropittingTest(
        normal * float(load_share(path, 0.0)),
        films.bulk_temperature,
        films.bulk_temperature + float(films.flash_rise[0]),
        float(films.film_thickness[0]),
        float(films.specific_film[0]),
    )


def permissible_specific_film(
    load_stage: float, oil: Oil, material_factor: float = 1.0, oil_temperature: float = _OIL
) -> float:
    """Permissible λ_GFP of an oil that fails the micropitting test C-GF/8,3/90 at a load stage.

    The specific film of the test gears at that stage and oil temperature (K) times 1.4 and W_W of the pair's
    materials: ISO/TR 15144-1:2014, annex A, which shows it as curves over the viscosity of mineral oils.
    """
    test = micropitting_test(load_stage, oil, oil_temperature)
    return permissible_film(test.specific_film, material_factor)


#: W_W by treatment: ISO/TR 15144-1:2014, table A.1, from memory; of a pair the mean of both gears.
_MATERIAL_FACTORS = {
    "case-hardened": 1.0,
    "nitrided": 1.5,
    "nitrided-through-hardened": 1.5,
    "induction-hardened": 0.65,
    "through-hardened": 0.5,
    "through-hardened-carbon": 0.5,
}


def material_factor(treatments: Sequence[str | None]) -> float:
    """W_W of a pair: the mean of both gears' (printed: 0.75 of case-hardened with through-hardened).

    A treatment that the table has not counts as case-hardened where it is surface-hardened or unknown, as
    through-hardened where it is soft.
    """
    if not treatments:
        return 1.0
    return sum(
        1.0 if each is None else _MATERIAL_FACTORS.get(each, 1.0 if each == "nitrocarburized" else 0.5)
        for each in treatments
    ) / len(treatments)


#: T_1 of A/8,3/90 by load stage, N m: ISO 14635-1, table 2; 13 and 14, beyond it, from memory.
SCUFFING_TORQUES = (
    3.3,
    13.7,
    35.3,
    60.8,
    94.1,
    135.3,
    183.4,
    239.3,
    302.0,
    372.6,
    450.1,
    534.5,
    626.9,
    714.2,
)


def scuffing_torque(load_stage: float) -> float:
    """T_1T, the pinion's torque at a load stage of A/8,3/90, N m: of the table, in between as 3.726 S_FZG².

    Printed: 135.3 at stage 6; θ_intS at stage 14 implies 714.2. The quadratic law of ISO/TS 6336-21 (97)
    scales between two stages of the table, and holds outside it.
    """
    low = min(max(int(load_stage), 1), len(SCUFFING_TORQUES))
    first = SCUFFING_TORQUES[low - 1]
    if low == len(SCUFFING_TORQUES) or load_stage <= low:
        return first * (load_stage / low) ** 2
    share = (load_stage**2 - low**2) / ((low + 1) ** 2 - low**2)
    return first + share * (SCUFFING_TORQUES[low] - first)


def scuffing_temperature(load_stage: float, lubricant: float, structure: float = 1.0) -> float:
    """Scuffing temperature θ_S, K, of an oil that fails A/8,3/90 at a load stage: ISO/TS 6336-20:2017, (99).

    80 + (0.85 + 1.4 X_W) X_L S_FZG² in °C, X_L of `scuffing.lubricant_factor`, with the viscosity; the
    structure X_W is 1 case-hardened with usual austenite, 1.5 nitrided (table 2).
    """
    return 273.15 + 80.0 + (0.85 + 1.4 * structure) * lubricant * load_stage**2


def scuffing_integral_temperature(
    load_stage: float, lubricant: float, viscosity_40: float, structure: float = 1.0
) -> float:
    """Scuffing integral temperature θ_intS, K, of such an oil: ISO/TS 6336-21:2017, (94) to (97).

    θ_MT + 1.5 X_W θ_flaintT with θ_MT = 80 + 0.23 T_1T X_L and θ_flaintT = 0.2 T_1T (100/ν_40)^0.02 X_L, in
    °C, N m and mm²/s; X_L of `scuffing.ScuffingMesh`, without the viscosity. ν_40 is given in m²/s.
    """
    torque = scuffing_torque(load_stage)
    bulk = 80.0 + 0.23 * torque * lubricant
    flash = 0.2 * torque * (100.0 / (1e6 * viscosity_40)) ** 0.02 * lubricant
    return 273.15 + bulk + 1.5 * structure * flash
