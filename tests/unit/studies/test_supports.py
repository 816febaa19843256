"""Drawn shafts and matrices: load of the mesh, misalignment, dynamics on a matrix, lives; what is refused."""

import copy
import math
from typing import Any

import numpy as np
import pytest

import tribodyn as td
from tests.support.drawn_shafts import BALL, BETWEEN, OVERHUNG, ROLLER, SHAFTS
from tribodyn.cases.results import CheckResult
from tribodyn.dynamics.data import in_space
from tribodyn.errors import InputError
from tribodyn.gears.plausibility import with_duty
from tribodyn.gears.rating.bearings import bearing_part, bearing_remarks, opening_part
from tribodyn.gears.supports import mean_loads
from tribodyn.geometry.assembly import assemble
from tribodyn.geometry.families import family
from tribodyn.interface.scenario import scenario
from tribodyn.record.reader import Record
from tribodyn.solve.initial import static_equilibrium
from tribodyn.standards.rolling_bearings import life_factor, reference_viscosity
from tribodyn.studies.assessment.pages.first_page import bearings_table
from tribodyn.studies.motion.prepare import prepare
from tribodyn.studies.motion.train.assessable import shafts as shafts_of
from tribodyn.tribology.losses.bearings import BearingInOil
from tribodyn.tribology.losses.loss import OilState
from tribodyn.tribology.losses.palmgren import palmgren

HELICAL = {"mesh.slices": 7, "friction.law": "none", "bearings": "rigid-1e9"}


def diagonal(values: Any) -> list[list[float]]:
    return np.diag([*map(float, values), 0.0]).tolist()


def with_matrices(matrix: Any, units: str = "N, m, rad") -> dict[str, Any]:
    own = {"matrix": matrix, "matrix_units": units, "damping_ratio": 0.05}
    return {"bearings": {"pinion": own, "gear": own}}


def test_the_load_of_a_published_pair():
    """Of a design report: F_t 240 064, F_r 88 724, F_a 42 330 N at the reference circle."""
    case = scenario("efficiency-helical-24-95")
    assembly = assemble(family(case.family), case.drive)
    pinion, gear = mean_loads(assembly, 5e6 / (1165.9 * math.pi / 30.0) * 95.0 / 24.0)
    assert math.hypot(pinion[0], pinion[1]) == pytest.approx(math.hypot(240064.0, 88724.0), rel=2e-5)
    assert abs(pinion[2]) == pytest.approx(42330.0, rel=2e-5)
    assert np.array(gear[:3]) == pytest.approx(-np.array(pinion[:3]))
    radii = float(assembly.path.pinion_pitch_radius), float(assembly.path.gear_pitch_radius)
    assert (pinion[3], gear[3]) == pytest.approx((radii[0] * pinion[2], radii[1] * pinion[2]))


def test_an_overhung_pinion_opens_at_its_free_end():
    """It is pushed off the gear, most where no bearing holds it; turned about, at the other end."""
    free = scenario("load-contact-18-36", {"shaft": {"pinion": OVERHUNG}})
    assert free.supports.misalignment.in_plane > 0.0
    assert free.supports.gear is None
    turned: dict[str, Any] = copy.deepcopy(OVERHUNG) | {"gear_position": "15 mm"}
    for bearing, place in zip(turned["bearing"], ("60 mm", "130 mm"), strict=True):
        bearing["position"] = place
    other = scenario("load-contact-18-36", {"shaft": {"pinion": turned}})
    assert other.supports.misalignment.in_plane == pytest.approx(
        -free.supports.misalignment.in_plane, rel=1e-6
    )


def test_misalignment_adds_to_that_of_the_scenario():
    shafts = {"shaft": {"pinion": OVERHUNG}}
    given = scenario("load-contact-18-36", shafts | {"mesh.misalignment.in_plane": "2 arcmin"})
    alone = scenario("load-contact-18-36", shafts)
    own = math.radians(2.0 / 60.0)
    assert given.mesh.modifications.misalignment.in_plane == pytest.approx(
        own + alone.supports.misalignment.in_plane
    )
    shown = opening_part(given, 0.02)
    assert shown["given_misalignment"] == pytest.approx(0.02 * own)
    assert shown["shaft_misalignment"] == pytest.approx(0.02 * alone.supports.misalignment.in_plane)
    assert opening_part(scenario("load-contact-18-36"), 0.02) == {}


def test_a_matrix_misaligns_by_its_inverse():
    """A spur pinion on K_xx, K_θθ and their coupling: θ_y of F_x, by hand."""
    matrix = np.diag([4e8, 4e8, 1e8, 1e6, 1e6, 0.0])
    matrix[0, 4] = matrix[4, 0] = 5e6
    own = {"matrix": matrix.tolist(), "matrix_units": "N, m, rad", "damping_ratio": 0.05}
    springs = {"stiffness_x": "1e9 N/m", "stiffness_y": "1e9 N/m", "damping_ratio": 0.05}
    case = scenario("load-contact-18-36", {"bearings": {"pinion": own, "gear": springs}})
    assembly = assemble(family(case.family), case.drive)
    force = mean_loads(assembly, case.operating.gear_torque)[0][0]
    tilt = -force * 5e6 / (4e8 * 1e6 - 5e6**2)
    angle = float(assembly.path.pressure_angle(0.0))
    assert case.supports.misalignment.in_plane == pytest.approx(-tilt * math.cos(angle), rel=1e-9)


def test_a_matrix_in_millimetres():
    metres = np.diag([4e8, 5e8, 1e8, 1e6, 2e6, 0.0])
    metres[0, 4] = metres[4, 0] = 5e6
    millimetres = metres.copy()
    millimetres[:3, :3] /= 1e3  # N/mm
    millimetres[3:, 3:] *= 1e3  # N mm/rad; a force over an angle stays in N
    cases = [
        scenario("helical-23-47", with_matrices(matrix.tolist(), units))
        for matrix, units in ((metres, "N, m, rad"), (millimetres, "N, mm, rad"))
    ]
    one, other = (np.array(case.bearings[0].matrix) for case in cases)
    assert one == pytest.approx(other, rel=1e-12)


def test_a_diagonal_matrix_is_the_springs():
    plain = scenario("helical-23-47", {"mesh.slices": 5, "friction.law": "none"})
    bearings = {}
    for side, bearing in zip(("pinion", "gear"), plain.bearings, strict=True):
        stiffness, _ = in_space(bearing, 25e-3)
        bearings[side] = {"matrix": diagonal(stiffness), "matrix_units": "N, m, rad", "damping_ratio": 0.05}
    same = scenario("helical-23-47", {"mesh.slices": 5, "friction.law": "none", "bearings": bearings})
    one, other = (prepare(case).model.links for case in (plain, same))
    assert one.stiffness_in_space == pytest.approx(other.stiffness_in_space, rel=1e-12)
    assert one.damping_in_space == pytest.approx(other.damping_in_space, rel=1e-9)


def test_spur_gears_on_an_uncoupled_matrix_stand_as_on_springs():
    springs = {"stiffness_x": "2e8 N/m", "stiffness_y": "3e8 N/m", "damping_ratio": 0.05}
    base = {"friction.law": "none"}
    planar = prepare(
        scenario("involute-23-47", base | {"bearings": {"pinion": springs, "gear": springs}})
    ).model
    matrix = diagonal([2e8, 3e8, 1e8, 1e6, 1e6])
    spatial = prepare(scenario("involute-23-47", base | with_matrices(matrix))).model
    assert (planar.layout.spatial, spatial.layout.spatial) == (0, 2)
    one, other = static_equilibrium(planar, 0.3), static_equilibrium(spatial, 0.3)
    half = planar.layout.half
    assert other[:half] == pytest.approx(one[:half], rel=1e-6, abs=1e-12)


def test_spur_gears_tilt_with_the_coupling_of_their_matrix():
    """Without a moment on the gear the stiffness along x is that with the tilt free: K_xx − K_xθ²/K_θθ."""
    matrix = np.array(diagonal([2e8, 3e8, 1e8, 1e6, 1e6]))
    matrix[0, 4] = matrix[4, 0] = 5e6
    model = prepare(
        scenario("involute-23-47", {"friction.law": "none"} | with_matrices(matrix.tolist()))
    ).model
    found = static_equilibrium(model, 0.3)
    force = found[0] * (2e8 - 5e6**2 / 1e6)
    tangential = 500.0 / float(model.meshes[0].driven_radius)
    assert force == pytest.approx(-tangential, rel=1e-5)


def test_gears_in_motion_stand_as_the_statics_say():
    """Bearings stiffen on the way to the load: about it constant forces stand beside their tangent."""
    case = scenario("helical-23-47", HELICAL | {"shaft": SHAFTS})
    model = prepare(case).model
    states = np.mean([static_equilibrium(model, phase) for phase in (0.1, 0.3, 0.5, 0.7, 0.9)], axis=0)
    layout = model.layout
    for body, held in enumerate(case.pair.supports[:2]):
        found = [*states[3 * body : 3 * body + 2], *states[layout.tilts + 3 * body :][:3]]
        lengths = np.array([1.0, 1.0, 1.0, 0.025, 0.025])
        # the load is not in the middle of the face, which the tilts shift it from
        moved = np.array(held.displacement) * lengths
        assert np.abs(found * lengths - moved).max() < 0.06 * np.abs(moved).max()
    assert not any(case.pair.mesh.modifications.misalignment)  # the gears tilt by themselves


def test_spur_gears_on_drawn_shafts_run_and_balance(tmp_path):
    """They move in space; the energies of springs and dampers with couplings close the audit."""
    changes = {"shaft": {"pinion": OVERHUNG}, "solver.cycles": 3, "friction.law": "none"}
    found = td.run("involute-23-47", changes, output=tmp_path / "spur.h5")
    assert abs(found.summary["energy_residual"]) < 1e-7
    with Record(found.path) as record:
        names, moved = list(record["dof"]), np.asarray(record["displacement"])[-1]
    held = scenario("involute-23-47", changes).pair.supports.pinion
    assert held is not None
    tilt = moved[names.index("tilt_y_p")]
    still = np.linalg.solve(np.array(held.data.matrix), mean_loads(*pair_of("involute-23-47"))[0])
    assert tilt == pytest.approx(still[4], rel=0.2)  # it vibrates


def pair_of(name: str) -> tuple[Any, float]:
    case = scenario(name).pair
    return assemble(family(case.family), case.drive), case.operating.gear_torque


def test_check_has_the_bearings():
    case = scenario("load-contact-18-36", {"shaft": {"pinion": OVERHUNG}})
    found = with_duty(CheckResult({}, ()), case)
    assert [table.title for table in found.tables] == ["Duty", "Bearings"]
    assert found.tables[1].columns[1:] == ("F_r (N)", "F_a (N)", "Tilting moment (N m)", "P (N)")
    assert set(found.data["bearings"]) == {"pinion-1", "pinion-2"}


def test_loads_lives_and_losses_of_bearings():
    shafts = copy.deepcopy(SHAFTS)
    box = scenario("helical-23-47", HELICAL | {"shaft": shafts})
    case = box.pair
    found = bearing_part(shafts_of(box), case.lubricant)["bearings"]
    assert list(found) == ["pinion-1", "pinion-2", "gear-1", "gear-2"]
    loads = mean_loads(assemble(family(case.family), case.drive), 300.0)
    axial = found["pinion-1"]["axial_load"] - found["pinion-2"]["axial_load"]
    assert axial == pytest.approx(abs(loads[0][2]), rel=1e-6)
    assert found["gear-1"]["axial_load"] == pytest.approx(abs(loads[1][2]), rel=1e-6)
    one = found["pinion-2"]
    life = (67e3 / one["equivalent_load"]) ** (10 / 3) * 1e6 / (60.0 * 1500.0)
    assert one["rating_life"] == pytest.approx(3600.0 * life)
    oil, speed = case.lubricant, 1500.0 * math.pi / 30.0
    drag = BearingInOil("tapered-roller", 66e-3, contact_angle=math.radians(14.0))
    idle = palmgren(drag, speed, OilState(oil.inlet_viscosity, oil.density), 0.0, 0.0).idle
    assert one["power_bearing"] > idle * speed
    remarks = " ".join(bearing_remarks(shafts_of(box), oil))
    assert "Bearing gear-1: no life without dynamic_rating" in remarks
    assert "rating_life" not in found["gear-1"]
    bearing = shafts["gear"]["bearing"][0]
    bearing |= {"dynamic_rating": "30 kN", "static_rating": "16 kN", "contamination_factor": 0.5}
    bearing["fatigue_load_limit"] = "0.8 kN"
    again = scenario("helical-23-47", HELICAL | {"shaft": shafts})
    ball = bearing_part(shafts_of(again), again.pair.lubricant)["bearings"]["gear-1"]
    turning = 1500.0 * math.pi / 30.0 * 23 / 47
    ratio = oil.inlet_viscosity / oil.density / reference_viscosity(60e-3, turning)
    factor = life_factor("deep-groove-ball", ratio, 0.5 * 800.0 / ball["equivalent_load"])
    assert ball["viscosity_ratio"] == pytest.approx(ratio)
    assert ball["modified_life"] == pytest.approx(factor * ball["rating_life"])
    # clearance and thrust: fewer balls carry than the ratings assume, or more
    assert 0.2 < ball["reference_life"] / ball["rating_life"] < 5.0
    assert "modified_life" not in one
    assert "<td>pinion-1</td>" in bearings_table({"bearings": found})
    assert bearings_table({}) == ""


def spoilt(side: str, place: str, value: Any) -> dict[str, Any]:
    shafts = copy.deepcopy(SHAFTS)
    *path, last = place.split(".")
    inner: Any = shafts[side]
    for name in path:
        inner = inner[int(name) if name.isdigit() else name]
    if value is None:
        del inner[last]
    else:
        inner[int(last) if last.isdigit() else last] = value
    return {"shaft": shafts}


@pytest.mark.parametrize(
    ("changes", "key", "words"),
    [
        (spoilt("pinion", "gear_position", "150 mm"), "shaft.pinion.gear_position", "beyond the end"),
        (spoilt("gear", "bearing.1.position", "0.2 m"), "shaft.gear.bearing.1.position", "beyond the end"),
        (spoilt("gear", "section.0.bore", "50 mm"), "shaft.gear.section.0.bore", "smaller"),
        (spoilt("gear", "section.0.diameter", "50 parsec"), "shaft.gear.section.0.diameter", "above 30"),
        (
            {
                "shaft": {
                    "gear": BETWEEN
                    | {"section": [*BETWEEN["section"], {"length": "1 m", "diameter": "20 m"}]}
                }
            },
            "shaft.gear.section.1.diameter",
            "above 300",
        ),
        (
            {"shaft": {"gear": BETWEEN | {"bearing": [BALL | {"position": "15 mm"}]}}},
            "shaft.gear.bearing",
            "tip",
        ),
        (
            {"shaft": {"gear": BETWEEN | {"bearing": [ROLLER | {"position": f"{z} mm"} for z in (15, 99)]}}},
            "shaft.gear.bearing",
            "along its axis",
        ),
        (
            spoilt("gear", "bearing.0.roller_length", "9 mm"),
            "shaft.gear.bearing.0.roller_length",
            "no effect",
        ),
        (spoilt("pinion", "bearing.0.thrust", None), "shaft.pinion.bearing.0.thrust", "missing"),
        (spoilt("pinion", "bearing.0.locating", False), "shaft.pinion.bearing.0.locating", "slides"),
        (spoilt("gear", "bearing.0.elements", 30), "shaft.gear.bearing.0.elements", "fit"),
        (spoilt("gear", "bearing.0.stiffness_x", "1e8 N/m"), "shaft.gear.bearing.0", "type and stiffness"),
        (spoilt("gear", "bearing.0", {"position": "15 mm"}), "shaft.gear.bearing.0", "says nothing"),
        (
            spoilt("gear", "bearing.0.matrix_units", "N, m, rad"),
            "shaft.gear.bearing.0.matrix_units",
            "no effect",
        ),
        (spoilt("pinion", "bearing.0.thrust", "+z"), "shaft.pinion", "holds it"),
        (
            {"shaft": SHAFTS, "bearings": {"gear": {"stiffness_x": "1e9 N/m", "stiffness_y": "1e9 N/m"}}},
            "bearings.gear",
            "again",
        ),
        ({"shaft": {"pinion": OVERHUNG}, "bearings": {"title": "none"}}, "bearings.gear", "missing"),
        (with_matrices(np.eye(5).tolist()), "bearings.pinion.matrix", "six by six"),
        (with_matrices(diagonal([1e8, 1e8, 1e8, 1e6, -1e6])), "bearings.pinion.matrix", "semi-definite"),
        (with_matrices((np.eye(6) * 1e8).tolist()), "bearings.pinion.matrix", "rotation about z"),
        (with_matrices((np.triu(np.ones((6, 6)))[:6] * 1e8).tolist()), "bearings.pinion.matrix", "rotation"),
        (
            with_matrices((np.diag([1e8] * 5 + [0]) + 1e7 * np.eye(6, k=1) * [0, 1, 1, 1, 1, 0]).tolist()),
            "bearings.pinion.matrix",
            "not symmetric",
        ),
        (with_matrices(diagonal([1e8, 1e8, 0.0, 1e6, 1e6])), "bearings.pinion.matrix", "does not hold"),
        ({"bearings.pinion.matrix": diagonal([1e8] * 5)}, "bearings.pinion.stiffness_x", "contradicts"),
    ],
)
def test_one_message_of_what_is_wrong(changes: dict[str, Any], key: str, words: str):
    with pytest.raises(InputError, match=words) as caught:
        scenario("helical-23-47", {"bearings": "rigid-1e9", **changes} if "shaft" in changes else changes)
    said = [getattr(error, "key", "") for error in getattr(caught.value, "errors", [caught.value])]
    assert key in said


@pytest.mark.parametrize(
    ("changes", "key", "words"),
    [
        ({"shaft": SHAFTS}, "shaft", "evenly along the face"),
        (with_matrices(diagonal([1e8, 1e8, 1e8, 1e6, 1e6])), "bearings", 'write mesh.compliance = "fem"'),
        ({"shaft": SHAFTS, "drive": "ring-36-93", "mesh.compliance": "fem"}, "shaft", "an internal pair"),
    ],
)
def test_tilts_that_change_nothing_are_refused(changes: dict[str, Any], key: str, words: str):
    with pytest.raises(InputError, match=words) as caught:
        scenario("efficiency-involute-18-36", changes)
    assert caught.value.key == key


def test_teeth_without_a_path_are_refused_before_their_shafts():
    with pytest.raises(InputError, match="must be greater than 0") as caught:
        scenario("parabolic-23-47", {"drive.shape.k1": 0.0, "shaft": SHAFTS})
    assert caught.value.key == "drive.shape.k1"


def test_teeth_that_cannot_be_made_are_refused_before_their_cracks():
    crack = {"gear": "pinion", "tooth": 2, "kind": "crack", "depth": "2 mm"}
    with pytest.raises(InputError, match="the bore reaches the root circle"):
        scenario("parabolic-23-47", {"drive.pinion.bore_radius": "60 mm", "damage": [crack]})
