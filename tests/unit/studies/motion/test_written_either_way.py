"""One gearbox written as a pair and as a train: the same numbers, whatever the feature.

And the features of a pair, a reducer of two stages and a planetary set: each has them, or it is said why not.
"""

from pathlib import Path
from typing import Any

import h5py
import numpy as np
import pytest
import tomli_w

from tests.support.drawn_shafts import BETWEEN, OVERHUNG
from tests.support.three_gearboxes import (
    GEARBOX_LOADS,
    GEARBOXES,
    INVOLUTE,
    MESH,
    NETWORK,
    PINION,
    PLACES,
    SPALL,
    SPRINGS,
    heard,
)
from tests.support.train_scenarios import REDUCER
from tribodyn.dynamics.parameters import frictionless
from tribodyn.errors import InputError
from tribodyn.numerics.elementary import exp
from tribodyn.record.reader import Record
from tribodyn.record.schema import ANGLES
from tribodyn.record.sensors import read_sensed
from tribodyn.solve.initial import static_equilibrium
from tribodyn.studies import STUDIES
from tribodyn.studies.design.scenario import loaded_search
from tribodyn.studies.motion.case import Gearbox
from tribodyn.studies.motion.check import check
from tribodyn.studies.motion.prepare import prepare
from tribodyn.studies.motion.report import REPORTED
from tribodyn.studies.pages import drawable, figure
from tribodyn.studies.protocol.load import load_data
from tribodyn.studies.protocol.run import run
from tribodyn.train.structure import rotational_error

OIL = {"lubricant": "iso-vg-220-mineral"}
SHORT = {"solver": {"cycles": 2}, "output": {"samples_per_cycle": 20}}
MATRIX = np.diag([6e8, 7e8, 2e8, 2e6, 3e6, 0.0])
MATRIX[0, 4] = MATRIX[4, 0] = 8e6
ON_MATRIX = {"matrix": MATRIX.tolist(), "matrix_units": "N, m, rad", "damping_ratio": 0.04}
DRAG = {"type": "tapered-roller", "mean_diameter": "60 mm"}
SLICES = {"compliance": "energy", "slices": 5, "damping_ratio": 0.05}

SENSORS = [{"name": "a", "kind": "acceleration", "at": "gear", "rate": "5 kHz"}]
#: What rounding alone makes, and what the clock says.
OWN = "energy_residual", "wall_time"
DRAWN = {"drive": "helical-23-47", "mesh": SLICES, "bearings": {}}
BY_GEAR = DRAWN | {"shaft": {"pinion": OVERHUNG, "gear": BETWEEN}}
IN_A_LIST = DRAWN | {
    "shaft": [
        {"name": "one", "gears": ["pinion"], "drawn": OVERHUNG},
        {"name": "two", "gears": ["gear"], "drawn": BETWEEN},
    ]
}
FORMULAS = {"churning": "iso-14179-1", "windage": "anderson-loewenthal", "bearings": "palmgren"}
#: What the pair says, and what the train says in its place.
FEATURES: dict[str, tuple[dict[str, Any], ...]] = {
    "plain": ({}, {}),
    "matrices": ({"bearings": {"pinion": ON_MATRIX, "gear": SPRINGS}},) * 2,
    "bearings of all": ({"bearings": {"default": SPRINGS}},) * 2,
    "slices": ({"drive": "helical-23-47", "mesh": SLICES},) * 2,
    "drawn shafts": (BY_GEAR, IN_A_LIST),
    "drawn shafts in a list": (IN_A_LIST,) * 2,
    "drawn shafts by gear": (BY_GEAR,) * 2,
    "losses": (
        {"losses": FORMULAS | {"gear_immersion": "20 mm", "pinion_bearings": DRAG, "gear_bearings": DRAG}},
        {
            "losses": FORMULAS
            | {"immersion": {"gear": "20 mm"}, "shaft_bearings": {"pinion": DRAG, "gear": DRAG}}
        },
    ),
    "load spectrum": (
        {"duty": [{"share": 1.0, "gear_torque": "80 N*m"}, {"share": 3.0, "pinion_speed": "700 rpm"}]},
        {"duty": [{"share": 1.0, "output_torque": "80 N*m"}, {"share": 3.0, "input_speed": "700 rpm"}]},
    ),
    "sensors": ({"sensor": SENSORS, "solver": {"cycles": 8}},) * 2,
    "damage": ({"damage": [{"gear": "gear", "tooth": 3, "kind": "spall", **SPALL}]},) * 2,
    "tooth by tooth": ({"drive": {"pinion": {**PINION, "eccentricity": "15 um"}}},) * 2,
    "temperature": ({"temperature": {"model": "network", **NETWORK}},) * 2,
    "tolerance class": ({"drive": {"quality": 6}},) * 2,
}


def scenario_of(kind: str, keys: dict[str, Any]) -> Gearbox:
    names = ("pinion_speed", "gear_torque") if kind == "gear-pair" else ("input_speed", "output_torque")
    operating: dict[str, Any] = {names[0]: "1500 rpm", names[1]: "150 N*m", "oil_temperature": "70 degC"}
    keys = dict(keys)
    if "duty" in keys:
        operating["duty"] = 2
    drive = keys.pop("drive", {})
    drive = drive if isinstance(drive, str) else INVOLUTE | drive
    base = {
        "title": kind,
        "kind": kind,
        "mesh": MESH,
        "friction": {"law": "coulomb", "coefficient": 0.05},
        "bearings": "rigid-1e9",
    }
    return load_data(base | OIL | SHORT | {"drive": drive, "operating": operating} | keys, kind).case


def numbers_of(part: Any, path: str = "") -> dict[str, Any]:
    """All numbers of a model by where they stand."""
    if isinstance(part, tuple):
        names = getattr(part, "_fields", range(len(part)))
        found: dict[str, Any] = {}
        for name, each in zip(names, part, strict=True):
            found |= numbers_of(each, f"{path}.{name}")
        return found
    return {path: part} if isinstance(part, (int, float, np.ndarray, np.generic)) else {}


@pytest.mark.parametrize("feature", FEATURES)
def test_it_is_one_model(feature: str):
    """To the last bit but of the ratio: every number of bodies, links, mesh, schedule and operation."""
    one, other = (
        numbers_of(prepare(scenario_of(kind, keys)).model)
        for kind, keys in zip(("gear-pair", "gear-train"), FEATURES[feature], strict=True)
    )
    assert one.keys() == other.keys()
    assert len(one) > 80
    for place, value in one.items():
        np.testing.assert_allclose(other[place], value, rtol=1e-11, atol=1e-13, err_msg=place)


@pytest.mark.parametrize(
    "feature", ["losses", "load spectrum", "slices", "tolerance class", "sensors", "temperature"]
)
def test_it_is_one_run(feature: str, tmp_path: Path):
    """Quantities of the summary, of the train or of its only mesh; datasets without the mesh's dimension."""
    records = []
    for kind, keys in zip(("gear-pair", "gear-train"), FEATURES[feature], strict=True):
        result = run(scenario_of(kind, keys), tmp_path / f"{kind}.h5")
        assert result.status == "complete"
        records.append(result)
    with Record(records[0].path) as pair, Record(records[1].path) as train:
        of_mesh = train.summary["meshes"]["mesh"] | train.summary
        for quantity in (one for some in REPORTED.values() for one in some):
            assert (quantity.name in pair.summary) <= (quantity.name in train.summary), quantity.name
        assert not {"driver", "driven"} & train.summary.keys()
        numbers = {name: value for name, value in pair.summary.items() if isinstance(value, (int, float))}
        known = {name: value for name, value in numbers.items() if name in of_mesh and name not in OWN}
        assert len(known) > 30
        for name, value in known.items():
            assert of_mesh[name] == pytest.approx(value, rel=1e-5, abs=1e-12), name
        for name in (
            "normal_load",
            "signed_distance",
            "central_film_thickness",
            "bearing_force_x",
            "transmission_error_rotational",
        ):
            found = train.over_meshes(name)
            np.testing.assert_allclose(found, pair.over_meshes(name), rtol=1e-6, err_msg=name)
        for name in ("x", "y", "angle", "x_rate", "speed", *(["z", "tilt_x"] if feature == "slices" else [])):
            expected, found = pair.over_bodies(name), train.over_bodies(name)
            atol = 1e-5 * np.max(np.abs(expected))
            np.testing.assert_allclose(found, expected, rtol=1e-5, atol=atol, err_msg=name)
        for record, listed in ((pair, "pinion_angle"), (train, "reference_angle")):
            np.testing.assert_array_equal(record["pinion_angle"], record["reference_angle"])
            assert ANGLES.keys() & set(record) == {listed}
            with h5py.File(record.path) as file:
                assert file["pinion_angle"] == file["reference_angle"]
        if feature == "losses":
            assert {"power_churning", "power_windage", "power_bearings"} <= set(known)
            assert train.summary["efficiency_with_losses"] < train.summary["efficiency"]
        if feature == "slices":
            np.testing.assert_allclose(train["line_load"][:, 0], pair["line_load"], rtol=1e-6, atol=1e-3)
        if feature == "tolerance class":
            assert known["dynamic_factor_iso"] > 1.0


def lives(checked: Any) -> list[dict[str, float]]:
    return list(checked.data["bearings"].values())


def test_bearings_of_drawn_shafts_have_the_lives_of_a_pair():

    pair, train = (
        scenario_of(kind, keys)
        for kind, keys in zip(("gear-pair", "gear-train"), FEATURES["drawn shafts"], strict=True)
    )
    one, other = (lives(check(box)) for box in (pair, train))
    assert len(one) == len(other) == 4
    for of_pair, of_train in zip(one, other, strict=True):
        assert of_pair.keys() == of_train.keys()
        assert of_train == pytest.approx(of_pair, rel=1e-9)
    assert "rating_life" in one[0]


def on_springs(shaft: dict[str, Any]) -> dict[str, Any]:
    """A shaft whose bearings are alike in all directions, as rows of rolling elements are not."""
    springs = {"stiffness_x": "4e8 N/m", "stiffness_y": "4e8 N/m", "stiffness_axial": "2e8 N/m"}
    return shaft | {"bearing": [springs | {"position": each["position"]} for each in shaft["bearing"]]}


STAGE = {"module": "3 mm", "pressure_angle": "20 deg", "helix_angle": "15 deg"}


@pytest.mark.parametrize("azimuth", ["90 deg", "0 deg", "-140 deg"])
@pytest.mark.parametrize("sense", ["clockwise", "counter-clockwise"])
def test_a_train_bends_alike_from_wherever_it_is_seen(azimuth: str, sense: str):
    """At another azimuth; in the other sense with teeth of the other hand, which is the view in a mirror."""
    hand = {"clockwise": ("left", "right"), "counter-clockwise": ("right", "left")}[sense]
    errors = []
    for place, way, hands in ((azimuth, sense, hand), ("90 deg", "clockwise", ("left", "right"))):
        gears = {
            name: {**INVOLUTE[side], "hand": own}
            for name, side, own in zip(("a", "b"), ("pinion", "gear"), hands, strict=True)
        }
        data = {
            "title": "A stage",
            "kind": "gear-train",
            "material": "18CrNiMo7-6",
            "mean_roughness": "0.4 um",
            "gear": gears,
            "stage": [{"gears": ["a", "b"], "azimuth": place, **STAGE}],
            "shaft": [
                {"name": "one", "gears": ["a"], "drawn": on_springs(OVERHUNG)},
                {"name": "two", "gears": ["b"], "drawn": on_springs(BETWEEN)},
            ],
            "bearings": {},
            "operating": {
                "input": "a",
                "output": "b",
                "sense": way,
                "input_speed": "1500 rpm",
                "output_torque": "150 N*m",
                "oil_temperature": "70 degC",
            },
            "mesh": SLICES,
            "friction": {"law": "none"},
        }
        model = frictionless(prepare(load_data(data | OIL, "stage").case).model)
        errors.append(float(rotational_error(static_equilibrium(model, 0.3), 0, model)))
    assert errors[0] == pytest.approx(errors[1], rel=1e-5)


def test_shafts_of_several_gears_name_their_places():
    keys = {"bearings": {}, "shaft": [{"name": "one", "gears": ["pinion", "gear"], "drawn": BETWEEN}]}
    with pytest.raises(InputError, match=r"shaft\.0\.drawn\.gear_position.*the place of one"):
        scenario_of("gear-train", keys)
    for kind in ("gear-pair", "gear-train"):
        with pytest.raises(InputError, match=r"shaft\.0\.gears.*one gear alone"):
            scenario_of(kind, {"shaft": [{"name": "one", "gears": ["pinion"]}]})
    with pytest.raises(InputError, match=r"shaft\.0\.gears.*turn on two shafts"):
        scenario_of("gear-pair", {"shaft": [{"name": "one", "gears": ["pinion", "gear"]}]})


@pytest.mark.parametrize("kind", ["gear-pair", "gear-train"])
def test_what_is_wrong_with_a_shaft_is_told_of_either(kind: str):
    def refused(keys: dict[str, Any]) -> str:
        with pytest.raises(InputError) as error:
            scenario_of(kind, keys)
        return str(error.value)

    one = {"name": "one", "gears": ["pinion"], "drawn": BETWEEN}
    assert 'shaft.0.gears.0 = "pinon": ' in refused({"bearings": {}, "shaft": [one | {"gears": ["pinon"]}]})
    assert "turns with the shaft one already" in refused({"shaft": [one, one | {"name": "two"}]})
    stiff = one | {"stiffness": "1e5 N*m/rad"}
    assert "shaft.0.stiffness: follows from the sections" in refused({"shaft": [stiff]})
    again = {"bearings": {"pinion": SPRINGS, "gear": SPRINGS}}
    assert "bearings.pinion: gives the stiffness of the shaft of pinion again" in refused(
        again | {"shaft": [one]}
    )
    assert "which [shaft.pinion] draws" in refused(again | {"shaft": {"pinion": BETWEEN}})
    assert 'bearings.pinon = "pinon"' in refused({"bearings": {"default": SPRINGS, "pinon": SPRINGS}})


def falling(contact: Any, film: Any, surfaces: Any, parameters: Any) -> Any:
    """The law of docs/extending.md, whose machine code it shares."""
    return 0.03 + 0.09 * exp(-contact.entrainment / 2.0)


def test_a_law_from_python_takes_the_place_of_a_trains(tmp_path: Path):
    result = run(scenario_of("gear-train", {}), tmp_path / "own.h5", friction=falling)
    with Record(result.path) as record:
        expected = 0.03 + 0.09 * np.exp(-record.over_meshes("entrainment_speed") / 2.0)
        np.testing.assert_allclose(record.over_meshes("friction_coefficient"), expected, rtol=1e-12)


def everything(gearbox: str) -> dict[str, Any]:
    """Tables of what a run has at once: losses, a load spectrum, sensors, a bulk temperature."""
    body, gear, _, load = PLACES[gearbox]
    losses = {
        "pair": FORMULAS | {"gear_immersion": "20 mm", "gear_bearings": DRAG},
        "reducer": FORMULAS | {"immersion": {gear: "20 mm"}, "shaft_bearings": {body: DRAG}},
        # gears of a planetary stage churn by no formula that is known
        "planetary": {"bearings": "palmgren", "shaft_bearings": {body: DRAG}},
    }
    shape = {body: [0.3, 0.9]}
    mode = {"frequency": "0.9 kHz", "damping_ratio": 0.03, "mass": "160 kg", "shape": shape}
    base = GEARBOXES[gearbox]
    return base | {
        "losses": losses[gearbox],
        "duty": [{"share": 1.0, load: "120 N*m"}, {"share": 3.0}],
        "operating": base["operating"] | {"duty": 2},
        "sensor": heard(gearbox),
        "housing": {"mode": [mode | {"points": {"top": 1.0}}]},
        "temperature": {"model": "network", **NETWORK},
    }


@pytest.fixture(scope="module")
def of_everything(tmp_path_factory: pytest.TempPathFactory) -> dict[str, Record]:
    folder = tmp_path_factory.mktemp("everything")
    records = {}
    for name in GEARBOXES:
        result = run(load_data(everything(name), name).case, folder / f"{name}.h5")
        assert result.status == "complete"
        records[name] = Record(result.path)
    return records


KINDS_OF_MOTION = [STUDIES["gear-pair"], STUDIES["gear-train"]]
#: Quantities of planets, which the others have not; churning and windage, see `everything`.
OF_PLANETS = {"mesh_load_factor", "planet_load_factor_max"}
#: Figures of what these records have not: slices, shafts, helical teeth, changing speed, whole revolutions.
OF_OTHERS = {"ring-shape", "line-load", "shafts", "in-space", "orders", "revolutions", "synchronous-average"}


@pytest.mark.parametrize("gearbox", GEARBOXES)
def test_every_quantity_of_every_gearbox(gearbox: str, of_everything: dict[str, Record]):
    """Whatever a sweep of one of them keeps, the run of each says, of itself or of every mesh."""
    summary = of_everything[gearbox].summary
    meshes = list(summary["meshes"].values()) if "meshes" in summary else [summary]
    further = {"S_B", "S_lambda", "dynamic_factor_iso", "efficiency_with_losses", "power_bearings"}
    names = further.union(*(study.swept() for study in KINDS_OF_MOTION))
    for name in names - (set() if gearbox == "planetary" else OF_PLANETS):
        assert summary.get(name) is not None or all(mesh.get(name) is not None for mesh in meshes), name
    shares = np.reshape(summary["mode_shares"], (len(summary["mode_frequencies"]), -1))
    np.testing.assert_allclose(np.sum(shares, axis=1), 1.0, rtol=1e-9)
    assert summary["efficiency_with_losses"] < summary["efficiency"]
    rated = max(meshes, key=lambda mesh: mesh.get("dynamic_factor_iso", 0.0))
    for name in ("dynamic_factor_iso", "resonance_ratio_iso"):
        assert summary[name] == rated[name]


@pytest.mark.parametrize("gearbox", GEARBOXES)
def test_every_figure_of_every_gearbox(gearbox: str, of_everything: dict[str, Record]):
    every = set().union(*(study.drawings() for study in KINDS_OF_MOTION))
    without = set() if gearbox == "planetary" else {"planet-load", "orbit"}
    record = of_everything[gearbox]
    assert set(drawable([record])) == every - OF_OTHERS - without
    for name in (
        "mesh-force",
        "displacement",
        "loss",
        "film-parameter",
        "bearing-load",
        "modes",
        "train",
        "path-of-contact",
    ):
        figure(name, [record]).draw_without_rendering()


@pytest.mark.parametrize("gearbox", GEARBOXES)
def test_every_sensor_of_every_gearbox(gearbox: str, of_everything: dict[str, Record]):
    signals = read_sensed(of_everything[gearbox]).signals
    assert [signal.kind for signal in signals] == [sensor["kind"] for sensor in heard(gearbox)]
    assert all(np.ptp(signal.values) > 0.0 for signal in signals)


def test_the_force_of_a_pair_is_drawn_from_its_torque(of_everything: dict[str, Record]):
    """Base and pitch circle: Σ F_n cos α along the pitch tangent, friction aside."""
    record = of_everything["pair"]
    along = np.nansum(record["normal_load"] * np.cos(record["pressure_angle"]), axis=1)
    (line,) = figure("mesh-force", [record], cycles=None).axes[0].lines
    assert np.mean(np.asarray(line.get_ydata())) == pytest.approx(np.mean(along), rel=0.02)


SPALLED = {"tooth": 3, "kind": "spall", **SPALL}
#: Features that `check` reaches, by tables of the gearboxes.
CHECKED: dict[str, dict[str, dict[str, Any]]] = {
    "bearing matrices": {
        "pair": {"bearings": {"pinion": ON_MATRIX, "gear": SPRINGS}},
        "reducer": {"bearings": {"default": SPRINGS, "middle": ON_MATRIX}},
    },
    "drawn shafts": {
        "pair": {"bearings": {"gear": SPRINGS}, "shaft": {"pinion": OVERHUNG}},
        "reducer": {
            "bearings": {"wheel-2": SPRINGS, "middle": SPRINGS},
            "shaft": [*REDUCER["shaft"], {"name": "in", "gears": ["pinion-1"], "drawn": OVERHUNG}],
        },
    },
    "damage": {
        gearbox: {"damage": [{"gear": gear, **SPALLED}]}
        for gearbox, gear in zip(GEARBOXES, ("gear", "wheel-1", "ring"), strict=True)
    },
    "network of temperatures": {
        gearbox: {"temperature": {"model": "network", **NETWORK}} for gearbox in GEARBOXES
    },
}
#: What has no meaning in a planetary stage, and why.
REFUSED: dict[str, tuple[dict[str, Any], str]] = {
    "bearing matrices": (
        {"bearings": {"default": SPRINGS, "carrier": ON_MATRIX}},
        "couples directions in which bodies of planetary stages do not move",
    ),
    "drawn shafts": (
        {"shaft": [{"name": "in", "gears": ["sun"], "drawn": OVERHUNG}]},
        "is of a planetary stage, whose bodies move in the plane",
    ),
    "slices": (
        {"mesh": {"compliance": "fem", "slices": 5, "damping_ratio": 0.05}},
        "internal spur pairs are even along the face",
    ),
    "formula of temperatures": ({"temperature": {"model": "iso"}}, "is of external gears"),
    "churning": (
        {"losses": {"churning": "iso-14179-1", "immersion": {"ring": "20 mm"}}},
        "the formulas are of gears on fixed axes",
    ),
}


@pytest.mark.parametrize(
    ("feature", "gearbox"), [(feature, gearbox) for feature in CHECKED for gearbox in CHECKED[feature]]
)
def test_features_that_are_checked(feature: str, gearbox: str):
    """Shafts that bend have bearings with lives, and every gearbox a Campbell table and shares of modes."""
    loaded = load_data(GEARBOXES[gearbox] | CHECKED[feature][gearbox], gearbox)
    checked = loaded.study.check(loaded.case)
    titles = " ".join(table.title for table in checked.every)
    assert "Campbell" in titles
    assert "shares of the kinetic energy" in titles
    if feature == "drawn shafts":
        assert all("rating_life" in bearing for bearing in checked.data["bearings"].values())


@pytest.mark.parametrize("feature", REFUSED)
def test_what_planetary_stages_do_not_have_is_said(feature: str):
    tables, reason = REFUSED[feature]
    with pytest.raises(InputError, match=reason):
        load_data(GEARBOXES["planetary"] | tables, "planetary")


@pytest.mark.parametrize("gearbox", GEARBOXES)
def test_searches_and_slopes_take_the_keys_of_every_gearbox(gearbox: str, tmp_path: Path):
    """A profile shift is free in a search, and the load is a number that quantities have slopes by."""
    shift = {"pair": "drive.gear", "reducer": "gear.wheel-2", "planetary": "gear.sun"}[gearbox]
    free = [{"key": f"{shift}.profile_shift", "from": -0.05, "to": 0.05}]
    file = tmp_path / f"{gearbox}.toml"
    file.write_text(tomli_w.dumps(GEARBOXES[gearbox]))
    search = loaded_search(str(file), {"free": free, "minimise": ["loss"]}, {}).case
    assert [each.keys for each in search.free] == [(f"{shift}.profile_shift",)]
    loaded = load_data(GEARBOXES[gearbox], gearbox)
    load = f"operating.{PLACES[gearbox][-1]}"
    slopes = loaded.study.differentiable(loaded.case, ["efficiency"], [load])
    assert slopes.at == pytest.approx([GEARBOX_LOADS[gearbox]])
