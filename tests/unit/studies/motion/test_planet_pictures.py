"""Planetary sets as they are drawn: teeth interleave while the carrier turns; what is alike is said once."""

from pathlib import Path
from typing import Any

import numpy as np
import pytest
from matplotlib.path import Path as Closed

from tests.support.epicyclic_sets import MESHED, meshed_set, ravigneaux_set, stepped_set
from tests.support.outlines import distance, turned
from tests.support.planet_sets import IN_PHASE, SEQUENTIAL, planet_set, set_case
from tests.support.soak_parameters import all_in_soak
from tests.support.train_scenarios import case_of_table
from tribodyn.geometry.body import geometry_arrays
from tribodyn.post.figures.panel import View
from tribodyn.record.reader import Record
from tribodyn.studies.motion.check import check
from tribodyn.studies.motion.drivetrain.carried_sets import body_labels, mesh_labels, sets_of
from tribodyn.studies.motion.drivetrain.gear_positions import (
    contacts,
    gear_outlines,
    gear_poses,
    mesh_reach,
    mesh_turns,
    reaches,
    shifts,
)
from tribodyn.studies.motion.drivetrain.mesh_groups import between, together
from tribodyn.studies.motion.figures import DRAWINGS, displacements, mesh_forces
from tribodyn.studies.motion.pictures.planet_figures import planet_loads
from tribodyn.studies.motion.prepare import geometry_of, prepare
from tribodyn.studies.motion.report import mechanism, tables, verdict
from tribodyn.studies.motion.run import run

#: Chords of the outlines' points, m.
CHORD = 1e-6
STIFFNESS = 3e7
#: Of pins, N/m, as `planet_set` has them.
PIN_STIFFNESS = 3e8
#: Teeth, held, input and output: the sun drives the planets, and the ring does; stepped planets that fit
#: where they are turned by single pitches.
FLOWS = {
    "from sun": (planet_set, SEQUENTIAL, 3, "ring", ("sun", "carrier")),
    "from ring": (planet_set, SEQUENTIAL, 3, "sun", ("ring", "carrier")),
    "stepped": (stepped_set, (25, 35, 20, 80), 3, "carrier", ("sun", "ring")),
    "meshed": (meshed_set, MESHED, 3, "ring", ("sun", "carrier")),
    "ravigneaux": (ravigneaux_set, "second_sun", ("sun", "ring")),
}


@pytest.fixture(scope="module", params=all_in_soak(FLOWS, ("from ring", "stepped", "ravigneaux")))
def record(request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory) -> Record:
    make, *given = FLOWS[request.param]
    case = case_of_table(
        make(
            *given,
            floating=["sun"],
            solver={"cycles": 8},
            mesh={"damping_ratio": 0.2, "stiffness": f"{STIFFNESS} N/m"},
        )
    )
    folder: Path = tmp_path_factory.mktemp("set")
    return Record(run(case, folder / "set.h5").path)


def samples(record: Record) -> np.ndarray:
    """Some samples in the second half, when the set is under load."""
    return np.linspace(record.samples // 2, record.samples - 1, 3).astype(int)


def ends(record: Record, m: int) -> list:
    gears = {gear.number: gear for gear in gear_outlines(record)}
    return [gears[int(record.geometry[f"{end}_gear"][m])] for end in ("driver", "driven")]


def overlaps(record: Record, sample: int) -> list[float]:
    """By how much the teeth of every mesh are drawn within each other, m."""
    stand, gears = gear_poses(record)[:, sample], {gear.number: gear for gear in gear_outlines(record)}
    found = []
    for m in range(len(record["mesh"])):
        pair = [gears[int(record.geometry[f"{end}_gear"][m])] for end in ("driver", "driven")]
        one, two = sorted(pair, key=lambda gear: gear.outside)  # the ring is the second
        lines = [turned(gear.outline, stand[gear.number, 2]) + stand[gear.number, :2] for gear in (one, two)]
        pitch_point, reach = mesh_reach(record, m, float(mesh_turns(record, m)[sample]))
        near, mate = (line[np.hypot(*(line - pitch_point).T) < 1.5 * reach] for line in lines)
        inside = Closed(lines[1]).contains_points(near) != two.internal
        found.append(max((distance(point, mate) for point in near[inside]), default=0.0))
    return found


def test_teeth_overlap_by_what_they_give(record: Record):
    """By the transmission error of the pair in contact: with a wrong phase it would be millimetres."""
    error = np.nanmax(record["transmission_error_normal"], axis=2)
    for sample in samples(record):
        given = error[sample]
        np.testing.assert_allclose(overlaps(record, sample), given, rtol=0.02, atol=2.0 * CHORD)
        assert np.min(given) > 5.0 * CHORD


def test_contacts_lie_on_the_flanks(record: Record):
    """On the driver's as it is displaced; off the driven one's by at most the pair's transmission error.

    By less where a tip is near.
    """
    found, stand, sample = contacts(record), gear_poses(record), samples(record)[1]
    for m in range(len(record["mesh"])):
        for gear, share in zip(ends(record, m), (0.0, 1.0), strict=True):
            outline = turned(gear.outline, stand[gear.number, sample, 2]) + stand[gear.number, sample, :2]
            for pair in np.flatnonzero(np.isfinite(found[sample, m, :, 0])):
                apart = distance(found[sample, m, pair, :2], outline)
                given = share * record["transmission_error_normal"][sample, m, pair]
                assert apart < 1.02 * given + 2.0 * CHORD


def test_planets_ride_on_the_carrier(record: Record):
    """Their angle about its axis grows as the carrier's does, but for what the pins give."""
    (own,) = sets_of(record)
    stand = gear_poses(record)
    bodies = list(enumerate(record.geometry["gear_body"]))
    gear = {int(body): number for number, body in reversed(bodies)}  # of two the one in the sun's plane
    turning = record.geometry["sense"][own.carrier] * record["angle"][:, own.carrier]
    for planet in own.planets:
        x, y = (stand[gear[planet], :, :2] - record.geometry["centre"][own.carrier]).T
        apart = np.unwrap(np.arctan2(y, x)) - np.arctan2(y[0], x[0]) - turning
        assert np.ptp(apart) < 0.002
    assert (abs(turning[-1]) > 0.2) == (record.geometry["carried"][own.carrier] != 0)


def test_loads_push_the_driven_gears_on(record: Record):
    """About the driven axis, in its sense of turning against the carrier."""
    found, stand = contacts(record), gear_poses(record)
    for m in range(len(record["mesh"])):
        driven = ends(record, m)[1]
        arms = found[:, m, :, :2] - stand[driven.number, :, None, :2]
        way = found[:, m, :, 2]
        moment = arms[..., 0] * np.sin(way) - arms[..., 1] * np.cos(way)
        front = (record.geometry["sense"][driven.body] * moment)[:, np.array(record.pairs) <= 1]
        assert np.nanmin(front) > 0.0


def test_loads_of_planets_carry_the_torque(record: Record):
    """Mean force of all planets along the pitch tangent of the sun, by torque and radius."""
    (own,) = sets_of(record)
    half = slice(record.samples // 2, None)
    for meshes in own.meshes.values():
        loads = planet_loads(record, meshes)[half]
        forces = mesh_forces(record)[half][:, list(meshes)]
        angle = np.nanmean(record["pressure_angle"][half][:, list(meshes)])
        assert np.mean(loads) * np.cos(angle) == pytest.approx(np.mean(forces), rel=0.05)


def test_planets_move_in_their_pins_by_what_these_bear(record: Record):
    names = [str(name) for name in record["bearing"]]
    for planet in sets_of(record)[0].planets:
        pin = names.index(f"pin-{record['body'][planet]}")
        force = np.hypot(record["bearing_force_x"][-200:, pin], record["bearing_force_y"][-200:, pin])
        moved = displacements(record)[-200:, planet]
        # in the mean over the last mesh cycle, over which damping adds nothing
        assert np.mean(moved) * PIN_STIFFNESS == pytest.approx(np.mean(force), rel=0.02)


def test_what_is_alike_is_said_once(record: Record):
    (own,) = sets_of(record)
    pairs = len(own.planets) == 6
    members = {"sun", "ring"} | ({"second_sun", "planets"} if pairs else set())
    assert set(mesh_labels(record)) == {f"set-{member}-1 (and 2, 3)" for member in members}
    further = {"large", "step-1 (and 2, 3)"} if pairs else set()
    assert set(body_labels(record)) == {"sun", "ring", "carrier", "planet-1 (and 2, 3)"} | further
    stages, meshes, losses = tables(record)
    assert stages.columns == ("", "set", "")
    assert len(meshes.columns) == 2 + len(members)
    assert losses.title == "Losses by term and element"
    assert any("-1 (and 2, 3)" in line for line in verdict(record))


@pytest.mark.parametrize("record", ["from ring"], indirect=True)
def test_the_page_turns_with_the_carrier(record: Record):
    found = mechanism(record)
    assert len(found.bodies) == 6  # the carrier's lines, sun, ring, three planets
    assert [sight.label for sight in found.sights[:2]] == ["the whole train", "the set set from its carrier"]
    assert all(sight.turns[2] == 0 for sight in found.sights[1:])
    (ring,) = [body for body in found.bodies if np.any(np.isnan(body.outline)) and body is found.bodies[1]]
    radii = np.hypot(*ring.outline[~np.isnan(ring.outline[:, 0])].T)
    assert np.max(radii) > 1.05 * np.min(radii)


@pytest.mark.parametrize("record", ["from ring", "ravigneaux"], indirect=True)
@pytest.mark.parametrize("name", ["overview", "train", "planet-load", "bearing-load", "orbit", "modes"])
def test_figures_are_drawn(record: Record, name: str):
    assert DRAWINGS[name].fits(record)
    figure = DRAWINGS[name].draw([record], View())
    assert len(figure.axes) >= 2


def test_a_check_names_every_frequency_once():
    found = check(set_case(SEQUENTIAL, 4))
    titles = [table.title for table in found.every]
    assert sum(title.startswith("Gears, mesh") for title in titles) == 2
    (campbell,) = [table for table in found.tables if table.title.startswith("Campbell")]
    assert campbell.columns[1:4] == ("set", "set ×2", "set ×3")
    assert campbell.columns[4:] == ("set: planets pass ring", "set: planets pass sun")
    # 900 rpm of the sun, 25 and 83 teeth: the carrier makes 900 · 25/108 turns, and the sun the rest past it
    mode, _, _, _, at_ring, at_sun = (float(cell) for cell in campbell.rows[0])
    assert mode * 60.0 / at_ring == pytest.approx(4 * 25 / 108, rel=1e-3)
    assert mode * 60.0 / at_sun == pytest.approx(4 * 83 / 108, rel=1e-3)


def test_names_that_differ_by_a_number_are_put_together():
    assert together(["set-sun-1", "set-sun-2", "second", "set-sun-3"]) == "set-sun-1 (and 2, 3), second"
    assert together(["sun", "sun"]) == "sun"
    assert between(["1.0", "1.0"], [1.0, 1.01]) == "1.0"
    assert between(["-2", "-3"], [-2.0, -3.0]) == "-3 … -2"


def two_sets() -> Any:
    """What a record of two sets in series has before a run."""
    table, second = planet_set(SEQUENTIAL), planet_set(IN_PHASE)
    for name, gear in second["gear"].items():
        table["gear"][f"{name}-b"] = gear
    names = {key: f"{key}-b" for key in ("sun", "planet", "ring", "carrier")}
    table["stage"] += [second["stage"][0] | names | {"name": "second"}]
    table["body"] += [second["body"][0] | {"name": "carrier-b"}]
    table["link"] = [{"ends": ["carrier", "sun-b"], "stiffness": "1e6 N*m/rad"}]
    table["operating"]["output"] = "carrier-b"
    prepared = prepare(case_of_table(table))
    shapes = {
        mesh.name: geometry_arrays(made.assembly)
        | {"pinion_teeth": made.cycle.pinion_teeth, "roll_start": 0.0}
        for mesh, made in zip(prepared.case.meshes, prepared.tables, strict=True)
    }
    content = {"geometry": geometry_of(prepared), "of_mesh": lambda _, mesh, group: shapes[mesh]}
    return type("OfTrain", (dict,), content | {"meshes": tuple(shapes), "names_meshes": True})(
        mesh=list(shapes), body=list(prepared.names), gear=[gear.name for gear in prepared.case.gears]
    )


def test_sets_on_one_axis_stand_beside_each_other():
    found = two_sets()
    assert [own.name for own in sets_of(found)] == ["set", "second"]
    where = reaches(found)
    where[:, :2] += shifts(found)
    rings = [number for number, name in enumerate(found["gear"]) if name.startswith("ring")]
    (x, _, radius), (other_x, _, other_radius) = where[rings]
    assert other_x - x > radius + other_radius
    np.testing.assert_array_equal(where[:, 1], 0.0)
    for gear, name in enumerate(found["gear"]):
        ring = rings[int(name.endswith(("-b", "-b-1", "-b-2", "-b-3")))]
        assert abs(where[gear, 0] - where[ring, 0]) < 1e-12
        assert where[gear, 2] <= where[ring, 2]
