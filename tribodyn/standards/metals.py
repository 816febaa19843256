"""What gear materials endure by ISO 6336-5:2016: allowable stress numbers, and how they depend on cycles.

From memory of the standards, not transcribed from them; the worked example of a published design report
confirms what it uses of case-hardened steel (`tests/validation/test_books.py`). A material's own σ_Hlim and
σ_Flim, from the standard or from tests, take the place of the table.
"""

from types import MappingProxyType
from typing import Literal, NamedTuple, get_args

from tribodyn.standards.fatigue import StressCurve

Treatment = Literal[
    "normalized",
    "grey-iron",
    "ductile-iron",
    "through-hardened-carbon",
    "through-hardened",
    "case-hardened",
    "induction-hardened",
    "nitrided",
    "nitrided-through-hardened",
    "nitrocarburized",
]
TREATMENTS: tuple[Treatment, ...] = get_args(Treatment)
Grade = Literal["ML", "MQ", "ME"]
GRADES: tuple[Grade, ...] = get_args(Grade)
#: Treatments that leave a hard layer on the flank, after which flanks are ground or as hardened.
SURFACE_HARDENED = (
    "case-hardened",
    "induction-hardened",
    "nitrided",
    "nitrided-through-hardened",
    "nitrocarburized",
)
_NITRIDED = ("nitrided", "nitrided-through-hardened")
#: Vickers hardness 1 HV as a pressure, Pa.
VICKERS = 9.80665e6


class Line(NamedTuple):
    """Stress number A x + B, N/mm², over the hardness x (HB or HV) of a range."""

    slope: float
    constant: float
    hardness: tuple[float, float]


def _grades(ml: Line, mq: Line, me: Line) -> dict[Grade, Line]:
    return {"ML": ml, "MQ": mq, "ME": me}


def _level(ml: float, mq: float, me: float, *ranges: tuple[float, float]) -> dict[Grade, Line]:
    return _grades(*(Line(0.0, value, span) for value, span in zip((ml, mq, me), ranges, strict=True)))


_ALLOY, _CARBON, _IRON = (200.0, 360.0), (135.0, 210.0), (175.0, 300.0)
#: Table 1 of ISO 6336-5: allowable stress numbers (contact) σ_Hlim.
CONTACT: MappingProxyType[Treatment, dict[Grade, Line]] = MappingProxyType(
    {
        "normalized": _grades(
            Line(1.0, 190.0, (110.0, 210.0)),
            Line(1.0, 190.0, (110.0, 210.0)),
            Line(1.52, 250.0, (110.0, 210.0)),
        ),
        "grey-iron": _grades(
            Line(1.033, 132.0, (150.0, 240.0)),
            Line(1.033, 132.0, (150.0, 240.0)),
            Line(1.465, 122.0, (175.0, 275.0)),
        ),
        "ductile-iron": _grades(
            Line(1.434, 211.0, _IRON), Line(1.434, 211.0, _IRON), Line(1.5, 250.0, (200.0, 300.0))
        ),
        "through-hardened-carbon": _grades(
            Line(0.963, 283.0, _CARBON), Line(0.925, 360.0, _CARBON), Line(0.838, 432.0, _CARBON)
        ),
        "through-hardened": _grades(
            Line(1.313, 188.0, _ALLOY), Line(1.313, 373.0, _ALLOY), Line(2.213, 260.0, (200.0, 390.0))
        ),
        "case-hardened": _level(1300.0, 1500.0, 1650.0, (600.0, 800.0), (660.0, 800.0), (660.0, 800.0)),
        "induction-hardened": _grades(
            Line(0.740, 602.0, (485.0, 615.0)),
            Line(0.541, 882.0, (500.0, 615.0)),
            Line(0.505, 1013.0, (500.0, 615.0)),
        ),
        "nitrided": _level(1125.0, 1250.0, 1450.0, *[(650.0, 900.0)] * 3),
        "nitrided-through-hardened": _level(788.0, 998.0, 1217.0, *[(450.0, 650.0)] * 3),
        "nitrocarburized": _level(650.0, 950.0, 950.0, (300.0, 650.0), (450.0, 650.0), (450.0, 650.0)),
    }
)
#: Nominal stress numbers (bending) σ_Flim; case-hardened MQ: core hardness of 25 HRC at least, lower line.
BENDING: MappingProxyType[Treatment, dict[Grade, Line]] = MappingProxyType(
    {
        "normalized": _grades(
            Line(0.455, 69.0, (110.0, 210.0)),
            Line(0.455, 69.0, (110.0, 210.0)),
            Line(0.386, 94.0, (110.0, 210.0)),
        ),
        "grey-iron": _grades(
            Line(0.256, 8.0, (150.0, 240.0)),
            Line(0.256, 8.0, (150.0, 240.0)),
            Line(0.2, 53.0, (175.0, 275.0)),
        ),
        "ductile-iron": _grades(
            Line(0.35, 119.0, _IRON), Line(0.35, 119.0, _IRON), Line(0.38, 134.0, (200.0, 300.0))
        ),
        "through-hardened-carbon": _grades(
            Line(0.25, 108.0, (115.0, 215.0)),
            Line(0.24, 163.0, (115.0, 215.0)),
            Line(0.283, 202.0, (115.0, 215.0)),
        ),
        "through-hardened": _grades(
            Line(0.423, 104.0, _ALLOY), Line(0.425, 187.0, _ALLOY), Line(0.358, 231.0, (200.0, 390.0))
        ),
        "case-hardened": _level(312.0, 425.0, 525.0, (600.0, 800.0), (660.0, 800.0), (660.0, 800.0)),
        "induction-hardened": _grades(
            Line(0.305, 76.0, (485.0, 615.0)),
            Line(0.138, 290.0, (500.0, 570.0)),
            Line(0.271, 237.0, (500.0, 615.0)),
        ),
        "nitrided": _level(270.0, 420.0, 468.0, *[(650.0, 900.0)] * 3),
        "nitrided-through-hardened": _level(258.0, 363.0, 432.0, *[(450.0, 650.0)] * 3),
        "nitrocarburized": _level(224.0, 388.0, 388.0, (300.0, 650.0), (450.0, 650.0), (450.0, 650.0)),
    }
)


class Metal(NamedTuple):
    """Strength of a gear's material, Pa."""

    treatment: Treatment
    contact_limit: float  # σ_Hlim
    bending_limit: float  # σ_Flim, for pulsating load
    hardness: float  # Vickers, of the flank, as a pressure
    yield_strength: float  # σ_S or σ_0.2 of what the root is made of, by which notches count


def stress_number(line: Line, hardness: float) -> float:
    """σ_Hlim or σ_Flim, Pa, for a Vickers hardness (Pa), held within the range of the line."""
    low, high = line.hardness
    return 1e6 * (line.slope * min(max(hardness / VICKERS, low), high) + line.constant)


def hardness_range(treatment: Treatment, grade: Grade) -> tuple[float, float]:
    """Hardness that ISO 6336-5 asks of a material of this grade, HV (HB of soft ones, nearly the same)."""
    return CONTACT[treatment][grade].hardness


def contact_factors(treatment: Treatment) -> StressCurve:
    """Life factor Z_NT over load cycles, no pitting permitted: ISO 6336-2, table 2."""
    if treatment in ("grey-iron", *_NITRIDED):
        return StressCurve((1e5, 2e6, 1e10), (1.3, 1.0, 0.85))
    if treatment == "nitrocarburized":
        return StressCurve((1e5, 2e6, 1e10), (1.1, 1.0, 0.85))
    return StressCurve((1e5, 5e7, 1e10), (1.6, 1.0, 0.85))


def bending_factors(treatment: Treatment) -> StressCurve:
    """Life factor Y_NT over load cycles: ISO 6336-3, table 1."""
    if treatment in ("case-hardened", "induction-hardened"):
        return StressCurve((1e3, 3e6, 1e10), (2.5, 1.0, 0.85))
    if treatment in ("grey-iron", *_NITRIDED):
        return StressCurve((1e3, 3e6, 1e10), (1.6, 1.0, 0.85))
    if treatment == "nitrocarburized":
        return StressCurve((1e3, 3e6, 1e10), (1.1, 1.0, 0.85))
    return StressCurve((1e4, 3e6, 1e10), (2.5, 1.0, 0.85))


#: Yield strength over Vickers hardness of quenched and tempered steel: σ_B = 3.2 HV N/mm² (ISO 18265), and
#: three quarters of it.
_YIELD = 0.75 * 3.2e6 / VICKERS


def yield_from_hardness(hardness: float) -> float:
    """Yield strength of steel of a Vickers hardness (Pa), an estimate, Pa."""
    return _YIELD * hardness


#: Slip-layer thickness ρ', m, over the yield strength of through-hardened and normalized steel, Pa: ISO
#: 6336-3, table 4.
_SLIP_YIELD = (300e6, 400e6, 500e6, 600e6, 800e6, 1000e6)
_SLIP = (0.0833e-3, 0.0445e-3, 0.0281e-3, 0.0194e-3, 0.0064e-3, 0.0014e-3)


def slip_layer(metal: Metal) -> float:
    """Slip-layer thickness ρ', m: how far a stress gradient reaches; ISO 6336-3, table 4."""
    if metal.treatment in ("case-hardened", "induction-hardened"):
        return 0.0030e-3
    if metal.treatment in (*_NITRIDED, "nitrocarburized"):
        return 0.1005e-3
    if metal.treatment == "grey-iron":
        return 0.3095e-3
    strength = min(max(metal.yield_strength, _SLIP_YIELD[0]), _SLIP_YIELD[-1])
    for left, right, thick, thin in zip(
        _SLIP_YIELD[:-1], _SLIP_YIELD[1:], _SLIP[:-1], _SLIP[1:], strict=True
    ):
        if strength <= right:
            return thick + (thin - thick) * (strength - left) / (right - left)
    return _SLIP[-1]
