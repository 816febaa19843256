"""Sets whose ring bends and whose pins give: limits, load sharing, energy, the mesh's part."""

import numpy as np
import pytest

from tests.support.planet_sets import planet_set, set_case
from tests.support.states import recorded
from tests.support.train_scenarios import case_of_table
from tribodyn.compliance.foundation import ring_compliance
from tribodyn.dynamics.approach import NORMAL_LOAD
from tribodyn.dynamics.equations import derivatives
from tribodyn.dynamics.modes import modes
from tribodyn.dynamics.parameters import frictionless
from tribodyn.errors import InputError
from tribodyn.post.figures.panel import View
from tribodyn.record.reader import Record
from tribodyn.solve.initial import static_equilibrium
from tribodyn.solve.right_hand_side import contacts_of
from tribodyn.solve.transient import TransientSettings
from tribodyn.studies.motion.batch.gearboxes import states_of
from tribodyn.studies.motion.pictures.ring_figure import bent_rim, ring_figure
from tribodyn.studies.motion.prepare import prepare
from tribodyn.studies.motion.run import run
from tribodyn.train.coupling import coupling_forces
from tribodyn.train.elastic.pin import Mounting, Pin, pin_stiffness
from tribodyn.train.elastic.ring import Rim, pin_coupling, rim_matrices, rows_at

STIFF = {"orders": 4, "stiffness": "1e15 N/m"}


def prepared_set(outside=290, planets=3, **stage):
    table = planet_set(planets=planets, **stage)
    table["gear"]["ring"] |= {"outer_diameter": f"{outside} mm"}
    return prepare(case_of_table(table))


def planet_loads(prepared):
    """Loads of the meshes of the sun at rest, N."""
    model = frictionless(prepared.model)
    model = model._replace(operation=model.operation._replace(nominal_speed=1e-3))
    y, work = static_equilibrium(model, 0.3, 0), contacts_of(model)
    derivatives(0.3, 0.0, 0, y, model, work, {})
    loads = np.array([sum(v for (row, _), v in own.items() if row == NORMAL_LOAD) for own in work])
    return loads[: len(prepared.case.sets[0].planets)]


def sharing(**stage):
    """K_γ of four planets around a floating sun, of which the first one's pin is ahead."""
    errors = ["20 um", "0 um", "0 um", "0 um"]
    loads = planet_loads(prepared_set(planets=4, floating=["sun"], tangential_pin_errors=errors, **stage))
    return float(np.max(loads) / np.mean(loads))


def test_a_stiff_rim_is_a_rigid_ring():
    rigid, stiff = prepared_set(), prepared_set(ring_rim=STIFF)
    np.testing.assert_allclose(planet_loads(stiff), planet_loads(rigid), rtol=1e-5)
    expected, found = (modes(each.model, [made.cycle for made in each.tables]) for each in (rigid, stiff))
    count = len(expected.frequency) - 2
    np.testing.assert_allclose(found.frequency[1:count], expected.frequency[1:count], rtol=1e-6)


def test_a_thin_rim_shares_the_load_better():
    rigid = sharing()
    thick, thin = (sharing(outside=size, ring_rim={"orders": 6}) for size in (320, 285))
    assert rigid > thick > thin > 1.0


def test_pins_that_bend_share_the_load_better():
    drawn = {"mounting": "cantilever", "diameter": "25 mm", "length": "30 mm"}
    assert sharing() > sharing(pin=drawn) > 1.0


def test_a_pin_is_in_series_with_its_bearing():
    given = pin_stiffness(Pin("straddle", 0.02, 0.04, 0.0, 206e9, 0.3))
    drawn = {"diameter": "20 mm", "length": "40 mm", "youngs_modulus": "206 GPa"}
    links = [link for link in prepared_set(pin=drawn).case.links if link.lever]
    for link in links:
        assert link.stiffness[0] == pytest.approx(1.0 / (1.0 / 3e8 + 1.0 / given), rel=1e-12)


def test_a_sweep_has_a_place_for_every_state_and_mode():
    prepared = prepared_set(ring_rim=STIFF)
    names, count = states_of(prepared.case)
    assert len(names) == len(set(names)) == prepared.model.layout.states
    assert count == len(modes(prepared.model, [made.cycle for made in prepared.tables]).frequency)


def test_slender_pins_are_beams_without_shear():
    modulus, diameter = 206e9, 0.01
    moment = np.pi / 64.0 * diameter**4
    factors: dict[Mounting, float] = {"cantilever": 3.0, "straddle": 192.0}
    for mounting, factor in factors.items():
        found = pin_stiffness(Pin(mounting, diameter, 5.0, 0.0, modulus, 0.3))
        assert found == pytest.approx(factor * modulus * moment / 125.0, rel=1e-3)


def test_the_waves_are_what_a_mesh_leaves_out_of_its_rim():
    """Of a tooth's load: a free rim gives what one in a fit gives, and the waves of the outside."""
    nu, ratio, arc, orders = 0.3, 1.12, 0.02, 24
    rim = Rim(1.0, ratio, 1.0, 1.0, nu, 1.0)
    free, fitted = (ring_compliance(0.0, arc, ratio, nu, 2000, pins, True) for pins in (0.0, None))
    found = np.linalg.inv(rim_matrices(rim, orders).stiffness)
    for direction in range(2):
        row = rows_at(rim, orders, 0.0, 1.0)[direction]
        whole = free[direction, direction]
        assert fitted[direction, direction] + row @ found @ row == pytest.approx(whole, rel=0.02)


def test_pins_are_the_sum_of_single_ones(rng):
    """Of seven and eight pins anywhere: springs under the outside of the rim, one by one."""
    rim = Rim(0.9, 1.0, 0.1, 206e9, 0.3, 7850.0)
    for pins, orders in ((7, 5), (8, 6), (12, 6)):
        radial, tangential, begin = rng.uniform(1e6, 1e8), rng.uniform(1e6, 1e8), rng.uniform(0.0, 6.0)
        single = rim_matrices(rim, orders).stiffness
        for angle in begin + 2.0 * np.pi * np.arange(pins) / pins:
            out, along = rows_at(rim, orders, angle, rim.outside)
            single = single + radial * np.outer(out, out) + tangential * np.outer(along, along)
        held = pins * radial, pins * tangential
        cosine, sine = pin_coupling(orders, pins, held)
        found = rim_matrices(rim, orders, held).stiffness
        found = found + cosine * np.cos(pins * begin) + sine * np.sin(pins * begin)
        np.testing.assert_allclose(found, single, rtol=1e-9, atol=1e-6 * radial)


def test_pins_pass_as_fast_as_the_carrier_turns(rng):
    """Of 24/30/84 teeth, ring held: a cycle is 1/84 turn of the carrier, and of pins back in its frame."""
    pins, orders, stiffness = 7, 5, 1e8
    rim = {"orders": orders, "pins": pins, "stiffness": f"{stiffness} N/m"}
    prepared = prepared_set(ring_rim=rim)
    assert prepared.case.period == 12  # 84 teeth over 7 pins
    layout = prepared.model.layout
    first, count = layout.rim_first[3], layout.rim_count[3]
    y = np.zeros(layout.states)
    y[first : first + count] = rng.uniform(-1e-5, 1e-5, count)
    carrier = prepared.case.bodies[prepared.case.sets[0].members["carrier"]]

    def forces(cycles: float) -> np.ndarray:
        changes = np.zeros(layout.states)
        coupling_forces(cycles, y, prepared.model, changes)
        return changes[layout.half + first : layout.half + first + count]

    def by_pins(cycles: float) -> np.ndarray:
        found, rim = np.zeros((count, count)), Rim(0.9, 1.0, 0.1, 206e9, 0.3, 7850.0)
        for angle in 2.0 * np.pi * (np.arange(pins) / pins - carrier.sense * cycles / 84.0):
            rows = rows_at(rim, orders, angle, rim.outside)
            found += stiffness * rows.T @ rows
        return -found @ y[first : first + count]

    for cycles in (0.7, 5.0, 11.3):
        change = forces(cycles) - forces(0.0)
        assert np.max(np.abs(change)) > 1.0
        np.testing.assert_allclose(change, by_pins(cycles) - by_pins(0.0), rtol=1e-9, atol=1e-9)
    np.testing.assert_allclose(forces(12.0), forces(0.0), rtol=1e-9)


@pytest.mark.parametrize("pins", [12, 7])
def test_energy_balances_where_the_rim_passes_the_planets(pins: int):
    rim = {"orders": 4, "pins": pins, "stiffness": "5e7 N/m"}
    model = prepared_set(held="carrier", ends=("sun", "ring"), ring_rim=rim).model
    assert np.any(np.abs(model.links.coupled.damping) > 0.0)
    assert len(model.links.coupled.passing_rate) == int(pins == 7)
    run = recorded(model, TransientSettings("rodas4", 1e-8, 1, 10**6, 40))
    into = run["work_in"] - run["work_out"] - run["work_friction"] - run["work_damping"]
    into = into + run["work_parametric"]
    stored = run["stored_energy"] - run["stored_energy"][0]
    np.testing.assert_allclose(stored, into - into[0], atol=1e-6 * np.ptp(run["work_in"]))


@pytest.mark.parametrize(
    ("stage", "key", "rule"),
    [
        (
            {"ring_rim": {"orders": 6, "pins": 7, "stiffness": "1e8 N/m"}},
            "ring_rim.orders",
            "higher orders than 5",
        ),
        ({"ring_rim": {"orders": 4, "pins": 12}}, "ring_rim.stiffness", "missing beside pins"),
        ({"pin": {"stiffness": "1e8 N/m", "length": "20 mm"}}, "pin.stiffness", "contradicts length"),
        ({"pin": {"diameter": "20 mm"}}, "pin.length", "missing"),
        ({"pin": {"diameter": "20 mm", "length": "20 mm", "bore": "20 mm"}}, "pin.bore", "not below"),
    ],
)
def test_rims_and_pins_that_contradict_themselves_are_refused(stage, key, rule):
    with pytest.raises(InputError, match=rule) as refused:
        set_case(**stage)
    assert refused.value.key == f"stage.0.{key}"


def test_a_rim_that_bends_in_the_mesh_too_is_refused():
    table = planet_set(ring_rim={"orders": 4})
    table["gear"]["ring"]["rim"] = "free"
    with pytest.raises(InputError, match="counts the bending of the rim twice"):
        case_of_table(table)


def test_a_record_has_what_the_rim_does_at_its_meshes(tmp_path):
    """Alike at all planets of a set in phase: its ring is pushed apart, and no mesh of the sun has any."""
    table = planet_set(ring_rim={"orders": 3}, solver={"cycles": 8}) | {"output": {"samples_per_cycle": 16}}
    run(case_of_table(table), tmp_path / "set.h5")
    record = Record(tmp_path / "set.h5")
    for name in ("rim_along", "rim_across"):
        values = np.asarray(record[name])[-16:]
        assert np.all(np.isnan(values[:, :3]))
        assert np.ptp(values[:, 3:], axis=1).max() < 1e-3 * np.abs(values[:, 3:]).max()
    # the outside moves outwards by what it moves the mesh under it, from the ring's axis to the planet's
    (ring,) = set(record.geometry["wave_ring"].astype(int).tolist())
    places = record.geometry["centre"][[str(name).startswith("planet") for name in record["body"]]]
    out = bent_rim(record, ring, np.arctan2(places[:, 1], places[:, 0]))[:, 0]
    np.testing.assert_allclose(np.abs(out), np.abs(record["rim_across"][:, 3:]), rtol=1e-9, atol=1e-15)
    figure = ring_figure([record], View())
    assert len(figure.axes) == 2
