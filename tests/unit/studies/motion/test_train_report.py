"""What is said of a train: which mesh, over which cycles, and its tables."""

from typing import Any

import numpy as np
import pytest

from tribodyn.post.verdict import LINES
from tribodyn.record.reader import Record
from tribodyn.studies.motion.report import OF_A_MESH, sentences, tables, verdict

FIRST = {
    "driver": "pinion-1",
    "driven": "wheel-1",
    "dynamic_factor": 1.2,
    "film_min": 6e-7,
    "power_friction_mean": 100.0,
    "efficiency": 0.997,
    "film_law": "masjedi-khonsari",
    "film_range": "none stated",
}
SECOND = FIRST | {
    "driver": "pinion-2",
    "dynamic_factor": 1.5,
    "film_min": 4e-7,
    "power_friction_mean": 300.0,
    "normal_backlash": 1e-4,
}
TRAIN = {
    "contact_loss_fraction": 0.0,
    "hertz_pressure_max": 1.1e9,
    "film_min": 4e-7,
    "film_parameter_min": 0.5,
    "power_in_mean": 40000.0,
    "power_friction_mean": 400.0,
    "averaging_cycles": 6,
    "common_period": 3,
    "worst_mesh": {"hertz_pressure_max": 1, "film_parameter_min": 2, "contact_loss_fraction": 2},
}


def record(meshes: dict[str, Any] | None = None, **changed: Any) -> Any:
    meshes = meshes or {"first": FIRST, "second": SECOND}
    of_record = {"names_meshes": True, "meshes": (*meshes,), "mesh_summaries": Record.mesh_summaries}
    summary = {"summary": TRAIN | {"meshes": meshes} | changed}
    return type("OfTrain", (dict,), of_record | summary)(mesh=np.array([*meshes]))


def test_the_verdict_names_the_meshes():
    assert verdict(record()) == [
        "Vibration raises the tooth forces to 1.20 (first) and 1.50 (second) times their mean; "
        "contact is never lost.",
        "The flanks press with up to 1.1 GPa (first); the oil film is at least 0.4 µm, 0.5 times the "
        "roughness (second): asperities carry much of the load.",
        "Friction takes 400 W of 40 kW, 1 %: 25 % in first and 75 % in second.",
        "To do: smoother flanks, thicker or cooler oil, or more speed raise the film.",
    ]


def test_of_many_meshes_it_names_the_worst():
    meshes = {f"m{number}": FIRST | {"dynamic_factor": 1.0 + number / 10} for number in range(1, 7)}
    moved, _, lost, *_ = verdict(record(meshes))
    assert (
        moved
        == "Vibration raises the tooth forces to at most 1.60 times their mean (m6); contact is never lost."
    )
    assert lost.endswith("1 %, most of it in m1: 17 %.")


def test_a_gear_that_turns_along_is_said_to_idle():
    """Its K_v is over a force of nearly nothing, its film that of a light load: neither asks for anything."""
    carries = {"power_in_mean": 40e3, "normal_load_max": 3e3, "contact_loss_fraction": 0.0}
    rattles = {"dynamic_factor": 11.0, "contact_loss_fraction": 0.6, "film_judged": {"low": 1.0}}
    rattles |= {"power_in_mean": 200.0, "normal_load_max": 80.0, "film_outside": 1.0}
    meshes = {"first": FIRST | carries, "second": SECOND | carries, "loose": FIRST | rattles}
    lift_off = {"contact_loss_fraction": 0.6, "worst_mesh": {"contact_loss_fraction": 3}}
    first, *others = verdict(record(meshes, **lift_off))
    assert first == (
        "Vibration raises the tooth forces to 1.20 (first) and 1.50 (second) times their mean; the teeth are "
        "apart for 60 % of the time in loose; loose idles."
    )
    assert "doubt" not in " ".join(others)
    assert others[-1].startswith("To do: smoother flanks")


def test_it_says_where_teeth_lift_off_and_a_law_is_in_doubt():
    judged = {"low": 0.9, "median": 1.0, "high": 1.1}
    doubtful = SECOND | {"film_judged": judged, "film_outside": 0.5, "contact_loss_fraction": 0.02}
    found = verdict(record({"first": FIRST, "second": doubtful}, contact_loss_fraction=0.02))
    assert "the teeth are apart for 2 % of the time in second" in found[0]
    assert found[3].startswith("Mesh second: film in doubt")
    assert found[4].startswith("To do:")
    assert len(found) <= LINES


def test_what_holds_for_all_meshes_is_said_once():
    law = "The film law masjedi-khonsari states no range of validity."
    assert sentences(record()).count(law) == 1
    other = record({"first": FIRST, "second": SECOND | {"film_law": "mine"}})
    assert f"{law[:-1]} (first)." in sentences(other)


@pytest.mark.parametrize(
    ("cycles", "said"),
    [
        (6, "the last 6 cycles of the mesh first: 2 common periods of all meshes."),
        (3, "the last 3 cycles of the mesh first: 1 common period of all meshes."),
        (1, "the last 1 cycle of the mesh first, less than the common period of 3 cycles."),
    ],
)
def test_it_says_over_which_cycles_means_are(cycles: int, said: str):
    assert f"Means are over {said}" in sentences(record(averaging_cycles=cycles))


def test_meshes_stand_beside_each_other():
    (table,) = tables(record())
    rows = {row[0]: row[1:] for row in table.rows}
    assert table.columns == ("", "first", "second", "")
    assert rows["driver"] == ["pinion-1", "pinion-2", ""]
    assert rows["Minimum film thickness"] == ["0.6", "0.4", "µm"]
    assert rows["Normal backlash"] == ["", "0.1", "mm"]
    assert "Mesh frequency" not in rows
    assert len({quantity.name for quantity in OF_A_MESH}) == len(OF_A_MESH)


def test_an_efficiency_that_cannot_be_is_withheld():
    second = SECOND | {"efficiency": None, "efficiency_withheld": "above 1"}
    (table,) = tables(record({"first": FIRST, "second": second}))
    rows = {row[0]: row[1:] for row in table.rows}
    assert rows["Efficiency"] == ["99.700", "withheld", "%"]


def test_many_meshes_have_several_tables():
    found = tables(record({f"m{number}": FIRST for number in range(9)}))
    assert [len(table.columns) for table in found] == [6, 6, 3]


def test_meshes_of_all_planets_have_one_column():
    of_set = {f"set-sun-{n}": FIRST | {"alike": "set-sun", "driven": f"planet-{n}"} for n in (1, 2, 3)}
    of_set["set-sun-2"] |= {"film_min": 5e-7, "normal_backlash": 1e-4}
    found = record({"first": SECOND, **of_set})
    (table,) = tables(found)
    rows = {row[0]: row[1:] for row in table.rows}
    assert table.columns == ("", "first", "set-sun-1 (and 2, 3)", "")
    assert rows["driven"] == ["wheel-1", "planet-1 (and 2, 3)", ""]
    assert rows["Minimum film thickness"] == ["0.4", "0.5 … 0.6", "µm"]
    assert rows["Normal backlash"] == ["0.1", "0.1", "mm"]
    assert "50 % in first and 50 % in set-sun-1 (and 2, 3)" in verdict(found)[2]
