"""The film over the face: closed form at the pitch point, what a slice has of its own load, and errors."""

import numpy as np
import pytest

import tribodyn as td
from tribodyn.studies.pages import figure

OILED = {
    "lubricant": "liu-ni-2022",
    "operating.pinion_speed": "1500 rpm",
    "output.positions_per_cycle": 12,
    "film.law": "dowson-higginson",
    "drive.roughness": "1e-6 um",  # a film of smooth flanks
}
TILTED = OILED | {"mesh.misalignment.in_plane": "2 arcmin", "mesh.slices": 7}
PAIR = "load-contact-18-36"


@pytest.fixture(scope="module")
def aligned() -> td.Run:
    return td.run(PAIR, OILED)


@pytest.fixture(scope="module")
def tilted() -> td.Run:
    return td.run(PAIR, TILTED)


def test_film_at_the_pitch_point_is_dowson_and_higginsons(aligned):
    """h_min = 2.65 R U^0.7 G^0.54 W^-0.13 with radii r sin 20° and speeds ω r sin 20° of the involutes."""
    data = aligned.data
    roll = data["roll_angle"].values
    at = np.unravel_index(np.argmin(np.abs(roll)), roll.shape)
    load = float(data["line_load"].values[at][0])
    radii = [
        r * np.sin(np.radians(20.0)) + s * 0.027 * np.cos(np.radians(20.0)) * roll[at]
        for r, s in ((0.027, 1), (0.054, -1))
    ]
    radius = radii[0] * radii[1] / (radii[0] + radii[1])
    speed = np.pi * 1500 / 30.0
    entrainment = (speed * radii[0] + speed / 2.0 * radii[1]) / 2.0
    modulus = 207e9 / (1.0 - 0.3**2)
    viscosity, pressure_viscosity = 0.35, 25e-9
    expected = (
        2.65
        * radius
        * (viscosity * entrainment / (modulus * radius)) ** 0.7
        * (pressure_viscosity * modulus) ** 0.54
        * (load / (modulus * radius)) ** -0.13
    )
    assert float(data["central_film_thickness"].values[at][0]) == pytest.approx(expected, rel=1e-9)


def test_a_slice_has_the_film_of_its_own_load(tilted):
    """By W^-0.13, at every position of every pair; none where it carries nothing."""
    film, load = (tilted.data[name].values for name in ("central_film_thickness", "line_load"))
    np.testing.assert_array_equal(np.isnan(film), load == 0.0)
    several = np.argwhere((load > 0.0).all(axis=-1))
    assert len(several) > 5
    for position, pair in several:
        h, w = film[position, pair], load[position, pair]
        np.testing.assert_allclose(h / h[0], (w / w[0]) ** -0.13, rtol=1e-9)
    assert np.ptp(load[several[0][0], several[0][1]]) > 0.1 * load.max()


def test_the_summary_has_the_minimum(tilted):
    film = tilted.data["central_film_thickness"].values
    summary = tilted.summary
    assert summary["film_min"] == np.nanmin(film)
    at = np.unravel_index(np.nanargmin(film), film.shape)
    assert summary["film_parameter_min_roll_angle"] == tilted.data["roll_angle"].values[at[:2]]
    assert summary["film_law"] == "dowson-higginson"


def test_the_map_marks_the_minimum(tilted):
    from tribodyn.record.reader import Record

    with Record(tilted.path) as record:
        axes = figure("film-map", [record]).axes[0]
        (cross, *_) = [line for line in axes.lines if line.get_marker() == "x"]
        assert float(cross.get_xdata()[0]) == pytest.approx(
            np.degrees(tilted.summary["film_parameter_min_roll_angle"])
        )


def test_without_a_lubricant_there_is_no_film():
    plain = td.run(PAIR, {"output.positions_per_cycle": 8})
    assert "central_film_thickness" not in plain.data
    assert "film_min" not in plain.summary


@pytest.mark.parametrize(
    ("overrides", "key"),
    [
        ({"lubricant": "liu-ni-2022"}, "operating.pinion_speed"),
        ({"film.law": "moes"}, "film"),
        ({"operating.oil_temperature": "80 degC"}, "operating.oil_temperature"),
        (
            {"lubricant": "iso-vg-220-mineral", "operating.pinion_speed": "1500 rpm"},
            "operating.oil_temperature",
        ),
        (OILED | {"film.law": "no-such"}, "film.law"),
    ],
)
def test_errors(overrides, key):
    with pytest.raises(td.InputError) as caught:
        td.run(PAIR, overrides)
    assert caught.value.key == key
