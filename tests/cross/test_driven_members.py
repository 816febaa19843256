"""Planetary sets of which no member is held: a second one keeps a speed, and its torque follows."""

import numpy as np
import pytest

from tests.support.epicyclic_sets import meshed_set, ravigneaux_set
from tests.support.planet_sets import planet_set
from tests.support.right_hand_sides import assert_right_hand_sides_agree, at_several_conditions
from tests.support.states import altered
from tests.support.train_scenarios import case_of_table
from tribodyn.errors import InputError
from tribodyn.record.reader import Record
from tribodyn.studies.motion.check import check
from tribodyn.studies.motion.planetary.powers import flow_of
from tribodyn.studies.motion.prepare import prepare
from tribodyn.studies.motion.run import run
from tribodyn.train.structure import BRAKES, DRIVES


def free_set(ends, given, speed, torque="600 N*m", **changes):
    """The set with no member held; `given` are loads that keep a speed, by name and ratio."""
    operating = {"input_speed": f"{speed} rpm", "output_torque": torque}
    table = planet_set(ends=ends, frame_forces=False, operating=operating, **changes)
    del table["stage"][0]["held"]
    table["load"] = [
        {"at": name, "speed_ratio": ratio, "damping_ratio": 0.05} for name, ratio in given.items()
    ]
    return table


@pytest.fixture(scope="module")
def ran(tmp_path_factory):
    folder = tmp_path_factory.mktemp("driven")

    def of(table, name):
        path = folder / f"{name}.h5"
        table["solver"] = {"cycles": 6, "method": "dopri5"}  # by what other trains have
        assert run(case_of_table(table), path).status == "complete"
        return Record(path)

    return of


def test_speeds_that_all_members_have_more_change_no_load(ran):
    """Seen from a frame that turns with the ring it is held: teeth, oil and springs cannot tell.

    The ring then turns the way of the carrier and slower, backwards against the sense in which it rolls.
    """
    held = planet_set(frame_forces=False, operating={"input_speed": "900 rpm"})
    both = ran(held, "held"), ran(free_set(("sun", "carrier"), {"ring": "1/10"}, 1000), "turning")
    one, two = (record["normal_load"] for record in both)
    assert np.nanmax(np.abs(one - two)) < 1e-5 * np.nanmax(one)
    one, two = (record["work_friction"][-1] for record in both)
    assert two == pytest.approx(one, rel=1e-6)


@pytest.mark.parametrize(
    ("ends", "given", "speed", "torque", "into", "out"),
    [
        # sun 1000 and ring 100 rpm drive the carrier at 300: 133 N m and 467 N m
        (("sun", "carrier"), {"ring": 0.1}, 1000, "600 N*m", 133.3 * 1000 + 466.7 * 100, 600 * 300),
        # sun 1000 rpm against the ring at −100 rpm
        (("sun", "carrier"), {"ring": "-1/10"}, 1000, "600 N*m", 133.3 * 1000, 600 * 144.4 + 466.7 * 100),
        # carrier 300 rpm to sun and ring, whose load turns it slower than the carrier
        (("carrier", "ring"), {"sun": "10/3"}, 300, "466.7 N*m", 600 * 300, 133.3 * 1000 + 466.7 * 100),
    ],
    ids=["summing", "against", "splitting"],
)
def test_power_in_is_power_out_and_losses(ran, ends, given, speed, torque, into, out):
    table = free_set(ends, given, speed, torque)
    record = ran(table, f"{ends[0]}-{len(str(given))}")
    work = {name: record[f"work_{name}"][-1] for name in ("in", "out", "friction", "damping")}
    gained = record["stored_energy"][-1] - record["stored_energy"][0]
    lost = work["friction"] + work["damping"]
    residual = work["in"] - work["out"] - lost + record["work_parametric"][-1] - gained
    assert abs(residual) < 1e-6 * work["in"]
    assert abs(record.summary["energy_residual"]) < 1e-6
    time = record["time"][-1] - record["time"][0]
    rpm = np.pi / 30.0
    assert work["out"] / time == pytest.approx(out * rpm, rel=0.02)
    assert work["in"] / time == pytest.approx(into * rpm, rel=0.02)
    flow = flow_of(prepare(case_of_table(table)))  # in slow rotation, by Willis
    assert flow is not None
    assert flow.put_in == pytest.approx(flow.taken_out + sum(flow.loss), rel=1e-9)
    assert sum(flow.loss) == pytest.approx(record.summary["power_friction_mean"], rel=0.02)


def test_torques_of_members_are_those_of_willis():
    """Whichever of two members bears the load and which keeps its speed: 24 : 84 : 108."""
    case = case_of_table(free_set(("carrier", "ring"), {"sun": "10/3"}, 300, "466.6666667 N*m"))
    other = case_of_table(free_set(("carrier", "sun"), {"ring": "1/3"}, 300, "133.3333333 N*m"))
    assert case.source.torque == pytest.approx(600.0)
    assert other.source.torque == pytest.approx(600.0)
    loads = [[mesh.pair.operating.gear_torque for mesh in each.meshes] for each in (case, other)]
    np.testing.assert_allclose(loads[0], loads[1], rtol=1e-9)
    table = free_set(("carrier", "ring"), {"sun": "10/3"}, 300)
    del table["operating"]["output_torque"]
    table["operating"]["input_torque"] = "600 N*m"
    assert case_of_table(table).loads[0].torque == pytest.approx(600.0 * 84 / 108)


@pytest.mark.parametrize(
    ("table", "kept", "torque"),
    [
        # a ring with twice the teeth of the sun: sun and carrier bear 600 N m each, in a curve
        (
            meshed_set((48, 16, 17, 96), 3, "sun", ("ring", "carrier")),
            {"at": "sun", "speed_ratio": "6/5"},
            1200,
        ),
        # 2.4 T_s - 2 T_l = 600 = T_s + T_l: the carrier is free
        (ravigneaux_set(), {"at": "large", "speed_ratio": "-1/10"}, 600 * 15 / 22),
    ],
    ids=["differential", "ravigneaux"],
)
def test_sets_of_two_planets_on_every_arm_have_two_driven_members_too(ran, table, kept, torque, request):
    table["stage"][0] |= {"frame_forces": False}
    del table["stage"][0]["held"]
    table["load"] = [kept]
    assert case_of_table(table).source.torque == pytest.approx(torque, rel=1e-9)
    record = ran(table, request.node.callspec.id)
    assert abs(record.summary["energy_residual"]) < 1e-6


def test_check_says_torques_and_powers_of_all_members():
    """Without friction 24 : 84 : −108, and the powers add up."""
    table = free_set(("sun", "carrier"), {"ring": "-1/10"}, 1000, "108 N*m", friction={"law": "none"})
    del table["friction"]["coefficient"]
    checked = check(case_of_table(table))
    flow = checked.data["power_flow"]
    members = flow["members"]["set"]
    torques = [members[name]["torque"] for name in ("sun", "ring", "carrier")]
    assert torques == pytest.approx([24.0, 84.0, -108.0])
    assert sum(member["power"] for member in members.values()) == pytest.approx(0.0, abs=1e-9)
    assert flow["put_in"] == pytest.approx(members["sun"]["power"])
    assert (flow["efficiency"], flow["taken_out"]) == pytest.approx((1.0, flow["put_in"]))
    assert any(table.title.startswith("Power flow by Willis") for table in checked.tables)


@pytest.mark.slow
def test_every_compiler_makes_the_same_of_what_keeps_a_speed(prepared, rng):
    """Of a pair whose gear is kept at its speed too."""
    model = prepared("crc-23-47", **{"friction.law": "none", "operating.source": "torque"}).model
    stiffness = model.links.stiffness.copy()
    stiffness[:, 2] = 3e4
    model = altered(model, links={"stiffness": stiffness})
    layout = model.layout._replace(holds=type(model.layout.holds)([DRIVES, BRAKES]))
    model = model._replace(options=model.options._replace(layout=layout))
    assert_right_hand_sides_agree(at_several_conditions(model), rng, rtol=1e-11)


@pytest.mark.parametrize(
    ("loads", "key", "words"),
    [
        ([], "stage.0", "does not fix how fast ring and carrier turn: 1 more must be known; hold one"),
        (
            [{"at": "ring", "speed_ratio": 0.1}, {"at": "sun", "speed_ratio": 0.5}],
            "load.1.speed_ratio",
            "sun turns at 1 of the input's speed already",
        ),
        ([{"at": "ring", "speed_ratio": 1.0}], "stage.0", "turns as one body at these speeds"),
        ([{"at": "ring", "speed_ratio": "1/0"}], "load.0.speed_ratio", "not a share of the input's speed"),
        ([{"at": "ring", "speed_ratio": 0}], "load.0.speed_ratio", "not a share of the input's speed"),
        ([{"at": "ring"}], "load.0.torque", "missing"),
        ([{"at": "ring", "speed_ratio": 0.1, "torque": "1 N*m"}], "load.0.torque", "contradicts speed_ratio"),
        (
            [{"at": "ring", "torque": "1 N*m", "stiffness": "1e5 N*m/rad"}],
            "load.0.stiffness",
            "no speed_ratio",
        ),
    ],
)
def test_speeds_that_are_open_or_given_twice_are_refused(loads, key, words):
    table = free_set(("sun", "carrier"), {}, 1000)
    table["load"] = loads
    with pytest.raises(InputError) as caught:
        case_of_table(table)
    first = getattr(caught.value, "errors", [caught.value])[0]
    assert first.key == key
    assert words in str(first)
