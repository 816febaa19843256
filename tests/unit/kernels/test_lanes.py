"""Lanes: elementary functions over vectors against higher precision, and tables that differ by lane."""

import numpy as np
import pytest

from tests.support.states import altered
from tribodyn.kernels.lanes import functions  # noqa: F401  (its import gives the laws their functions over lanes)
from tribodyn.kernels.lanes.arrays import rows_of
from tribodyn.kernels.lanes.vectors import WIDTH
from tribodyn.kernels.native import kernel
from tribodyn.numerics import elementary
from tribodyn.solve.lanes.batch import lane_model, pack, shape_of

EPS = np.finfo(float).eps
extended = pytest.mark.skipif(
    np.finfo(np.longdouble).eps > 1e-18, reason="no extended precision here to compare with"
)


@kernel
def _functions(x, out):
    x, out = rows_of(x), rows_of(out)
    for i in range(x.shape[0]):
        out[0, i] = elementary.exp(x[i])
        out[1, i] = elementary.expm1(x[i])
        out[2, i] = elementary.log(x[i])
        out[3, i] = elementary.log1p(x[i])
        out[4, i] = elementary.sin(x[i])
        out[5, i] = elementary.cos(x[i])
        out[6, i] = elementary.sqrt(x[i])
        out[7, i] = elementary.absolute(x[i]) ** -0.17
        out[8, i] = 1.0 / x[i]
        out[9, i] = elementary.maximum(elementary.minimum(x[i], 2.0), -1)


ROWS = ("exp", "expm1", "log", "log1p", "sin", "cos", "sqrt", "power", "reciprocal", "bounded")


def evaluate(x):
    """Every function at every place, by name."""
    padded = np.resize(np.asarray(x, dtype=float), (-(-len(x) // WIDTH), WIDTH))
    out = np.empty((len(ROWS), *padded.shape))
    _functions(padded, out)
    return {name: values.ravel()[: len(x)] for name, values in zip(ROWS, out, strict=True)}


def off(found, exact):
    """Maximum error in units of the last place of the exact value."""
    exact = np.asarray(exact)
    place = np.spacing(np.abs(exact.astype(float))).astype(np.longdouble)
    return float(np.max(np.abs(found.astype(np.longdouble) - exact) / place))


@extended
def test_functions_are_right_to_the_last_place_or_two(rng):
    plain = rng.uniform(-700, 700, 40000)
    small = rng.choice([-1, 1], 40000) * 10 ** rng.uniform(-18, 0, 40000)
    positive = 10 ** rng.uniform(-300, 300, 40000)
    angle = rng.uniform(-1e6, 1e6, 40000)
    near_one = 1.0 + small / 4
    wide = np.longdouble

    assert off(evaluate(plain)["exp"], np.exp(wide(plain))) < 1.1
    assert off(evaluate(small)["exp"], np.exp(wide(small))) < 1.1
    for x in (small, rng.uniform(-40, 40, 40000)):
        assert off(evaluate(x)["expm1"], np.expm1(wide(x))) < 2.1
    for x in (positive, near_one[near_one > 0]):
        assert off(evaluate(x)["log"], np.log(wide(x))) < 1.1
    for x in (small[small > -0.9], positive[positive < 1e300]):
        assert off(evaluate(x)["log1p"], np.log1p(wide(x))) < 2.1
    for x in (angle, small, np.arange(1, 2000) * np.pi / 2):
        assert off(evaluate(x)["sin"], np.sin(wide(x))) < 1.1
        assert off(evaluate(x)["cos"], np.cos(wide(x))) < 1.1
    assert off(evaluate(positive)["sqrt"], np.sqrt(wide(positive))) <= 0.5 + 1e-6
    assert off(evaluate(positive)["reciprocal"], 1 / wide(positive)) <= 0.5 + 1e-3
    error = np.array([10 ** rng.uniform(-10, 4) for _ in range(4000)])
    assert off(evaluate(error)["power"], wide(error) ** wide(-0.17)) < 6


def test_functions_at_the_ends_of_the_numbers():
    huge, tiny, none = np.inf, 5e-324, np.nan
    x = np.array([0.0, -0.0, tiny, 1e-310, 1e308, huge, -huge, none, -1.0, 750.0, -760.0, -708.5])
    with np.errstate(all="ignore"):
        expected = {
            "exp": np.exp(x),
            "expm1": np.expm1(x),
            "log": np.log(x),
            "log1p": np.log1p(x),
            "sqrt": np.sqrt(x),
            "bounded": np.maximum(np.minimum(x, 2.0), -1.0),
        }
    found = evaluate(x)
    for name, values in expected.items():
        np.testing.assert_allclose(found[name], values, rtol=4 * EPS, atol=5e-324, err_msg=name)


@kernel
def _look_up(model, x, out):
    x, out = rows_of(x), rows_of(out)
    times = model.operation.load_times
    for i in range(x.shape[0]):
        place = elementary.last_at_or_below(times, x[i])
        out[0, i] = place
        out[1, i] = times[place]
        out[2, i] = elementary.truncate(x[i])


def test_every_lane_looks_up_its_own_table(prepared, rng):
    base = prepared("crc-23-47").model
    grids = np.sort(rng.uniform(0, 10, (WIDTH, 7)), axis=1)
    models = [
        altered(base, operation={"load_times": grid, "load_torques": grid, "load_slopes": 0 * grid})
        for grid in grids
    ]
    packed = pack(models)
    model, numbers, addresses = lane_model(packed)
    numbers[:], addresses[:] = packed.numbers.T, packed.addresses.T
    x = rng.uniform(-1, 12, (500, WIDTH))
    x[0] = np.nan
    out = np.empty((3, *x.shape))
    _look_up(model, x, out)
    for lane, grid in enumerate(grids):
        place = np.clip(np.searchsorted(grid, x[1:, lane], side="right") - 1, 0, len(grid) - 2)
        np.testing.assert_array_equal(out[0, 1:, lane], place)
        np.testing.assert_array_equal(out[1, 1:, lane], grid[place])
    np.testing.assert_array_equal(out[2, 1:], np.trunc(x[1:]))
    assert np.all(np.isin(out[:, 0], [0.0, *grids[:, 0]]))  # what is not a number reads no wild address


def test_models_of_one_table_share_it(prepared):
    base = prepared("crc-23-47").model
    models = [altered(base, operation={"nominal_speed": 10.0 + i}) for i in range(5)]
    packed = pack(models)
    assert np.all(packed.addresses == packed.addresses[0])
    assert len(packed.kept) == packed.addresses.shape[1]
    operation = next(part for part in packed.fields if part.name == "operation")
    speed = next(field for field in operation.fields if field.name == "nominal_speed")
    column = operation.first.numbers + speed.row
    np.testing.assert_array_equal(packed.numbers[:, column], 10.0 + np.arange(5))


def test_options_and_contacts_make_the_kind(prepared):
    base = prepared("crc-23-47").model
    assert shape_of(base) == shape_of(prepared("crc-23-47", **{"operating.pinion_speed": "300 rad/s"}).model)
    assert shape_of(base) != shape_of(prepared("crc-23-47", **{"friction.law": "none"}).model)
    assert shape_of(base) != shape_of(prepared("crc-23-47", **{"mesh.backlash": "12 um"}).model)
    table = base.meshes[0].table
    flipped = table._replace(in_contact=1.0 - table.in_contact)
    assert shape_of(base) != shape_of(altered(base, mesh={"table": flipped}))
