"""A scenario resolved to TOML is the same scenario, and what is written with units arrives in SI."""

import dataclasses
import tempfile
from pathlib import Path
from typing import Any

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from tribodyn.errors import harmless
from tribodyn.studies.protocol.load import load_scenario

POSITIVE = st.floats(1e-3, 1e3)
LENGTHS = {"m": 1.0, "mm": 1e-3, "um": 1e-6, "inch": 0.0254}
TORQUES = {"N*m": 1.0, "kN*m": 1e3, "N*mm": 1e-3, "Nm": 1.0}
SPEEDS = {"rad/s": 1.0, "rpm": np.pi / 30}
ANGLES = {"rad": 1.0, "deg": np.pi / 180}


def zero_or_more(low: float, high: float) -> st.SearchStrategy[float]:
    """Zero, or of a magnitude that scenarios take, in the smallest unit too."""
    return st.floats(low, high).filter(lambda value: value == 0.0 or abs(value) > 1e-20)


def quantities(
    units: dict[str, float], numbers: st.SearchStrategy[float] = POSITIVE
) -> st.SearchStrategy[str]:
    return st.builds(lambda number, unit: f"{number!r} {unit}", numbers, st.sampled_from(sorted(units)))


CURVE = (
    st.lists(zero_or_more(0, 1e3), min_size=2, max_size=6, unique=True)
    .map(sorted)
    .flatmap(
        lambda times: st.fixed_dictionaries(
            {
                "time": st.fixed_dictionaries(
                    {"unit": st.sampled_from(["s", "ms"]), "values": st.just(times)}
                ),
                "torque": st.fixed_dictionaries(
                    {
                        "unit": st.sampled_from(sorted(TORQUES)),
                        "values": st.lists(zero_or_more(-1e6, 1e6), min_size=len(times), max_size=len(times)),
                    }
                ),
            }
        )
    )
)

HARMONIC = st.fixed_dictionaries(
    {"amplitude": quantities(TORQUES), "frequency": quantities({"Hz": 1, "kHz": 1, "rad/s": 1})},
    optional={"phase": quantities(ANGLES)},
)

OVERRIDES = st.fixed_dictionaries(
    {},
    optional={
        "title": st.text(st.characters(codec="utf-8")).map(harmless).map("a title ".__add__),
        "drive": st.sampled_from(["liu-ni-involute-23-47", "diez-ibarbia-18-36"]),
        "drive.module": quantities(LENGTHS),
        "drive.pinion.teeth": st.integers(5, 200),
        "drive.pinion.profile_shift": zero_or_more(-1, 1),
        "drive.gear.tip_radius": quantities(LENGTHS),
        "drive.gear.mass": quantities({"kg": 1, "g": 1}),
        "drive.gear.material": st.just("steel-diez-ibarbia"),
        "lubricant.inlet_viscosity": quantities({"Pa*s": 1, "mPa*s": 1, "cP": 1}),
        "bearings.pinion.stiffness_x": quantities({"N/m": 1, "N/um": 1}),
        "operating.pinion_speed": quantities(SPEEDS),
        "operating.gear_torque": quantities(TORQUES),
        "operating.gear_torque_table": CURVE,
        "operating.gear_torque_harmonics": st.lists(HARMONIC, max_size=3),
        "mesh.backlash": quantities(LENGTHS),
        "mesh.hertz": st.sampled_from(["linear", "load-dependent"]),
        "mesh.transmission_error.harmonics": st.lists(
            st.fixed_dictionaries({"order": st.integers(1, 9), "amplitude": quantities(LENGTHS)}), max_size=2
        ),
        "friction.law": st.sampled_from(["none", "masjedi-khonsari", "masjedi-khonsari-as-printed"]),
        "solver.rtol": st.floats(1e-12, 1e-3),
        "solver.cycles": st.integers(1, 10**6),
        "output.samples_per_cycle": st.integers(8, 10**4),
    },
)

SMALL = {"um": 1e-6, "mm": 1e-3, "inch": 0.0254}
DEVIATIONS = zero_or_more(-1e3, 1e3)
FLANKS = {
    **{
        f"drive.{gear}.modification.{name}": quantities(SMALL)
        for gear in ("pinion", "gear")
        for name in ("tip_relief", "tip_relief_length", "root_relief", "root_relief_length")
    },
    "drive.pinion.modification.tip_relief_shape": st.sampled_from(["linear", "parabolic"]),
    "drive.pinion.modification.crowning": quantities(SMALL),
    "drive.gear.modification.lead_relief_start": quantities(SMALL),
    "drive.gear.modification.lead_unmodified": quantities({"um": 1e-6}),
    "drive.pinion.modification.pitch_errors": st.lists(
        quantities(SMALL, DEVIATIONS), min_size=18, max_size=18
    ),
    "mesh.misalignment.in_plane": quantities({"arcmin": 1, "deg": 60, "mrad": 3}, DEVIATIONS),
    "mesh.misalignment.out_of_plane": quantities({"arcmin": 1, "deg": 60, "mrad": 3}, DEVIATIONS),
    "mesh.slices": st.integers(3, 501),
    "mesh.slice_coupling": st.booleans(),
    "operating.gear_torques": st.lists(POSITIVE, min_size=2, max_size=5, unique=True).map(
        lambda torques: [f"{torque!r} N*m" for torque in sorted(torques)]
    ),
}


def relieved(overrides: dict[str, Any]) -> bool:
    """Whether every relief has its length."""
    ends = [key for key in overrides if key.endswith("_relief")]
    return all(f"{key}_length" in overrides for key in ends)


def comparable(value: Any) -> Any:
    if dataclasses.is_dataclass(value) and not isinstance(value, type):
        return {field.name: comparable(getattr(value, field.name)) for field in dataclasses.fields(value)}
    if isinstance(value, tuple):
        return [comparable(item) for item in value]
    return value.tolist() if isinstance(value, np.ndarray) else value


def both(name: str, overrides: dict[str, Any]) -> tuple[Any, Any]:
    """The case of a scenario resolved and written, and of the scenario."""
    case = load_scenario(name, overrides)
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "resolved.toml"
        path.write_text(case.toml, encoding="utf-8", newline="")
        return load_scenario(path), case


@settings(max_examples=60, deadline=None)
@given(OVERRIDES)
def test_a_resolved_scenario_loads_to_the_same_case(overrides: dict[str, Any]):
    again, case = both("crc-23-47", overrides)
    assert comparable(again) == comparable(case)


@settings(max_examples=60, deadline=None)
@given(st.fixed_dictionaries({}, optional=FLANKS).filter(relieved))
def test_modified_flanks_load_to_the_same_case(overrides: dict[str, Any]):
    again, case = both("load-contact-18-36", overrides)
    assert comparable(again) == comparable(case)
    assert again.sha256 == case.sha256


@settings(max_examples=100, deadline=None)
@given(POSITIVE, st.sampled_from(sorted(LENGTHS)), POSITIVE, st.sampled_from(sorted(SPEEDS)))
def test_units_do_not_matter(length: float, length_unit: str, speed: float, speed_unit: str):
    case = load_scenario(
        "crc-23-47",
        {
            "drive.module": f"{length!r} {length_unit}",
            "operating.pinion_speed": f"{speed!r} {speed_unit}",
        },
    ).pair
    np.testing.assert_allclose(case.drive.module, length * LENGTHS[length_unit], rtol=1e-14)
    np.testing.assert_allclose(case.operating.pinion_speed, speed * SPEEDS[speed_unit], rtol=1e-14)
