"""Derivatives of a train's quantities by its numbers, against differences of rescaled scenarios."""

import numpy as np
import pytest

import tribodyn as td
from tests.support.slopes import compare, shipped
from tests.support.train_scenarios import REDUCER

#: Its meshes have the same teeth, and one compiled program.
TWICE = REDUCER | {
    "gear": REDUCER["gear"] | {"wheel-1": REDUCER["gear"]["wheel-2"]},
    "mesh": {"compliance": "constant", "stiffness": "4e8 N/m", "damping_ratio": 0.05},
    "friction": {"law": "niemann"},
}
#: One stage of another family, and one by a drive file.
CYCLOID = REDUCER | {
    "gear": {name: {"teeth": teeth, "face_width": "20 mm"} for name, teeth in (("one", 23), ("two", 47))},
    "stage": [
        {
            "gears": ["two", "one"],
            "module": "3 mm",
            "family": "cycloidal",
            "shape": {"approach_circle": "26 mm", "recess_circle": "14 mm"},
        }
    ],
    "shaft": [],
    "operating": REDUCER["operating"] | {"input": "one", "output": "two"},
}
DRIVE = {name: REDUCER[name] for name in ("title", "kind", "lubricant", "mesh", "friction")} | {
    "drive": "spur-25-51",
    "operating": {
        "output_speed": "500 rpm",
        "output_torque": "100 N*m",
        "oil_temperature": "70 degC",
    },
}
#: Keys of every kind; those in one text are changed together, for a gear has one module.
REDUCED = [
    *("gear.wheel-1.profile_shift", "gear.pinion-2.addendum", "gear.wheel-2.face_width"),
    *("stage.0.module", "stage.1.pressure_angle", "stage.0.centre_distance", "operating.output_torque"),
    *("material.youngs_modulus", "gear.wheel-1.material.youngs_modulus"),
]
IDLER = [
    *("gear.idler.addendum", "gear.idler.face_width", "gear.driver.profile_shift"),
    *("stage.0.module stage.1.module", "operating.output_torque"),
]


@pytest.mark.parametrize(
    ("source", "groups", "overrides"),
    [
        pytest.param(
            shipped("two-stage-reducer"),
            REDUCED,
            {
                "stage.0.centre_distance": "138.6 mm",
                "gear.wheel-1.material": "C45",
                "friction.law": "masjedi-khonsari",
            },
            id="reducer",
        ),
        pytest.param(
            shipped("idler-train"),
            IDLER,
            {"gear.driven.face_width": "36 mm"},
            id="idler",
            marks=pytest.mark.soak,
        ),
        pytest.param(
            shipped("two-pinions-bull-gear", power="200 kW"),
            ["operating.power", "operating.input_speed", "load.0.torque", "gear.bull.profile_shift"],
            {},
            id="splitter",
        ),
        pytest.param(
            shipped("two-pinions-bull-gear", input_torque="1600 N*m"),
            ["operating.input_torque", "load.0.torque"],
            {},
            id="torque-put-in",
            marks=pytest.mark.soak,
        ),
        pytest.param(DRIVE, ["drive.gear.addendum", "drive.module"], {}, id="drive"),
    ],
)
def test_teeth_and_pressures(source, groups, overrides):
    case = td.scenario(source, overrides)
    names = "contact_ratio", "centre_distance", "hertz_pressure"
    compare(
        source,
        [f"{mesh.name}.{name}" for mesh in case.meshes for name in names],
        groups,
        overrides,
        alone=False,
    )


def test_shape_of_a_stage():
    compare(CYCLOID, ["two-one.contact_ratio"], ["stage.0.shape.approach_circle", "gear.two.addendum"])


@pytest.mark.slow
def test_losses_of_all_meshes():
    keys = "operating.input_speed", "operating.output_torque", "gear.wheel-1.addendum", "stage.1.module"
    compare(TWICE, ["efficiency", "friction_power", "pinion-2-wheel-2.friction_power"], keys)


@pytest.mark.soak
@pytest.mark.parametrize(("name", "gear"), [("two-stage-reducer", "wheel-1"), ("idler-train", "idler")])
def test_films_and_losses_of_shipped_trains(name, gear):
    case = td.scenario(name)
    of = ["efficiency", *(f"{mesh.name}.{of}" for mesh in case.meshes for of in ("film_min", "loss_factor"))]
    keys = ["operating.input_speed", "operating.output_torque", "lubricant.viscosity_40", "mean_roughness"]
    compare(shipped(name), of, [*keys, f"gear.{gear}.addendum", "material.youngs_modulus"], rel=1e-4)


@pytest.mark.slow
def test_losses_of_a_constant_coefficient():
    """In proportion to load and speed; the efficiency does not depend on either."""
    law = {"friction": {"law": "coulomb", "coefficient": 0.05}}
    keys = ["operating.output_torque", "operating.input_speed"]
    function = td.differentiable(TWICE | law, ["friction_power", "efficiency"], keys)
    values, slopes = function.jacobian(function.at)
    np.testing.assert_allclose(slopes[0] * function.at, values[0], rtol=1e-8)
    np.testing.assert_allclose(slopes[1] * function.at, 0.0, atol=1e-10)


def test_closed_forms():
    """Hertz's pressure goes with √T in every mesh, whatever its ratio to the output."""
    found = td.gradient("two-stage-reducer", "first.hertz_pressure", "operating.output_torque")
    assert found.sensitivity["operating.output_torque"] == pytest.approx(0.5, rel=1e-10)
    assert (found.unit, found.about) == (
        "Pa",
        "maximum Hertz pressure of one pair at the pitch point, mesh first",
    )
    distance = td.gradient(
        "idler-train", "driver-idler.centre_distance", ["stage.0.module", "stage.1.module"]
    )
    assert distance.gradient["stage.1.module"] == 0.0


@pytest.mark.parametrize(
    ("of", "wrt", "said"),
    [
        ("frist.efficiency", "stage.0.module", 'did you mean "first"'),
        ("first.eficiency", "stage.0.module", 'did you mean "efficiency"'),
        ("eficiency", "stage.0.module", 'did you mean "efficiency"'),
        ("contact_ratio", "stage.0.module", 'is a quantity of a mesh; name one: "first.contact_ratio"'),
        ("efficiency", "stage.0.modul", 'did you mean "stage.0.module"'),
        ("efficiency", "gear.pinion-1.teeth", "is a whole number"),
        ("efficiency", "stage.2.module", "no key to differentiate by"),
        ("efficiency", "bearings.default.stiffness_x", "no key to differentiate by"),
        ("efficiency", [], "nothing to differentiate by"),
        ("efficiency", ["stage.0.module"] * 2, "is named twice"),
    ],
)
def test_what_cannot_be_differentiated(of, wrt, said):
    with pytest.raises(td.InputError) as error:
        td.gradient("two-stage-reducer", of, wrt)
    assert said in str(error.value)


def test_a_mesh_without_load():
    """It loses nothing, and has no quantities of loaded teeth."""
    idle = {"load.0.torque": "0 N*m", "mesh.backlash": "0.1 mm"}
    function = td.differentiable("two-pinions-bull-gear", "friction_power", "operating.output_torque", idle)
    assert [name for _, name in function.parts] == ["friction_power"]
    with pytest.raises(td.InputError, match=r"stage\.1: carries no load"):
        td.gradient("two-pinions-bull-gear", "bull-pump-b.efficiency", "operating.output_torque", idle)
