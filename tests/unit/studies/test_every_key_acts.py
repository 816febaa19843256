"""Every key that is taken does something: another value has another result, or makes another case.

Keys and values are drawn from the schema (`tools/by_schema`), and what a key needs beside it is added. What
keys of single teeth do to a motion, which may reach a case and end on a flank that nobody touches, is
the matter of `tests/cross/test_errors_of_teeth.py`. `make soak` also compares runs of all kinds, of keys at
random (`tools/soak/keyed.py`).
"""

import re
from collections.abc import Callable, Iterable
from random import Random
from typing import Any

import pytest

from tools.by_schema.changes import keys_of, opened
from tools.by_schema.effects import acts, is_table, of_case, of_run, silent
from tools.by_schema.keys import SchemaKey
from tribodyn.errors import InputError
from tribodyn.studies.assessment.case import AssessmentCase
from tribodyn.studies.assessment.parts import request_of

soak = pytest.mark.soak
#: Pattern of a key that leaves the results of a kind as they are -> why.
LIMITS = {
    r"^solver\.max_periods$": "a limit that is not reached",
}
CASES = {
    r"rolling\.type$": "rollers have one formula, and balls one",
    r"ambient_temperature$": "of a network with a housing",
    r"\.rack$": "is for what pressure angle and gears do not say",
    r"^drive\.gear\.fillet_radius$": "of a ring whose cutter has a rounding of its own",
}
#: Of kinds in which nothing moves: of the bearings of both gears, one on a matrix, only that tilts.
STILL = {r"^bearings\.gear\.": "springs that hold the mate of a gear on a matrix, and do not tilt it"}
LOADS = {
    r"\.hand$": "mirrors both gears",
    r"\.rack$": "is for what pressure angle and gears do not say",
    r"mean_roughness$": "is for laws that take Ra, and for safeties; other laws take the roughness",
    r"finish$|asperity_(density|slope)$": "of the solved contact",
    r"\.quality$": "tolerances, for samples of deviations and safeties",
    r"\.(mass|inertia|rim_thickness|web_thickness)$": "nothing is accelerated",
    r"relief_(length|shape)$|lead_unmodified$": "of a relief that the scenario has not",
    r"both_flanks$": "back flanks do not touch",
    r"\.(treatment|grade|(contact|bending)_stress_limit|yield_strength)$": "of safeties",
    r"\.(case_depth|core_hardness)$": "of the safety against flank fracture",
    r"\.(fzg_\w+)$": "of safeties against scuffing and micropitting",
}
#: Of spur teeth that roll through one mesh cycle, on shafts that `opened` draws or on a diagonal matrix.
ROLLED = {
    **LOADS,
    **STILL,
    r"matrix_units$": "of a diagonal matrix, on which the load of spur teeth tilts nothing",
    r"^(bearings|shaft)\..*damping_ratio$": "nothing moves",
    r"bearing\.\*\.(dynamic_rating|static_\w+|fatigue_load_limit|contamination_factor)$": "of lives, which "
    "`check` prints",
    r"viscosity_law\.(b1|log_\w+|maximum_pressure)$": "of oil under pressure, in solved contacts",
    r"slice_coupling$": "of slices that differ in their load",
    r"ambient_temperature$": "of a network with a housing",
}


def idle(
    name: str,
    changed: dict[str, Any],
    look: Callable[[Any], Any],
    reasons: Iterable[str] = (),
    wanted: str = "",
    every: int = 1,
) -> tuple[list[str], int]:
    """Keys of a scenario whose values `look` does not tell apart, and how many it does."""
    base, found, acting = opened(name, changed), [], 0
    keys = [key for key in keys_of(base) if not silent(key) and not is_table(key)]
    for key in [key for key in keys if re.search(wanted, dotted(key))][::every]:
        seen = acts(Random(dotted(key) + key.owner), base, key, look)
        acting += seen is True
        if seen is False and not any(re.search(pattern, dotted(key)) for pattern in reasons):
            found.append(dotted(key))
    return found, acting


def dotted(key: SchemaKey) -> str:
    return ".".join(key.pattern)


@pytest.mark.parametrize(
    ("name", "short", "reasons", "wanted", "least"),
    [
        ("irefc", {"output.samples_per_cycle": 8}, (), "", 9),
        (
            "backlash-oscillator",
            {"frequency.from": 0.9, "frequency.to": 1.0, "frequency.step": 0.1},
            LIMITS,
            "^[a-z_]+$",
            4,
        ),
        (
            "efficiency-oil-18-36",
            {"output.samples_per_cycle": 16},
            LOADS,
            r"^operating\.",
            4,
        ),
        pytest.param("efficiency-oil-18-36", {"output.samples_per_cycle": 16}, ROLLED, "", 150, marks=soak),
    ],
)
def test_a_key_that_is_taken_changes_the_result(
    name: str, short: dict[str, Any], reasons: Iterable[str], wanted: str, least: int
):
    found, acting = idle(name, short, of_run, reasons, wanted)
    assert found == []
    assert acting >= least


def of_case_and_parts(case: Any) -> str:
    """A case; of an assessment also what its parts get of the scenario, or why they get nothing."""
    parts: Any = ""
    if isinstance(case, AssessmentCase):
        try:
            parts = request_of(case.pair)._asdict()
        except InputError as error:
            parts = str(error)
    return of_case(case) + of_case(parts)


@pytest.mark.parametrize(
    ("name", "every"),
    [
        ("involute-18-36", 40),
        ("planetary-24-84", 80),
        *(
            pytest.param(name, 1, marks=soak)
            for name in (
                *("involute-18-36", "load-contact-18-36", "two-stage-reducer", "run-up", "wear-18-36"),
                *("planetary-24-84", "helical-23-47", "ring-36-93", "efficiency-helical-fzg-20-30"),
                *("ehl-crc-23-47", "design-shift-23-47", "assessment-helical-24-95"),
                "wind-turbine-gearbox-assessment",
            )
        ),
    ],
)
def test_a_key_that_is_taken_changes_the_case(name: str, every: int):
    still = name in ("load-contact-18-36", "wear-18-36", "efficiency-helical-fzg-20-30")
    found, acting = idle(name, {}, of_case_and_parts, CASES | (STILL if still else {}), every=every)
    assert found == []
    assert acting >= 2
