"""Loads along the faces of gears on drawn shafts, in static equilibrium of the whole gearbox."""

from functools import lru_cache
from typing import Any

import numpy as np
import pytest

from tests.support.overhung_train import overhung_train
from tests.support.planet_sets import helical_set
from tests.support.train_scenarios import case_of_table
from tribodyn.compliance.sharing.load_sharing import LoadedFlanks, flexibility
from tribodyn.compliance.sharing.loaded_contact import roll_through
from tribodyn.dynamics.parameters import Model
from tribodyn.geometry.modification import Misalignment
from tribodyn.solve.initial import static_equilibrium
from tribodyn.solve.methods import STIFF
from tribodyn.solve.transient import Stop, TransientSettings, transient
from tribodyn.studies.load_contact.run import quantities_of
from tribodyn.studies.motion.prepare import prepare
from tribodyn.studies.motion.train.assessable import pair_of
from tribodyn.studies.motion.train.face_loads import FaceLoads, Spread, flattened, of_deflected, spread_of
from tribodyn.studies.protocol.load import load_data
from tribodyn.train.schedule import intervals


@lru_cache
def spur() -> Spread:
    written = overhung_train(mesh={"damping_ratio": 0.3})
    del written["stage"][0]["helix_angle"], written["gear"]["one"]["hand"]
    for shaft in written["shaft"]:
        shaft["drawn"]["damping_ratio"] = 0.3
    written["operating"]["input_speed"] = "0.1 rpm"
    found = of_deflected(prepare(case_of_table(written)))
    assert found is not None
    return found


@lru_cache
def spread(mirrored: bool = False, hand: str = "right") -> Spread:
    return spread_of(prepare(case_of_table(overhung_train(mirrored=mirrored, hand=hand))))


def uniform(stiffness: float = 1e8, slices: int = 7, crowning: str = "0 um", **more: Any) -> Spread:
    """Slices of one stiffness (N/m) that do not hold each other; the overlap ratio is 1."""
    mesh = {"damping_ratio": 0.3, "slices": slices, "compliance": "constant", "stiffness": f"{stiffness} N/m"}
    width = float(np.pi * 3.0 / np.sin(np.radians(15.0)))
    written = overhung_train(width=width, mesh=mesh)
    written["gear"]["one"]["modification"] = {"crowning": crowning}
    for shaft in written["shaft"]:
        shaft["drawn"]["damping_ratio"] = 0.3
    written["operating"] |= more
    return spread_of(prepare(case_of_table(written)), 24)


def only(found: Spread) -> FaceLoads:
    (loads,) = found.meshes
    assert loads is not None
    return loads


def test_the_mirror_image_is_loaded_at_the_other_end():
    one, other = only(spread()), only(spread(mirrored=True, hand="left"))
    assert other.misalignment == pytest.approx(-one.misalignment, rel=1e-9)
    assert other.centre == pytest.approx(-one.centre, rel=1e-9)
    np.testing.assert_allclose(other.line_load[::-1], one.line_load, rtol=1e-8, atol=1e-6)
    np.testing.assert_allclose(other.pressure[..., ::-1], one.pressure, rtol=1e-8, atol=1.0)


@pytest.mark.parametrize("hand", ["right", "left"])
def test_the_end_that_opens_carries_less(hand: str):
    loads = only(spread(hand=hand))
    assert loads.misalignment > 0.0  # the overhung pinion yields at its free end, at larger z
    assert loads.centre < 0.0
    assert loads.factor > 1.5
    assert np.all(np.diff(loads.line_load) < 0.0)


def test_the_loads_along_the_face_are_those_of_the_torque():
    """Along the normal, mean over the face: F_t/(cos α_n cos β), at the pitch circle of 25 of 75 parts."""
    loads, (mesh,) = only(spread()), spread().prepared.case.meshes
    radius = 50 * 3e-3 / np.cos(np.radians(15.0)) / 2.0
    normal = 300.0 / radius / np.cos(np.radians(20.0)) / np.cos(np.radians(15.0))
    assert float(mesh.pair.drive.gear.face_width) * np.mean(loads.line_load) == pytest.approx(
        normal, rel=2e-3
    )


def test_bearings_stand_under_the_loads_where_the_faces_carry():
    """Moments on the shafts are those of the load at its centre, but for where in a slice it acts."""
    rolling = {
        "type": "tapered-roller",
        "elements": 19,
        "element_diameter": "10.5 mm",
        "roller_length": "15 mm",
        "pitch_diameter": "71 mm",
        "contact_angle": "15.6 deg",
        "preload": "3 um",
    }
    written = overhung_train(mesh={"damping_ratio": 0.05, "slices": 7})
    for shaft in written["shaft"]:
        drawn = shaft["drawn"]
        drawn["bearing"] = [
            rolling | {"position": one["position"], "thrust": thrust}
            for one, thrust in zip(drawn["bearing"], ("-z", "+z"), strict=True)
        ]
    case = case_of_table(written)
    prepared = prepare(case)
    assert case.system is not None
    assert prepared.case.system is not None
    middle, stands = np.array(case.system.loads), np.array(prepared.case.system.loads)
    np.testing.assert_allclose(stands[:, :3], middle[:, :3], rtol=5e-3)
    lever = -case.bodies[0].sense * only(spread_of(prepared)).centre
    x, y = stands[:, :2].T
    moments = lever * np.stack([-y, x], axis=-1)
    assert abs(lever) > 1e-3
    np.testing.assert_allclose(
        stands[:, 3:] - middle[:, 3:], moments, atol=5e-2 * float(np.max(np.abs(moments)))
    )


def test_a_load_off_the_middle_tilts_the_gears_back():
    """The uneven load moves to the stiff end: less misalignment than under the load in the middle."""
    (mesh,) = spread().prepared.case.meshes
    in_the_middle = mesh.pair.supports.misalignment.in_plane * float(mesh.pair.drive.gear.face_width)
    assert 0.7 * in_the_middle < only(spread()).misalignment < in_the_middle


def test_uniform_stiffness_meets_the_closed_form():
    """κ = c f b/(2 F_bt), K_Hβ = 1 + κ at the end of the face; c per width of the face, along the path."""
    loads = only(uniform())
    kappa, slices = opened(uniform(), 1e8), len(loads.place)
    assert 0.3 < kappa < 1.0
    assert loads.factor == pytest.approx(1.0 + kappa * (1.0 - 1.0 / slices), rel=1e-2)  # middle of the last


def softness(found: Spread, stiffness: float) -> float:
    """b c/F_bt, 1/m."""
    loads, assembly = only(found), found.prepared.assembly
    width = float(assembly.common_width)
    base_helix = np.arcsin(np.sin(np.radians(15.0)) * np.cos(np.radians(20.0)))
    per_width = stiffness / width * float(assembly.contact_ratio) * np.cos(base_helix) ** 2
    force = np.mean(loads.line_load) * width * np.cos(base_helix)
    return per_width * width / force


def opened(found: Spread, stiffness: float) -> float:
    """κ = c f b/(2 F_bt)."""
    return softness(found, stiffness) * only(found).misalignment / 2.0


def test_a_part_of_the_face_carries_as_the_closed_form_says():
    """Triangular load over 2/√(4κ) of the face: K_Hβ = √(4κ) at its end, κ/n less in a slice's middle."""
    stiffness, slices = 6e8, 15
    found = uniform(stiffness, slices)
    kappa, loads = opened(found, stiffness), only(found)
    assert kappa > 1.3
    carries = loads.line_load > 0.02 * np.max(loads.line_load)
    assert np.mean(carries) == pytest.approx(2.0 / np.sqrt(4.0 * kappa), abs=1.0 / slices)
    assert loads.factor == pytest.approx(np.sqrt(4.0 * kappa) - kappa / slices, rel=2e-2)


def settles(model: Model) -> None:
    """From the unloaded position, in one mesh cycle at 0.1 rpm; before the next pair enters."""
    layout, start = model.layout, np.zeros(model.layout.states)
    *_, end = transient(model, start, TransientSettings(STIFF, 1e-9, 1, 100_000, 8))
    assert isinstance(end, Stop)
    assert not end.reason
    statics = static_equilibrium(model, 1.0, intervals(model.schedule, 0)[-1])
    moved, stands = end.state[: layout.half], statics[: layout.half]
    moved, stands = np.delete(moved, layout.lag), np.delete(stands, layout.lag)
    assert np.linalg.norm(moved - stands) < 1e-6 * np.linalg.norm(stands)
    np.testing.assert_allclose(moved, stands, rtol=1e-5, atol=1e-6 * np.max(np.abs(stands)))


def test_slow_motion_settles_where_statics_stand():
    settles(uniform(input_speed="0.1 rpm").prepared.model)


def test_slow_motion_of_a_spur_mesh_settles_where_statics_stand():
    settles(spur().prepared.model)


def test_a_crowned_face_carries_as_the_closed_form_says():
    """Parabola over l = b (3 F_bt/(2 b c C))^⅓, wherever the tilt puts it: K_Hβ = 3 b/(2 l)."""
    stiffness, crowning = 6e8, 60e-6
    found = uniform(stiffness, 27, f"{crowning} m")
    share = (1.5 / (softness(found, stiffness) * crowning)) ** (1.0 / 3.0)
    assert share < 0.7
    assert only(found).factor == pytest.approx(1.5 / share, rel=2e-2)


@pytest.mark.slow
def test_slow_motion_of_a_set_settles_where_statics_stand():
    written = helical_set(planets=3, mesh={"slices": 5, "damping_ratio": 0.3})
    written["operating"]["input_speed"] = "0.1 rpm"
    found = of_deflected(prepare(case_of_table(written)))
    assert found is not None
    assert all(loads is not None and loads.factor > 1.05 for loads in found.meshes)
    settles(found.prepared.model)


def test_load_contact_of_a_spur_mesh_agrees():
    """K_Hβ, means over the mesh cycle, by finite elements in twice as many slices."""
    found = spur()
    loads, (mesh,) = only(found), found.prepared.case.meshes
    pair, assembly = mesh.pair, found.prepared.assembly
    flexible = flexibility(assembly, pair.materials, lead=True, held=pair.mesh.held)
    stand = Misalignment(loads.misalignment / float(assembly.common_width), 0.0)
    flanks = LoadedFlanks(flexible, pair.mesh.modifications._replace(misalignment=stand), 21, True)
    rolled = roll_through(flanks, pair.operating.gear_torque, 12)
    along = np.mean(np.sum(rolled.line_load, axis=1), axis=0)
    assert loads.factor == pytest.approx(np.max(along) / np.mean(along), rel=0.02)
    assert loads.factor > 2.0


@pytest.mark.slow
def test_load_contact_of_the_same_misalignment_agrees():
    """Slow rotation on finite elements, in which slices hold each other at every load."""
    mesh = {"damping_ratio": 0.05, "slices": 7, "compliance": "fem"}
    case = case_of_table(overhung_train(mesh=mesh))
    loads, (pair,) = only(spread_of(prepare(case), 16)), case.pairs
    angle = loads.misalignment / float(pair.drive.gear.face_width)
    scenario = {
        "title": "The same",
        "kind": "load-contact",
        "drive": pair_of(case, "only")["drive"],
        "operating": {"gear_torque": f"{pair.operating.gear_torque!r} N*m"},
        "mesh": {"slices": 7, "misalignment": {"in_plane": f"{angle!r} rad"}},
    }
    alone = quantities_of(load_data(scenario, "same").case)
    assert loads.factor == pytest.approx(alone["face_load_factor"], rel=0.02)
    assert loads.factor > 2.0


@pytest.mark.parametrize("hand", ["right", "left"])
def test_what_is_proposed_flattens_the_load(hand: str):
    before = spread(hand=hand)
    (proposed,) = flattened(before)
    assert proposed["face_load_factor_helix_slope"] < 1.05
    assert proposed["face_load_factor_crowning"] < 0.8 * only(before).factor
    assert proposed["proposed_helix_slope"] < 0.0  # material stays where the flanks open
