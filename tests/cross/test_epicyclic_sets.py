"""Epicyclic sets with two planets on every arm: speeds, torques, teeth, forces, energy, by second methods."""

from fractions import Fraction
from itertools import permutations
from math import pi

import numpy as np
import pytest

from tests.support.epicyclic_sets import (
    MESHED,
    RAVIGNEAUX,
    STEPPED,
    meshed_set,
    ravigneaux_set,
    stepped_set,
)
from tests.support.planet_sets import planet_set
from tests.support.train_scenarios import case_of_table
from tribodyn.errors import InputError
from tribodyn.gears.case import STAGES
from tribodyn.record.reader import Record
from tribodyn.signals.lines import FAULT
from tribodyn.studies.motion.frequencies import lines_of, of_sets
from tribodyn.studies.motion.planetary.powers import flow_of
from tribodyn.studies.motion.prepare import prepare
from tribodyn.studies.motion.run import run
from tribodyn.train.planetary import MEMBERS, SetTeeth, check_assembly

LOAD = 600.0


def turning(case):
    """Speeds of the bodies by their names, counter-clockwise, over the input's."""
    signed = {body.name: body.ratio * body.sense for body in case.bodies}
    source = signed[case.bodies[case.source.body].name]
    return {name: speed / source for name, speed in signed.items()}


def willis_of_stepped(teeth):
    """Factors by which speeds add up to nothing, and to which torques are in proportion."""
    sun, planet, step, ring = teeth
    factors = {"sun": sun * step, "ring": ring * planet}
    return factors | {"carrier": -sum(factors.values())}


def willis_of_meshed(teeth):
    """The same: two planets between sun and ring turn both the same way."""
    factors = {"sun": teeth[0], "ring": -teeth[3]}
    return factors | {"carrier": -sum(factors.values())}


@pytest.mark.parametrize(
    ("kind", "held", "driving"),
    [
        *(("stepped", *two) for two in permutations(MEMBERS, 2)),
        *(("meshed", *two) for two in (("ring", "sun"), ("sun", "carrier"), ("carrier", "ring"))),
    ],
)
def test_sets_turn_by_willis(kind, held, driving):
    (driven,) = (member for member in MEMBERS if member not in (held, driving))
    make, teeth, willis = {
        "stepped": (stepped_set, STEPPED, willis_of_stepped),
        "meshed": (meshed_set, MESHED, willis_of_meshed),
    }[kind]
    factors = willis(teeth)
    case = case_of_table(make(teeth, held=held, ends=(driving, driven)))
    speeds = turning(case)
    assert speeds[held] == 0
    assert speeds[driven] == Fraction(-factors[driving], factors[driven])
    first = speeds["planet-2"] - speeds["carrier"]
    assert first == -Fraction(teeth[0], teeth[1]) * (speeds["sun"] - speeds["carrier"])
    if kind == "meshed":
        assert speeds["step-3"] - speeds["carrier"] == -Fraction(teeth[1], teeth[2]) * first
    # torques: in, and through all meshes at the sun and at the ring, of what is on the output
    torque = LOAD / abs(factors[driven])
    assert case.source.torque == pytest.approx(torque * abs(factors[driving]), rel=1e-9)
    for member, own in (("sun", teeth[0]), ("ring", teeth[3])):
        meshes = [mesh for mesh in case.meshes if f"-{member}-" in mesh.name]
        ratio = {m.name: abs(case.gears[m.gears[1]].teeth) / own for m in meshes}
        on_member = sum(float(mesh.pair.operating.gear_torque) / ratio[mesh.name] for mesh in meshes)
        assert on_member == pytest.approx(torque * abs(factors[member]), rel=1e-9)


@pytest.mark.parametrize(
    ("held", "driving", "driven", "idle", "ratio", "published"),
    [
        ("carrier", "sun", "ring", "large", Fraction(72, 30), 2.40),
        ("second_sun", "sun", "ring", None, (1 + Fraction(36, 30)) / (1 + Fraction(36, 72)), 1.47),
        ("second_sun", "carrier", "ring", "sun", 1 / (1 + Fraction(36, 72)), 0.67),
        ("carrier", "large", "ring", "sun", -Fraction(72, 36), -2.00),
    ],
)
def test_gears_of_a_ravigneaux_set(held, driving, driven, idle, ratio, published):
    """Closed forms by Willis, and the four ratios that are published of Ford's AOD (transmissions101.com)."""
    load = [{"at": idle, "torque": "1 N*m"}] if idle else []
    case = case_of_table(ravigneaux_set(held, (driving, driven), load=load))
    speeds = turning(case)
    assert 1 / speeds[driven] == ratio
    assert float(ratio) == pytest.approx(published, abs=0.005)
    assert speeds["large" if held == "second_sun" else held] == 0
    # all meshes have one frequency, in the carrier's frame
    rolling = {name: abs(speeds[name] - speeds["carrier"]) for name in speeds}
    for name, teeth in zip(("sun", "planet-1", "step-1", "ring", "large"), RAVIGNEAUX, strict=True):
        assert teeth * rolling[name] == RAVIGNEAUX[3] * rolling["ring"]
    assert all(mesh.rate == 1 for mesh in case.meshes)
    # the power of all members adds up to nothing
    idling = abs(float(speeds[idle])) if idle else 0.0
    assert case.source.torque == pytest.approx(LOAD * abs(float(speeds[driven])) + idling, rel=1e-9)


@pytest.mark.parametrize(
    ("held", "idle", "driving", "driven", "ratio", "published"),
    [
        ("carrier-2", None, "ring", "carrier", 2 + Fraction(32, 62), 2.52),
        ("sun-2", "carrier-2", "ring", "carrier", 1 + Fraction(32, 62), 1.52),
        ("carrier-2", "ring", "sun", "carrier", -Fraction(62, 32), -1.94),
    ],
)
def test_gears_of_a_simpson_train(held, idle, driving, driven, ratio, published):
    """Two plain sets on one sun; the carrier of the first turns with the ring of the second.

    Closed forms by Willis, and the ratios that are published of General Motors' Turbo-Hydramatic 350.
    """
    load = [{"at": idle, "torque": "1 N*m"}] if idle else []
    table = planet_set((32, 15, 62), 2, ends=(driving, driven), load=load)
    (first,), size = table["stage"], {"face_width": "30 mm"}
    names = {name: f"{name}-2" for name in ("sun", "planet", "ring", "carrier")}
    member = held.removesuffix("-2")
    del first["held"]
    table["stage"] = [first, first | names | {"name": "second", "held": member}]
    gears = {name: gear | size for name, gear in table["gear"].items()}
    gears["planet"] |= {"bore_diameter": "20 mm"}
    table["gear"] = gears | {names[name]: gear for name, gear in gears.items()}
    table["body"] += [table["body"][0] | {"name": "carrier-2"}]
    joined = (("sun", "sun-2"), ("carrier", "ring-2"))
    table["link"] = [{"ends": list(ends), "stiffness": "1e6 N*m/rad"} for ends in joined]
    case = case_of_table(table)
    speeds = turning(case)
    assert 1 / speeds[driven] == ratio
    assert float(ratio) == pytest.approx(published, abs=0.006)


def test_stepped_planets_have_two_mesh_frequencies():
    case = case_of_table(stepped_set(STEPPED))
    speeds = turning(case)
    expected = {
        name: 15.0 * teeth * abs(float(speeds[name] - speeds["carrier"]))
        for name, teeth in (("sun", STEPPED[0]), ("ring", STEPPED[3]))
    }
    found = of_sets(prepare(case))["set"]
    assert found.mesh == pytest.approx(expected["sun"], rel=1e-12)
    assert found.planet_pass == pytest.approx(3 * expected["ring"] / STEPPED[3], rel=1e-12)
    assert found.planet_pass == pytest.approx(3 * 15.0 * float(speeds["carrier"]), rel=1e-12)
    rates = {mesh.name[4:7]: float(mesh.rate) for mesh in case.meshes}
    assert rates["rin"] / rates["sun"] == pytest.approx(expected["ring"] / expected["sun"], rel=1e-12)


def test_teeth_of_every_gear_meet_their_mates_as_often_as_these_pass():
    """Of gears on the axis: planets past them; of planets: their own turns in the carrier's frame."""
    case = case_of_table(ravigneaux_set())
    speeds, arms = turning(case), 3
    passing = {name: abs(float(speeds[name] - speeds["carrier"])) for name in speeds}
    orders = {line.name: line.order for line in lines_of(prepare(case)) if line.sort == FAULT}
    expected = {"sun": arms * passing["sun"], "second sun": arms * passing["large"]}
    expected |= {"planet": passing["planet-1"], "second planet": passing["step-1"]}
    for name, order in expected.items():
        found = orders.get(f"{name} tooth of set")
        if found is None:  # one line for what is equal
            assert any(other == pytest.approx(order, rel=1e-12) for other in orders.values())
        else:
            assert found == pytest.approx(order, rel=1e-12)


def test_stepped_planets_fit_where_one_of_their_places_does(rng):
    """Every place of a planet tried: turned about its axis by pitches, with its first gear in its gaps."""
    fitted = 0
    for _ in range(200):
        sun, planet, step = (int(teeth) for teeth in rng.integers(12, 40, 3))
        ring, count = int(rng.integers(60, 130)), int(rng.integers(2, 6))
        about = 2.0 * pi / count
        turned = (sun * about + 2.0 * pi * np.arange(planet)) / planet
        beside = (step * turned + ring * about) / (2.0 * pi)
        missed = float(np.min(np.abs(beside - np.round(beside))))
        teeth = SetTeeth(sun, planet, -ring, step, "stepped")
        if abs(missed - 0.01) < 1e-9:
            continue
        if missed < 0.01:
            fitted += 1
            check_assembly(teeth, [0.0, about], "planets")
        else:
            with pytest.raises(InputError, match="pitches beside the gaps"):
                check_assembly(teeth, [0.0, about], "planets")
    assert 10 < fitted < 190


#: By the method whose machine code for trains other tests have; "auto" would take another for some.
SHORT = {"frame_forces": False, "solver": {"cycles": 14, "method": "dopri5"}}
SETS = {
    "stepped": stepped_set((25, 35, 20, 80), **SHORT),
    "meshed": meshed_set(**SHORT),
    "ravigneaux": ravigneaux_set(**SHORT),
}
#: Torques of the carriers of these: the last one's turns freely.
ON_CARRIER = {"stepped": LOAD, "meshed": LOAD, "ravigneaux": 0.0}


@pytest.fixture(scope="module", params=list(SETS))
def record(request, tmp_path_factory):
    case = case_of_table(SETS[request.param])
    result = run(case, tmp_path_factory.mktemp("set") / "set.h5")
    assert result.status == "complete"
    return case, Record(result.path)


def test_energy_closes_and_planets_share(record):
    _, found = record
    summary = found.summary
    stage = summary[STAGES]["set"]
    assert abs(summary["energy_residual"]) < 1e-6
    assert stage["power_friction_mean"] == pytest.approx(summary["power_friction_mean"], rel=1e-9)
    np.testing.assert_allclose(stage["planet_shares"], 1.0 / 3.0, atol=2e-3)


def test_efficiency_is_that_of_slow_rotation(record):
    """Of the motion's friction, against the quasi-static losses of all meshes by Willis."""
    case, found = record
    flow = flow_of(prepare(case))
    lost = 1.0 - found.summary[STAGES]["set"]["efficiency"]
    assert lost == pytest.approx(1.0 - flow.efficiency, rel=0.1)


def test_pins_bear_what_the_carrier_passes_on(record):
    """Their moment about the axis is the carrier's torque, and their sum no force."""
    case, found = record
    names = [str(name) for name in found["bearing"]]
    bodies = {body.name: body for body in case.bodies}
    part = slice(-(found.samples // 2), None)
    moment, push = 0.0, np.zeros(2)
    for place, name in enumerate(names):
        if name.startswith("pin-"):
            x, y = bodies[name.removeprefix("pin-")].centre
            force = np.array([np.mean(found[f"bearing_force_{way}"][part, place]) for way in "xy"])
            moment += x * force[1] - y * force[0]
            push += force
    assert abs(moment) == pytest.approx(ON_CARRIER[case.sets[0].teeth.kind], abs=2e-2 * LOAD)
    assert np.hypot(*push) < 1e-2 * LOAD / 0.09


@pytest.mark.parametrize(
    ("changes", "key", "said"),
    [
        ({"second_planet": None}, "stage.0.second_planet", "missing"),
        ({"type": "planetary"}, "stage.0.second_planet", "is there"),
        ({"type": "ravigneaux"}, "stage.0.second_sun", "missing"),
        ({"held": "second_sun"}, "stage.0.held", "has none"),
        ({"helix_angle": "10 deg"}, "stage.0.helix_angle", "spur"),
        ({"family": "cycloidal"}, "stage.0.family", "involutes"),
        ({"second_planet": "planet"}, "stage.0.planet", "named twice"),
        ({"second_planet": "ring"}, "stage.0.second_planet", "external gear"),
        ({"second_planet": "steps"}, "stage.0.second_planet", "step"),
        (
            {"planets": 4, "angles": ["0 deg", "90 deg", "180 deg", "270.2 deg"]},
            "stage.0.angles",
            "270.316 deg",
        ),
        ({"planets": 5}, "stage.0.planets", "overlap"),
        ({"bearings": {"step": {"stiffness_x": "1e8 N/m"}}}, "bearings.step", "name planet"),
        ({"operating": {"output": "step"}}, "operating.output", "is a planet"),
    ],
)
def test_what_is_no_stepped_set_is_refused(changes, key, said):
    changes = {name: value for name, value in changes.items() if value is not None}
    table = stepped_set(STEPPED, **changes)
    if not changes:
        del table["stage"][0]["second_planet"]
    with pytest.raises(InputError) as caught:
        case_of_table(table)
    assert key in str(caught.value)
    assert said in str(caught.value)


@pytest.mark.parametrize(
    ("changes", "key", "said"),
    [
        ({"teeth": (30, 18, 18, 72, 37)}, "stage.0.planets", "(37 + 72)"),
        ({"teeth": (31, 18, 18, 72, 36)}, "stage.0.planets", "(72 − 31)"),
        ({"teeth": (36, 18, 18, 72, 36)}, "gear.step", "overlaps that of sun"),
        ({"planets": 6}, "gear.step", "overlaps that of planet-"),
        ({"teeth": (60, 12, 18, 240, 204)}, "stage.0.second_planet", "no such triangle"),
        ({"centre_distance": "81 mm"}, "stage.0.centre_distance", "one of three"),
        ({"radial_pin_errors": ["1 um", "0 um", "0 um"]}, "stage.0.radial_pin_errors", "not modelled"),
        ({"second_module": "2 mm"}, "stage.0.second_module", "one module"),
        ({"held": "carrier"}, "load", "large of the planetary stage set idles"),
        ({"type": "meshed"}, "stage.0.second_sun", "is there"),
    ],
)
def test_what_is_no_ravigneaux_set_is_refused(changes, key, said):
    with pytest.raises(InputError) as caught:
        case_of_table(ravigneaux_set(**changes))
    assert key in str(caught.value)
    assert said in str(caught.value)
