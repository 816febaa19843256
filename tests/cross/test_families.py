"""Families against one another, and their runs under every compiler and sampling."""

import jax
import jax.numpy as jnp
import numpy as np
import pytest

from tests.support.compile_fast import ONE_CALL
from tests.support.right_hand_sides import assert_right_hand_sides_agree, at_several_conditions
from tribodyn.geometry.assembly import assemble
from tribodyn.geometry.drive import Drive, GearBody, MaterialData
from tribodyn.geometry.families import cycloidal
from tribodyn.mesh.table import MeshData
from tribodyn.mesh.tabulate import pair_slots, tabulate
from tribodyn.record.reader import Record
from tribodyn.studies.protocol.load import load_scenario
from tribodyn.studies.protocol.run import run

STEEL = MaterialData("steel", 206e9, 0.3, 7850.0, 46.0, 470.0, 6e9)


def test_points_of_a_path_give_the_drive_that_has_it(prepared):
    """The CRC drive from its formula and from points of its path every half millimetre."""
    ours, theirs = prepared("points-23-47").cycle, prepared("crc-23-47").cycle
    assert ours.contact_ratio == pytest.approx(theirs.contact_ratio, rel=1e-6)
    phase = np.linspace(0.02, 0.98, 49)
    for name, tolerance in (
        ("pressure_angle", 1e-5),
        ("equivalent_radius", 1e-4),
        ("compliance", 1e-5),
        ("pinion_speed", 1e-5),
    ):
        at = [np.interp(phase, c.phase.ravel(), getattr(c, name)[..., 1].ravel()) for c in (ours, theirs)]
        np.testing.assert_allclose(at[0], at[1], rtol=tolerance, err_msg=name)


@pytest.mark.parametrize("name", ["cycloidal-23-47", "parabolic-23-47"])
def test_right_hand_side_agrees_between_numpy_numba_and_jax(name, prepared, rng):
    model = prepared(name).model
    assert model.options.averaged == 1
    assert_right_hand_sides_agree(at_several_conditions(model), rng, 1e-11)


def drive(shape):
    bodies = (GearBody(z, 0.0, 1.0, 1.25, 0.2, 0.02, b) for z, b in ((23.0, 0.015), (47.0, 0.025)))
    return Drive(0.003, 0.0, *bodies, shape)


@pytest.mark.soak
def test_the_mesh_cycle_differentiates_by_the_shape():
    """Derivative of what the table holds by the shape's numbers, against differences."""
    family, shape = cycloidal.FAMILY, cycloidal.CycloidShape(0.0235, 0.02)
    mesh = MeshData("energy", 0.05, points=9)
    pairs = pair_slots(assemble(family, drive(shape)))

    def figure(values):
        cycle = tabulate(
            assemble(family, drive(cycloidal.CycloidShape(*values))), (STEEL, STEEL), mesh, pairs
        )
        xp = np if isinstance(values, tuple) else jnp
        return (
            1e9 * xp.mean(cycle.compliance * cycle.in_contact[:, None])
            + 100 * xp.mean(cycle.equivalent_radius)
            + cycle.contact_ratio
            + 10 * cycle.pitch_point_length
        )

    slope = jax.jit(jax.grad(figure), compiler_options=ONE_CALL)(jnp.asarray(shape))
    for i, value in enumerate(shape):
        step = 1e-5 * value
        ends = [figure(tuple(v + s * step * (k == i) for k, v in enumerate(shape))) for s in (1, -1)]
        assert slope[i] == pytest.approx((ends[0] - ends[1]) / (2 * step), rel=2e-5)


@pytest.mark.parametrize("name", ["cycloidal-23-47", "parabolic-23-47"])
def test_extremes_do_not_hang_on_a_sample_at_the_pitch_point(name, tmp_path):
    """Film, pressure and temperature stay the same however finely the neighbourhood of P is sampled."""
    found = []
    for samples in (150, 1200):
        case = load_scenario(
            name,
            {"solver.cycles": 2, "output.samples_per_cycle": samples, "friction.sliding": "kinematic"},
        )
        result = run(case, tmp_path / f"{samples}.h5")
        with Record(result.path) as record:
            assert "half width" in record.summary["pitch_point"]
            keys = ("central_film_thickness", "hertz_pressure", "flash_temperature_rise")
            arrays = [np.asarray(record[key])[samples:] for key in keys]
            film, pressure, temperature = arrays
            assert np.nanmin(film) > 0
            found.append((np.nanmin(film), np.nanmax(pressure), np.nanmax(temperature)))
    np.testing.assert_allclose(found[0], found[1], rtol=0.05)
