"""The mesh cycle's table against direct evaluation, its options, and its derivatives under JAX."""

import math

import jax
import jax.numpy as jnp
import numpy as np
import pytest
from scipy.optimize import brentq

from tests.support.compile_fast import ONE_CALL
from tests.support.involute_forms import closed_form_contact_ratio
from tribodyn.compliance.energy import hertz_linear, loaded_tooth, tooth_compliance
from tribodyn.errors import InputError
from tribodyn.geometry.assembly import assemble
from tribodyn.geometry.drive import SIDES, Drive, GearBody, MaterialData
from tribodyn.geometry.families import crc, involute
from tribodyn.geometry.path import kinematics
from tribodyn.mesh.by_compliance import compliance_remark
from tribodyn.mesh.quasi_static import cycle_mean, mean_efficiency, quasi_static
from tribodyn.mesh.table import MeshData
from tribodyn.mesh.tabulate import pair_slots, tabulate

jax.config.update("jax_enable_x64", True)
STEEL = MaterialData("steel", 206e9, 0.3, 7850.0, 46.0, 470.0, 6e9)
ENERGY = MeshData(compliance="energy", damping_ratio=0.05)
FAMILIES = pytest.mark.parametrize("family", [involute.FAMILY, crc.FAMILY], ids=lambda f: f.name)
#: For what XLA compiles: the other family takes twice as long.
ONE_FAMILY = pytest.mark.parametrize(
    "family", [involute.FAMILY, pytest.param(crc.FAMILY, marks=pytest.mark.soak)], ids=lambda f: f.name
)


def drive_of(parameters):
    """23/47 drive from (pressure angle, pinion's shift, addendum, pinion's face width)."""
    angle, shift, addendum, width = parameters
    pinion = GearBody(23.0, shift, addendum, 1.25, 0.25, width, 0.015)
    gear = GearBody(47.0, 0.0 * shift, addendum, 1.25, 0.25, 1.1 * width, 0.025)
    return Drive(0.003, angle, pinion, gear)


DRIVE = drive_of((math.radians(22.81), 0.0, 1.0, 0.02))


def mesh(**options):
    return MeshData(**({"compliance": "energy", "damping_ratio": 0.05} | options))


@FAMILIES
def test_kinematics_are_those_of_the_path(family):
    cycle = tabulate(assemble(family, DRIVE), (STEEL, STEEL), ENERGY, 2)
    path = family.working_path(DRIVE)
    position = cycle.phase[..., None] + np.array([1.0, 0.0])
    rolls = cycle.roll_start + position * cycle.pitch_angle
    inside = (cycle.in_contact[:, None, :] > 0) & np.ones_like(rolls, dtype=bool)
    motion = kinematics(path, path.signed_distance(rolls[inside]))
    for name in ("signed_distance", "pressure_angle", "pinion_speed", "gear_speed"):
        np.testing.assert_allclose(getattr(cycle, name)[inside], getattr(motion, name), rtol=1e-9, atol=1e-14)
    np.testing.assert_allclose(cycle.equivalent_radius[inside], 1 / motion.relative_curvature, rtol=1e-9)


def test_involute_contact_ratio():
    drive = drive_of((math.radians(20.0), 0.0, 1.0, 0.02))
    cycle = tabulate(
        assemble(involute.FAMILY, drive), (STEEL, STEEL), ENERGY, pair_slots(assemble(involute.FAMILY, drive))
    )
    assert cycle.contact_ratio == pytest.approx(closed_form_contact_ratio(drive), rel=1e-12)
    np.testing.assert_allclose(cycle.boundary, [0, cycle.contact_ratio - 1, 1])
    np.testing.assert_array_equal(cycle.in_contact, [[1, 1], [0, 1]])
    assert cycle.face_width == 0.02
    assert cycle.pitch_point_phase == pytest.approx(-cycle.roll_start * 23 / (2 * math.pi))


@pytest.mark.parametrize(("pairs", "beside"), [(2, -1e-13), (3, 1e-13)])
def test_every_segment_has_a_length_beside_a_whole_contact_ratio(pairs, beside):
    """Where a pair leaves as the mesh cycle ends, or just after it has begun."""

    def made(addendum):
        return assemble(involute.FAMILY, drive_of((math.radians(20.0), 0.0, addendum, 0.02)))

    addendum = brentq(lambda height: made(height).contact_ratio - 2.0 - beside, 1.0, 1.4, xtol=1e-15)
    cycle = tabulate(made(addendum), (STEEL, STEEL), mesh(points=5), pairs)
    assert cycle.contact_ratio == pytest.approx(2.0, abs=1e-11)
    assert cycle.boundary[0] == 0.0
    assert cycle.boundary[-1] == 1.0
    assert np.diff(cycle.boundary).min() > 5e-12


@FAMILIES
def test_nodes_are_enough(family):
    coarse = tabulate(assemble(family, DRIVE), (STEEL, STEEL), mesh(points=9), 2)
    fine = tabulate(assemble(family, DRIVE), (STEEL, STEEL), mesh(points=65), 2)
    for cycle in (coarse, fine):  # the last node of a pair is its own last contact, whatever the grid
        assert cycle.signed_distance[0, -1, 0] == pytest.approx(fine.signed_distance[0, -1, 0], rel=1e-13)
    np.testing.assert_allclose(coarse.compliance, fine.compliance[:, ::8], rtol=1e-13)


def test_two_pairs_share_their_bodies():
    cycle = tabulate(assemble(crc.FAMILY, DRIVE), (STEEL, STEEL), ENERGY, 2)
    alone = tabulate(assemble(crc.FAMILY, DRIVE), (STEEL, STEEL), mesh(foundation_coupling=False), 2)
    assert not alone.coupling.any()
    np.testing.assert_array_equal(cycle.compliance, alone.compliance)
    ratio = cycle.coupling[0, :, 0, 1] / np.sqrt(cycle.compliance[0, :, 0] * cycle.compliance[0, :, 1])
    assert np.all((ratio > 0.1) & (ratio < 0.5))


def test_hub_at_the_rim_uncouples():
    # with the hub right under the teeth a load hardly reaches the neighbour
    stiff = DRIVE._replace(
        pinion=DRIVE.pinion._replace(bore_radius=0.0295), gear=DRIVE.gear._replace(bore_radius=0.065)
    )
    usual = tabulate(assemble(crc.FAMILY, DRIVE), (STEEL, STEEL), ENERGY, 2).coupling[0, :, 0, 1]
    assert np.all(
        tabulate(assemble(crc.FAMILY, stiff), (STEEL, STEEL), ENERGY, 2).coupling[0, :, 0, 1] < 0.15 * usual
    )


class TestOptions:
    def test_constant(self):
        cycle = tabulate(
            assemble(crc.FAMILY, DRIVE), (STEEL, STEEL), mesh(compliance="constant", stiffness=3e8), 2
        )
        np.testing.assert_allclose(cycle.compliance, 1 / 3e8)
        assert cycle.hertz_coefficient == 0
        assert not cycle.coupling.any()

    def test_load_dependent_contact_stands_apart(self):
        linear = tabulate(assemble(crc.FAMILY, DRIVE), (STEEL, STEEL), ENERGY, 2)
        dependent = tabulate(assemble(crc.FAMILY, DRIVE), (STEEL, STEEL), mesh(hertz="load-dependent"), 2)
        hertz = 4 * (1 - 0.3**2) / (math.pi * 206e9 * 0.02)
        np.testing.assert_allclose(linear.compliance - dependent.compliance, hertz, rtol=1e-9)
        assert dependent.hertz_coefficient == pytest.approx(1.275 / (206e9**0.9 * 0.02**0.8))

    def test_table_is_followed(self):
        roll = np.linspace(-0.25, 0.25, 2001)
        stiffness = 2e8 * (1 + 0.3 * np.cos(5 * roll))
        cycle = tabulate(
            assemble(crc.FAMILY, DRIVE), (STEEL, STEEL), mesh(compliance="table", table=(roll, stiffness)), 2
        )
        rolls = cycle.roll_start + cycle.phase * cycle.pitch_angle
        np.testing.assert_allclose(
            cycle.compliance[..., 1], 1 / (2e8 * (1 + 0.3 * np.cos(5 * rolls))), rtol=1e-6
        )

    def test_harmonics_and_table_of_the_error_add_up(self):
        roll = np.linspace(-0.3, 0.3, 5)
        options = mesh(error_harmonics=((1, 2e-6, 0.3), (3, 1e-6, 0.0)), error_table=(roll, 1e-5 * roll))
        cycle = tabulate(assemble(crc.FAMILY, DRIVE), (STEEL, STEEL), options, 2)
        angle = 2 * np.pi * cycle.phase
        rolls = cycle.roll_start + cycle.phase * cycle.pitch_angle
        expected = 2e-6 * np.cos(angle + 0.3) + 1e-6 * np.cos(3 * angle) + 1e-5 * rolls
        np.testing.assert_allclose(cycle.gap[..., 1], expected, atol=1e-18)

    @pytest.mark.parametrize(
        ("options", "back", "key"),
        [
            ({"compliance": "table", "table": (np.array([-0.1, 0.5]), np.ones(2))}, False, "mesh.table"),
            ({"compliance": "table"}, False, "mesh.table"),
            ({"compliance": "constant"}, False, "mesh.stiffness"),
            ({"compliance": "constant", "stiffness": 1e8, "hertz": "load-dependent"}, False, "mesh.hertz"),
            ({"error_table": (np.array([-0.5, 0.1]), np.zeros(2))}, False, "mesh.transmission_error.table"),
            ({}, True, "mesh.backlash"),
        ],
    )
    def test_refusals_name_the_key(self, options, back, key):
        with pytest.raises(InputError) as error:
            tabulate(assemble(crc.FAMILY, DRIVE), (STEEL, STEEL), mesh(**options), 2, back)
        assert error.value.key == key

    def test_solid_body_that_is_held_is_refused(self):
        solid = DRIVE._replace(gear=DRIVE.gear._replace(bore_radius=0.0))
        with pytest.raises(InputError, match="held at its bore"):
            tabulate(assemble(crc.FAMILY, solid), (STEEL, STEEL), mesh(body="held"), 2)


@FAMILIES
def test_back_flanks_are_the_mirror_image(family):
    cycle = tabulate(assemble(family, DRIVE), (STEEL, STEEL), mesh(backlash=5e-5), 2, back=True)
    front = tabulate(assemble(family, DRIVE), (STEEL, STEEL), ENERGY, 2)
    np.testing.assert_array_equal(cycle.side, [1, 1, -1, -1])
    assert cycle.in_contact.shape == (4, 4)
    path = family.working_path(DRIVE)
    # conjugate flanks all touch after the same rotation
    turned = cycle.gap[..., 2:] / np.cos(cycle.pressure_angle[..., 2:])
    np.testing.assert_allclose(turned, 5e-5 / np.cos(path.pressure_angle(0.0)), rtol=1e-12)
    pitch, half = cycle.pitch_angle, math.pi / 23
    for s in range(4):
        for k in (1, 30, 63):
            newest = cycle.roll_start + cycle.phase[s, k] * pitch
            # back flank of every tooth: half a pitch behind its front flank, turning the other way
            rolls = half - (newest + pitch * np.arange(-5, 6))
            touching = rolls[(rolls > cycle.roll_start) & (rolls < cycle.roll_end)]
            mine = cycle.signed_distance[s, k, 2:][cycle.in_contact[s, 2:] > 0]
            np.testing.assert_allclose(np.sort(mine), np.sort(path.signed_distance(touching)), atol=1e-12)
    together = np.interp(cycle.phase[0], front.phase[0], front.compliance[0, :, 1])
    np.testing.assert_allclose(cycle.compliance[0, :, 1], together, rtol=1e-4)


def figures(family, parameters, points=33):
    """Contact ratio, mean mesh stiffness (1e8 N/m) and quasi-static efficiency with μ = 0.05."""
    cycle = tabulate(assemble(family, drive_of(parameters)), (STEEL, STEEL), mesh(points=points), 2)
    stiffness = cycle_mean(cycle, quasi_static(cycle, 500.0).mesh_stiffness)
    return cycle.contact_ratio, stiffness / 1e8, mean_efficiency(cycle, 500.0, 0.05)


START = {"involute": np.array([math.radians(20.0), 0.1, 1.0, 0.02])}
START["crc"] = np.array([math.radians(22.81), 0.0, 1.0, 0.02])


@pytest.mark.slow
@ONE_FAMILY
def test_gradients_agree_with_finite_differences(family):
    start = START[family.name]

    def traced(parameters):
        values = jnp.stack(figures(family, parameters))
        return values, values

    jacobian, values = jax.jit(jax.jacfwd(traced, has_aux=True), compiler_options=ONE_CALL)(
        jnp.asarray(start)
    )
    np.testing.assert_allclose(values, figures(family, start), rtol=1e-12)
    steps = np.array([1e-5, 1e-5, 1e-5, 1e-7])
    for i, step in enumerate(steps):
        if family.name == "crc" and i == 1:
            continue  # a CRC drive has no profile shift
        forward, back = (np.array(figures(family, start + sign * step * np.eye(4)[i])) for sign in (1, -1))
        difference = (forward - back) / (2 * step)
        np.testing.assert_allclose(jacobian[:, i], difference, rtol=1e-5, atol=1e-9)


@pytest.mark.soak
@ONE_FAMILY
def test_a_thousand_drives_in_one_batch(family):
    rng = np.random.default_rng(1)
    batch = START[family.name] * (1 + 0.01 * rng.uniform(-1, 1, size=(1000, 4)))
    mapped = jax.vmap(lambda p: jnp.stack(figures(family, p, points=5)))
    many = jax.jit(mapped, compiler_options=ONE_CALL)(jnp.asarray(batch))
    assert np.all(np.isfinite(many))
    for i in (0, 500, 999):
        np.testing.assert_allclose(many[i], figures(family, batch[i], points=5), rtol=1e-10)


class TestQuasiStatic:
    """Load sharing and loss against a plain calculation."""

    def test_normal_and_friction_forces_turn_the_gear(self):
        """Moments about the gear's centre from the positions of the contacts, by vectors."""
        cycle = tabulate(assemble(crc.FAMILY, DRIVE), (STEEL, STEEL), ENERGY, 2)
        share = 0.2 * np.sign(cycle.signed_distance)
        load = quasi_static(cycle, 500.0, share).normal_load
        cosine, sine = np.cos(cycle.pressure_angle), np.sin(cycle.pressure_angle)
        x, y = cycle.signed_distance * cosine, cycle.signed_distance * sine - cycle.gear_pitch_radius
        # the flank of the gear is pushed along (cos α, sin α), and rubbed along (sin α, −cos α)
        force_x, force_y = load * (cosine + share * sine), load * (sine - share * cosine)
        turning = (x * force_y - y * force_x).sum(axis=-1)
        np.testing.assert_allclose(turning, 500.0, rtol=1e-12)

    @FAMILIES
    def test_loss_is_the_integral_of_sliding_friction(self, family):
        cycle = tabulate(assemble(family, DRIVE), (STEEL, STEEL), ENERGY, 2)
        fine = tabulate(assemble(family, DRIVE), (STEEL, STEEL), mesh(points=4001), 2)
        loads = quasi_static(fine, 500.0).normal_load
        power = (0.05 * loads * np.abs(fine.pinion_speed - fine.gear_speed)).sum(axis=-1)
        loss = sum(np.trapezoid(power[s], fine.phase[s]) for s in range(2))
        useful = 500.0 * 23 / 47
        assert mean_efficiency(cycle, 500.0, 0.05) == pytest.approx(useful / (useful + loss), abs=1e-9)


class TestBodies:
    def thin(self, bore=0.028):
        return assemble(
            involute.FAMILY,
            DRIVE._replace(pressure_angle=math.radians(20.0), pinion=DRIVE.pinion._replace(bore_radius=bore)),
        )

    def test_ring_is_stiffer_than_the_polynomials_on_a_thin_rim_and_close_on_a_thick_one(self):
        least = {
            (bore, body): tabulate(self.thin(bore), (STEEL, STEEL), mesh(foundation=body), 2).compliance.min()
            for bore in (0.015, 0.028)
            for body in ("sainsot-velex", "ring")
        }
        assert least[0.028, "ring"] < 0.91 * least[0.028, "sainsot-velex"]
        assert least[0.015, "ring"] == pytest.approx(least[0.015, "sainsot-velex"], rel=0.02)

    def test_remark_on_a_rim_that_the_polynomials_are_off_for(self):
        steel = (STEEL, STEEL)
        remark = compliance_remark(self.thin(), steel, mesh(body="held"))
        assert "extrapolated: pinion root radius" in remark
        assert "the pinion's is 2.4" in remark
        assert "the gear's" not in remark
        assert 'mesh.foundation = "ring"' in remark
        assert "mesh.foundation" not in compliance_remark(self.thin(0.015), steel, ENERGY)
        assert not compliance_remark(self.thin(), steel, mesh(foundation="ring"))

    def test_polynomials_far_outside_their_range_are_refused(self):
        wheel = DRIVE.gear._replace(teeth=560.0, bore_radius=0.7)
        many = assemble(involute.FAMILY, DRIVE._replace(pressure_angle=math.radians(20.0), gear=wheel))
        with pytest.raises(InputError, match=r"the gear's body no positive compliance.*ring") as caught:
            tabulate(many, (STEEL, STEEL), ENERGY, 2)
        assert caught.value.key == "mesh.foundation"
        assert tabulate(many, (STEEL, STEEL), mesh(foundation="ring"), 2).compliance.min() > 0


@pytest.mark.parametrize("shift", [0.5, 0.55, 0.56])
def test_few_teeth_with_tips_close_to_an_edge(shift):
    def few(teeth, shift):
        return GearBody(float(teeth), shift, 1.0, 1.25, 0.25, 0.02, 0.004)

    pair = assemble(involute.FAMILY, Drive(0.003, math.radians(20.0), few(8, shift), few(9, 0.5)))
    cycle = tabulate(pair, (STEEL, STEEL), mesh(body="held"), 2)
    inside = (cycle.in_contact[:, None, :] > 0) & np.ones_like(cycle.compliance, dtype=bool)
    r = np.asarray(cycle.signed_distance)[inside]
    teeth = [loaded_tooth(pair, side, held=True) for side in SIDES]
    direct = sum(tooth_compliance(tooth, STEEL, 0.02, r).total for tooth in teeth)
    np.testing.assert_allclose(cycle.compliance[inside], direct + hertz_linear(STEEL, STEEL, 0.02), rtol=0.01)
