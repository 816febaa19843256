"""Allowances of tooth thickness by DIN 3967 and of the centre distance by js classes (ISO 286, DIN 3964).

The tables are written from knowledge, without the standards at hand; printed allowances c25 at 72 and 108 mm,
cd25 at 341 and 1351 mm, js6 at 861 and js7 at 91.5 mm confirm them (`tribodyn validate`). Lengths in m.
"""

import bisect

from tribodyn.errors import InputError

#: Upper limits of the ranges of the reference diameter, mm, the last one without.
_DIAMETERS = (10, 50, 125, 280, 560, 1000, 1600, 2500, 4000, 6300, 10000)
#: −A_sne, µm, by range of diameter.
_UPPER = {
    "a": (100, 135, 180, 250, 330, 450, 600, 820, 1100, 1500, 2000),
    "ab": (85, 110, 150, 200, 280, 370, 500, 680, 920, 1250, 1650),
    "b": (70, 95, 125, 170, 230, 310, 420, 560, 760, 1020, 1350),
    "bc": (58, 75, 105, 140, 190, 260, 340, 460, 620, 840, 1150),
    "c": (48, 65, 85, 115, 155, 210, 290, 390, 520, 700, 940),
    "cd": (40, 54, 70, 95, 130, 175, 240, 320, 430, 580, 780),
    "d": (33, 44, 60, 80, 110, 145, 200, 270, 360, 480, 640),
    "e": (22, 30, 40, 56, 75, 100, 135, 180, 250, 330, 450),
    "f": (10, 14, 19, 26, 35, 48, 64, 85, 115, 155, 210),
    "g": (5, 7, 9, 12, 17, 22, 30, 41, 56, 75, 100),
    "h": (0,) * 11,
}
#: T_sn, µm, of the series 21 to 30 by range of diameter.
_TOLERANCES = (
    (3, 5, 8, 12, 20, 30, 50, 80, 130, 200),
    (5, 8, 12, 20, 30, 50, 80, 130, 200, 300),
    (6, 10, 16, 25, 40, 60, 100, 160, 250, 400),
    (8, 12, 20, 30, 50, 80, 130, 200, 300, 500),
    (10, 16, 25, 40, 60, 100, 160, 250, 400, 600),
    (12, 20, 30, 50, 80, 130, 200, 300, 500, 800),
    (16, 25, 40, 60, 100, 160, 250, 400, 600, 1000),
    (20, 30, 50, 80, 130, 200, 300, 500, 800, 1300),
    (25, 40, 60, 100, 160, 250, 400, 600, 1000, 1600),
    (30, 50, 80, 125, 200, 300, 500, 800, 1300, 2000),
    (40, 60, 100, 160, 250, 400, 600, 1000, 1600, 2400),
)
#: Upper limits of the ranges of a length, mm, and IT5 to IT11, µm: ISO 286-1.
_LENGTHS = (
    3,
    6,
    10,
    18,
    30,
    50,
    80,
    120,
    180,
    250,
    315,
    400,
    500,
    630,
    800,
    1000,
    1250,
    1600,
    2000,
    2500,
    3150,
)
_GRADES = (
    (4, 6, 10, 14, 25, 40, 60),
    (5, 8, 12, 18, 30, 48, 75),
    (6, 9, 15, 22, 36, 58, 90),
    (8, 11, 18, 27, 43, 70, 110),
    (9, 13, 21, 33, 52, 84, 130),
    (11, 16, 25, 39, 62, 100, 160),
    (13, 19, 30, 46, 74, 120, 190),
    (15, 22, 35, 54, 87, 140, 220),
    (18, 25, 40, 63, 100, 160, 250),
    (20, 29, 46, 72, 115, 185, 290),
    (23, 32, 52, 81, 130, 210, 320),
    (25, 36, 57, 89, 140, 230, 360),
    (27, 40, 63, 97, 155, 250, 400),
    (32, 44, 70, 110, 175, 280, 440),
    (36, 50, 80, 125, 200, 320, 500),
    (40, 56, 90, 140, 230, 360, 560),
    (47, 66, 105, 165, 260, 420, 660),
    (55, 78, 125, 195, 310, 500, 780),
    (65, 92, 150, 230, 370, 600, 920),
    (78, 110, 175, 280, 440, 700, 1100),
    (96, 135, 210, 330, 540, 860, 1350),
)


#: Codes of the standard: an allowance's letters and a tolerance's series.
CODES = tuple(f"{letters}{series}" for letters in _UPPER for series in range(21, 31))


def thickness_allowances(code: str, reference_diameter: float) -> tuple[float, float]:
    """A_sne and A_sni of the normal tooth thickness, m, of a code such as "cd25": DIN 3967.

    Raises InputError for a code that the standard has not.
    """
    if code not in CODES:
        raise broken_code("thickness_code", code)
    letters, series = code[:-2], int(code[-2:])
    place = min(bisect.bisect_left(_DIAMETERS, round(1e3 * reference_diameter, 9)), len(_DIAMETERS) - 1)
    upper = -1e-6 * _UPPER[letters][place]
    return upper, upper - 1e-6 * _TOLERANCES[place][series - 21]


def broken_code(key: str, code: str) -> InputError:
    """What is to be said of a code that the standard has not."""
    rule = f"is none of DIN 3967: {', '.join(_UPPER)} and 21 to 30, as in cd25"
    return InputError(key, code, rule, "take c25 to e26, usual in industrial gearing")


def centre_distance_allowance(grade: int, centre_distance: float) -> float:
    """Half of IT5 to IT11, m, ±: of js5 to js11 by ISO 286 and, the same, DIN 3964."""
    place = min(bisect.bisect_left(_LENGTHS, round(1e3 * abs(centre_distance), 9)), len(_LENGTHS) - 1)
    if not 5 <= grade <= 11:
        rule, remedy = "is a grade from 5 to 11 (ISO 286)", "take 7, usual in industrial gearing"
        raise InputError("centre_distance_grade", grade, rule, remedy)
    return 0.5e-6 * _GRADES[place][grade - 5]
