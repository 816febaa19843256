"""Damaged teeth: what they do to the quasi-static transmission error, and to their own flanks only."""

from typing import Any

import numpy as np
import pytest

import tribodyn as td
from tests.support.own_teeth import errors, made
from tribodyn.compliance.crack import crack_compliance
from tribodyn.mesh.teeth.damage.gear import DamagedTeeth, damaged_gear
from tribodyn.mesh.teeth.fields import LEADING, TRAILING
from tribodyn.mesh.teeth.table import places_of
from tribodyn.studies.motion.prepare import prepare as prepare_train

NAME, TEETH, TOOTH = "involute-23-47", 23, 6
WHOLE = {"gear": "pinion", "tooth": TOOTH + 1}


def damaged(*damage: dict[str, Any], name: str = NAME, **more: Any):
    return made(name, {"damage": [WHOLE | each for each in damage], **more})


def fields_of(case, flank: int, tooth: int = TOOTH):
    (own,) = case.warm_pairs[0].teeth[0]
    assert isinstance(own, DamagedTeeth)
    gear = damaged_gear(case.assembly, case.warm_pairs[0].materials, "pinion", solved=False)
    places = places_of(case.assembly, case.warm_pairs[0].mesh, case.cycle)[0].driver
    return places, gear, own.in_mesh(gear).fields(tooth, flank, places)


@pytest.mark.parametrize("name", [NAME, "helical-23-47"])
def test_a_cracked_tooth_shows_once_in_a_revolution_and_at_no_other_time(name: str):
    """Of a revolution of the pinion and part of the next: the same error but where the tooth carries."""
    case, plain = damaged({"kind": "crack", "depth": "1.5 mm"}, name=name), made(name, {})
    pairs = case.cycle.front_pairs
    for phase in (0.2, 0.7) if name == NAME else (0.7,):
        at = np.arange(TEETH + TOOTH + 3) + phase
        found = errors(case.model, at) - errors(plain.model, np.array([phase]))
        carries = np.zeros(len(at), dtype=bool)
        for age in range(pairs):  # pair `age` is the tooth that entered so many cycles ago
            carries |= (np.arange(len(at)) - age) % TEETH == TOOTH
        assert np.all(np.abs(found[~carries]) < 1e-12)
        assert np.abs(found[carries]).max() > 1e-7
        np.testing.assert_allclose(found[: TOOTH + 3], found[TEETH:], rtol=0, atol=1e-12)


def test_where_the_cracked_tooth_carries_alone_it_deflects_by_what_the_crack_adds():
    case, plain = damaged({"kind": "crack", "depth": "1.5 mm"}), made(NAME, {})
    ratio = float(case.assembly.contact_ratio)
    age = 0.5 * (ratio - 1.0) + 0.5  # pitches since entering, in the middle of single contact
    at = np.array([TOOTH + age])
    found = (errors(case.model, at) - errors(plain.model, np.array([age % 1.0])))[0]
    places, gear, own = fields_of(case, LEADING)
    start, end = case.assembly.roll_limits
    roll = start + float(case.assembly.pitch_angle) * age
    added = np.interp(roll, places.roll, own.compliance[0])
    r = case.assembly.path.signed_distance(roll)
    cosine = float(np.cos(case.assembly.path.pressure_angle(r)))
    load = case.warm_pairs[0].operating.gear_torque / (float(case.assembly.path.gear_pitch_radius) * cosine)
    assert roll < end
    assert found == pytest.approx(load * added / cosine, rel=2e-3)
    crack = case.warm_pairs[0].teeth[0][0].damage[0].crack
    expected = crack_compliance(
        gear.loaded, gear.materials[0], gear.width, np.array([float(r)]), crack, np.array([crack.depth])
    )
    assert added == pytest.approx(expected[0, 0], rel=1e-3)


def test_a_crack_is_of_the_flank_whose_load_opens_it():
    case = damaged({"kind": "crack", "depth": "1.5 mm"})
    assert fields_of(case, TRAILING)[2] is None
    assert fields_of(case, LEADING, TOOTH + 1)[2] is None
    other = damaged({"kind": "crack", "depth": "1.5 mm", "flank": "trailing"})
    assert fields_of(other, LEADING)[2] is None


def test_strips_of_a_cracked_tooth_bend_beside_each_other():
    """A crack over a part of the face: between none and all of it, and nothing where it has no depth."""
    whole = fields_of(damaged({"kind": "crack", "depth": "1.5 mm"}), LEADING)[2].compliance
    half = fields_of(damaged({"kind": "crack", "depth": "1.5 mm", "width": "10 mm"}), LEADING)[2].compliance
    falling = fields_of(damaged({"kind": "crack", "depth": "1.5 mm", "deepest": "+z"}), LEADING)[2].compliance
    shallow = fields_of(damaged({"kind": "crack", "depth": "1e-6 mm"}), LEADING)[2].compliance
    assert np.all((half > 0.0) & (half < 0.6 * whole))
    assert np.all((falling > 0.3 * whole) & (falling < whole))
    assert np.abs(shallow).max() < 1e-9 * whole.min()


@pytest.mark.parametrize("depth", [5e-6, 15e-6])
def test_a_spall_over_the_face_is_the_gap_that_it_is(depth: float):
    """In slow rotation, in the middle of single contact, where the tooth carries alone."""
    spall = {"kind": "spall", "depth": f"{1e6 * depth} um", "height": 0.5, "length": "3 mm"}
    case, plain = damaged(spall), made(NAME, {})
    age = 0.5 * float(case.assembly.contact_ratio)
    found = errors(case.model, np.array([TOOTH + age])) - errors(plain.model, np.array([age % 1.0]))
    cosine = float(np.cos(case.assembly.path.pressure_angle(0.0)))
    assert found[0] == pytest.approx(depth / cosine, rel=1e-3)


def test_a_spall_on_a_part_of_the_face_softens_and_leaves_the_error_of_an_unloaded_tooth():
    spall = {"kind": "spall", "depth": "0.2 mm", "height": 0.5, "length": "3 mm", "width": "6 mm"}
    _, _, own = fields_of(damaged(spall), LEADING)
    assert np.all(own.gap == 0.0)
    assert own.compliance.max() > 0.0
    assert own.compliance[0, 0] == own.compliance[0, -1] == 0.0
    wider = fields_of(damaged(spall | {"width": "12 mm"}), LEADING)[2]
    assert np.all(wider.compliance >= own.compliance)


def test_a_map_is_the_patch_that_it_draws():
    """Over the whole face: the gap is the map, linear between its points."""
    height = [0.0, 0.3, 0.31, 0.69, 0.7, 1.0]
    depth = [0.0, 0.0, 30.0, 30.0, 0.0, 0.0]
    columns = {
        "height": {"unit": "1", "values": height},
        "face": {"unit": "mm", "values": [0.0] * 6},
        "depth": {"unit": "um", "values": depth},
    }
    places, _, own = fields_of(damaged({"kind": "spall", "map": columns}), LEADING)
    low, high = places.distance[0], places.distance[-1]
    share = (places.distance - low) / (high - low)
    np.testing.assert_allclose(own.gap[0], 1e-6 * np.interp(share, height, depth), rtol=0, atol=1e-12)


def test_a_pit_is_a_round_spot():
    pit = {"kind": "pit", "depth": "0.1 mm", "diameter": "2 mm", "height": 0.5, "edge": "0.1 mm"}
    _, _, own = fields_of(damaged(pit), LEADING)
    lost = own.compliance[0] > 0.0
    box = {"kind": "spall", "depth": "0.1 mm", "length": "2 mm", "width": "2 mm", "height": 0.5}
    square = fields_of(damaged(box | {"edge": "0.1 mm"}), LEADING)[2].compliance[0]
    assert 0 < lost.sum() <= (square > 0.0).sum()
    assert own.compliance[0].sum() < square.sum()


def test_a_broken_tip_ends_contact_there():
    """Before the break nothing changes, beyond it the pair no longer touches."""
    case, plain = damaged({"kind": "broken-tip", "height": 0.8}), made(NAME, {})
    places, _, own = fields_of(case, LEADING)
    share = (places.distance - places.distance[0]) / (places.distance[-1] - places.distance[0])
    assert np.all(own.gap[0, share < 0.79] == 0.0)
    assert np.all(own.gap[0, share > 0.87] > 50e-6)
    assert np.all(np.diff(own.gap[0]) >= 0.0)
    both = fields_of(case, TRAILING)[2]
    np.testing.assert_array_equal(both.gap, own.gap)
    ratio = float(case.assembly.contact_ratio)
    carried, alone = TOOTH + 0.7 * ratio, TOOTH + 0.93 * ratio
    found = errors(case.model, np.array([carried, alone]))
    before = errors(plain.model, np.array([carried % 1.0, alone % 1.0]))
    assert found[0] == pytest.approx(before[0], abs=1e-12)
    assert found[1] - before[1] > 1e-6  # the next tooth carries alone already


def test_a_scuffed_patch_raises_friction_only_there():
    scuffed = {"kind": "scuffing", "factor": 2.5, "height": 0.6, "length": "2 mm"}
    _, _, own = fields_of(damaged(scuffed), LEADING)
    factor = own.friction[0]
    assert factor.max() == pytest.approx(2.5, rel=1e-6)
    assert factor.min() == 1.0
    assert np.all(own.gap == 0.0)
    assert np.all(own.compliance == 0.0)
    assert 0.1 < np.mean(factor > 1.0) < 0.4


def test_several_damages_of_a_tooth_add():
    one = {"kind": "crack", "depth": "1 mm"}
    two = {"kind": "spall", "depth": "10 um", "height": 0.5, "length": "2 mm"}
    both = fields_of(damaged(one, two), LEADING)[2]
    alone = [fields_of(damaged(each), LEADING)[2] for each in (one, two)]
    np.testing.assert_allclose(both.gap, alone[0].gap + alone[1].gap)
    np.testing.assert_allclose(both.compliance, alone[0].compliance + alone[1].compliance)


def test_planets_are_damaged_in_the_mesh_that_their_flank_is_touched_in():
    """A planet's trailing flank meets the sun, its leading flank the ring; back flanks are the other way."""
    for flank, touched in (("trailing", "sun"), ("leading", "ring")):
        damage = {"gear": "planet-2", "tooth": 4, "kind": "crack", "depth": "1.2 mm", "flank": flank}
        case = td.scenario("planetary-24-84", {"damage": [damage]})
        meshes = prepare_train(case).model.meshes
        for name, mesh in zip([mesh.name for mesh in case.meshes], meshes, strict=True):
            planet = mesh.teeth.driven if "sun" in name else mesh.teeth.driver
            if not len(planet.row):
                continue
            front, back = np.split(planet.row.astype(int), 2)  # as many numbers on either side
            softer = [np.any(planet.channel[side][..., 1, :] != 0.0) for side in (front, back)]
            assert softer == [name == f"set-{touched}-2", name.endswith("-2") and touched not in name], name


WRONG = {
    "tooth 24 of 23": ({"kind": "crack", "depth": "1 mm", "tooth": 24}, "damage.0.tooth", "23 teeth"),
    "no tooth": ({"kind": "crack", "depth": "1 mm", "tooth": 0}, "damage.0.tooth", "1 to 23"),
    "no such gear": ({"kind": "crack", "depth": "1 mm", "gear": "wheel"}, "damage.0.gear", "pinion"),
    "a crack deeper than the tooth": ({"kind": "crack", "depth": "9 mm"}, "damage.0.depth", "mm thick"),
    "a crack along the tooth": (
        {"kind": "crack", "depth": "1 mm", "angle": "10 deg"},
        "damage.0.angle",
        "30 to 90 deg",
    ),
    "a crack from the flank": (
        {"kind": "crack", "depth": "1 mm", "tangent": "89.9 deg"},
        "damage.0.tangent",
        "fillet leans",
    ),
    "a crack without depth": ({"kind": "crack"}, "damage.0.depth", "missing"),
    "a crack of a length": (
        {"kind": "crack", "depth": "1 mm", "length": "1 mm"},
        "damage.0.length",
        "no such key",
    ),
    "a spall off the flank": (
        {"kind": "spall", "depth": "0.2 mm", "height": 0.95, "length": "4 mm"},
        "damage.0.length",
        "off the flank",
    ),
    "a spall at a radius off the flank": (
        {"kind": "spall", "depth": "0.2 mm", "radius": "90 mm", "length": "1 mm"},
        "damage.0.radius",
        "off the flank",
    ),
    "a spall off the face": (
        {
            "kind": "spall",
            "depth": "0.2 mm",
            "height": 0.5,
            "length": "1 mm",
            "width": "2 mm",
            "face": "30 mm",
        },
        "damage.0.face",
        "from the middle of a face",
    ),
    "a height beyond the tip": ({"kind": "broken-tip", "height": 1.2}, "damage.0.height", "0 to 1"),
    "two places": (
        {"kind": "broken-tip", "height": 0.8, "radius": "36 mm"},
        "damage.0.height",
        "contradicts radius",
    ),
    "an edge as wide as the patch": (
        {"kind": "spall", "depth": "0.2 mm", "height": 0.5, "length": "1 mm", "edge": "2 mm"},
        "damage.0.edge",
        "wider than half",
    ),
}


@pytest.mark.parametrize("wrong", WRONG)
def test_bad_damage_is_one_message(wrong: str):
    damage, key, said = WRONG[wrong]
    with pytest.raises(td.InputError) as caught:
        td.scenario(NAME, {"damage": [WHOLE | damage]})
    assert key in str(caught.value)
    assert said in str(caught.value)
    assert str(caught.value).endswith("(damage.0 is the first [[damage]])")


def test_a_table_that_a_list_does_not_have_is_refused_with_how_many_there_are():
    crack = WHOLE | {"kind": "crack", "depth": "1 mm"}
    with pytest.raises(td.InputError, match=r"there is no damage\.5: damage has 2, counted from 0"):
        td.scenario(NAME, {"damage": [crack, crack], "damage.5.depth": "2 mm"})
