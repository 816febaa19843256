"""Geometry under JAX: same numbers, right derivatives, a thousand drives at once."""

from functools import cache

import jax
import numpy as np
import pytest

from tests.support.compile_fast import ONE_CALL
from tribodyn.geometry.assembly import assemble
from tribodyn.geometry.body import mass_and_inertia, tooth_outline
from tribodyn.geometry.drive import SIDES, Drive, GearBody, tip_radius
from tribodyn.geometry.families import crc, involute
from tribodyn.geometry.path import contact_limits, contact_ratio, kinematics, seen_from
from tribodyn.geometry.tooth import contact_in_tooth_frame, cut_tooth, thickness_half_angle

jax.config.update("jax_enable_x64", True)

ANGLE, SHIFT, ADDENDUM = np.radians(21.0), 0.2, 1.02
# pressure angle, pinion's profile shift, pinion's addendum, gear's addendum, module
INVOLUTE_VALUES = np.array([ANGLE, SHIFT, ADDENDUM, 0.98, 0.003])
CRC_VALUES = np.array([np.radians(22.81), ADDENDUM, 0.98, 0.003])


def involute_drive(values, teeth):
    angle, shift, pinion_addendum, gear_addendum, module = values
    return Drive(
        module,
        angle,
        GearBody(teeth, shift, pinion_addendum, 1.25, 0.25, 0.02, 0.01),
        GearBody(47.0, -0.05, gear_addendum, 1.25, 0.3, 0.02, 0.01),
    )


def crc_drive(values, teeth):
    angle, pinion_addendum, gear_addendum, module = values
    return Drive(
        module,
        angle,
        GearBody(teeth, 0.0, pinion_addendum, 1.25, 0.25, 0.02, 0.01),
        GearBody(47.0, 0.0, gear_addendum, 1.25, 0.2, 0.02, 0.01),
    )


CASES = [
    pytest.param(involute.FAMILY, INVOLUTE_VALUES, 23.0, id="involute"),
    pytest.param(involute.FAMILY, INVOLUTE_VALUES * [1, 0, 1, 1, 1], 12.0, id="undercut"),
    pytest.param(crc.FAMILY, CRC_VALUES, 23.0, id="crc", marks=pytest.mark.soak),
]
DRIVES = {"involute": involute_drive, "crc": crc_drive}


def ratio_of(family, drive):
    path = family.working_path(drive)
    limits = contact_limits(path, tip_radius(drive, "pinion"), tip_radius(drive, "gear"))
    return contact_ratio(path, *limits, drive.pinion.teeth)


def everything_of(family, drive):
    """Contact ratio, curvature, outlines, contact on the teeth and masses, in numbers near one."""
    path = family.working_path(drive)
    start, end = contact_limits(path, tip_radius(drive, "pinion"), tip_radius(drive, "gear"))
    state = kinematics(path, start + 0.3 * (end - start))
    result = [
        contact_ratio(path, start, end, drive.pinion.teeth),
        state.relative_curvature / 100,
        state.entrainment * 100,
        path.signed_distance(path.rotation(end)) * 100,
    ]
    # One body shows all there is of a shared path, and takes half as long to compile.
    for side in SIDES if family.shiftable else SIDES[1:]:
        tooth, view = cut_tooth(family, drive, side), seen_from(path, side)
        half_angle = thickness_half_angle(tooth, view.pinion_pitch_radius)
        contact = contact_in_tooth_frame(view, half_angle, end if side == "pinion" else -end)
        shape = tooth_outline(cut_tooth(family, drive, side), 5, 5)
        mass, inertia = mass_and_inertia(assemble(family, drive), side, 7850.0)
        result += [contact.y * 1000, contact.load_angle, mass, inertia * 1000]
        result += [shape.fillet_x[2] * 100, shape.fillet_y[2] * 1000, shape.fillet_y[4] * 1000]
        result += [shape.flank_x[2] * 100, shape.flank_y[0] * 1000, shape.flank_y[2] * 1000]
        result += [shape.root_half_angle * 10, shape.tip_half_thickness * 1000, shape.form_radius * 100]
    return result


@cache
def compiled_derivatives(family):
    """(values, teeth) -> Jacobian of everything by the values in forward mode, and everything."""

    def function(values, teeth):
        drive = DRIVES[family.name](values, teeth)
        found = jax.numpy.stack([jax.numpy.asarray(x) for x in everything_of(family, drive)])
        return found, found

    return jax.jit(jax.jacfwd(function, has_aux=True), compiler_options=ONE_CALL)


@cache
def compiled_ratios(family):
    """(values of many drives, teeth) -> their contact ratios, and the gradients of these in reverse mode."""

    def function(values, teeth):
        return ratio_of(family, DRIVES[family.name](values, teeth))

    return jax.jit(jax.vmap(jax.value_and_grad(function), in_axes=(0, None)), compiler_options=ONE_CALL)


@pytest.mark.slow
@pytest.mark.parametrize(("family", "values", "teeth"), CASES)
def test_gradients_agree_with_finite_differences(family, values, teeth):
    def plainly(v):
        return np.array([float(x) for x in everything_of(family, DRIVES[family.name](v, teeth))])

    jacobian, value = compiled_derivatives(family)(values, teeth)
    plain = plainly(values)
    np.testing.assert_allclose(value, plain, rtol=1e-10)
    scale = np.where(values > 0, values, 1.0)
    for column in range(len(values)):
        step = 1e-5 * scale[column]
        above, below = (plainly(values + sign * step * np.eye(len(values))[column]) for sign in (1, -1))
        difference = (above - below) / (2 * step)
        # What does not depend on the parameter is compared with its value.
        error = np.abs(jacobian[:, column] - difference) / (
            np.abs(difference) + 1e-3 * np.abs(plain) / scale[column]
        )
        assert error.max() < 1e-5, (column, error.argmax())


def batch(values):
    """A thousand drives about one, which is the first."""
    count = 1000
    others = np.random.default_rng(7).uniform(-1, 1, (count - 1, len(values)))
    return np.vstack([values, values * (1 + 0.02 * others)])


@pytest.mark.slow
@pytest.mark.parametrize(("family", "values", "teeth"), CASES)
def test_reverse_mode_gives_the_same_gradient(family, values, teeth):
    (forward, *_), _ = compiled_derivatives(family)(values, teeth)
    _, backward = compiled_ratios(family)(batch(values), teeth)
    np.testing.assert_allclose(backward[0], forward, rtol=1e-10, atol=1e-10)
