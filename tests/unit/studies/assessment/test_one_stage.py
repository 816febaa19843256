"""One stage has one life: typed as a train and as a pair of gears; a life without end is a lower bound."""

import math
import tomllib
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest

from tests.support.drawn_shafts import BETWEEN
from tribodyn.errors import InputError
from tribodyn.gears.prepare import assembled
from tribodyn.gears.rating.capacity import (
    Capacity,
    as_life,
    capacity_of,
    life_bins,
    required,
    shorter_life,
)
from tribodyn.gears.rating.limits import LIMITS, judged, with_unlimited, written_limit
from tribodyn.gears.rating.spectrum import spectrum_part
from tribodyn.gears.rating.standard import rated_duty, standard_of
from tribodyn.quantities.catalogue import QUANTITIES
from tribodyn.record.reader import Record
from tribodyn.studies import STUDIES
from tribodyn.studies.motion.train import assessable as whole
from tribodyn.studies.protocol.load import load_data, load_scenario
from tribodyn.studies.protocol.run import run

OIL = {"lubricant": "iso-vg-320-mineral"}
RATED = {
    "application_factor": 1.25,
    "face_load_factor": 1.2,
    "required_safety_pitting": 1.1,
    "edition": 2006,  # with which the life is between 5e7 and 1e10 cycles
}
GEARS = (
    {"teeth": 19, "profile_shift": 0.35, "face_width": "47 mm"},
    {"teeth": 83, "profile_shift": 0.1, "face_width": "45 mm"},
)
FLANKS = {"material": "18CrNiMo7-6", "mean_roughness": "0.6 um", "quality": 6}
TEETH = {"module": "3 mm", "pressure_angle": "20 deg", "helix_angle": "15 deg"}
DUTY = {"oil_temperature": "70 degC", "power": "75 kW"}
TRAIN = {
    "title": "A stage",
    "kind": "gear-train",
    **OIL,
    **FLANKS,
    "gear": {
        "pinion": {**GEARS[0], "hand": "left", "bore_diameter": "20 mm"},
        "wheel": {**GEARS[1], "bore_diameter": "70 mm"},
    },
    "stage": [{"gears": ["pinion", "wheel"], **TEETH}],
    "bearings": "rigid-1e9",
    "operating": {"input": "pinion", "output": "wheel", "input_speed": "1480 rpm", **DUTY},
    "mesh": {"damping_ratio": 0.05},
    "friction": {"law": "niemann"},
}


def capacity(case: Any, settings: Any) -> Capacity:
    assembly = assembled(case)
    factors = standard_of(case, assembly, rated_duty(settings, 343.15, face=1.2)).factors
    found = capacity_of(case, assembly, factors, life_bins(case, assembly, factors), settings)
    assert found is not None
    return found


@pytest.fixture(scope="module")
def pair() -> Any:
    """The pair at the centre distance of the train, where it meshes without backlash."""
    gears = {
        side: {**gear, "bore_radius": bore}
        for side, gear, bore in zip(("pinion", "gear"), GEARS, ("10 mm", "35 mm"), strict=True)
    }
    scenario = {
        "title": "A pair",
        "kind": "assessment",
        **OIL,
        "drive": {"family": "involute", **FLANKS, **TEETH, **gears},
        "operating": {"pinion_speed": "1480 rpm", **DUTY},
        "assessment": RATED,
    }
    return load_data(scenario, "pair").case.pair


def test_a_stage_has_one_life_as_a_train_and_as_a_pair(pair: Any):
    train = load_data(TRAIN, "train")
    (mesh,) = whole.meshes(train.case)
    own, other = capacity(mesh.pair, pair.settings), capacity(pair, pair.settings)
    for first, second in zip(own.gears, other.gears, strict=True):
        assert first.pitting.safety == pytest.approx(second.pitting.safety, rel=1e-6)
        assert first.bending.safety == pytest.approx(second.bending.safety, rel=1e-6)
    assert own.life == pytest.approx(other.life, rel=1e-4)


DUTIES = ({"share": 3.0, "power": "60 kW"}, {"share": 1.0, "power": "90 kW"})


def test_a_load_spectrum_of_a_train_is_that_of_the_pair(pair: Any, tmp_path: Path):
    """Life and Miner's sum of every duty of the stage's assessment, and of the pair rated with its duties."""
    own = {"name": "out", "gears": ["wheel"], "drawn": BETWEEN}
    scenario = {**TRAIN, "duty": DUTIES, "shaft": [own], "mesh": {"damping_ratio": 0.05, "slices": 3}}
    operating = {**TRAIN["operating"], "duty": 2}
    del operating["power"]
    bearings = {"pinion": {"stiffness_x": "1e9 N/m", "stiffness_y": "1e9 N/m", "damping_ratio": 0.05}}
    scenario |= {"operating": operating, "bearings": bearings, "solver": {"cycles": 2}}
    data = {
        "title": "Stage",
        "kind": "train-assessment",
        "scenario": scenario,
        "assessment": {**RATED, "speeds": 0, "samples": 0},
    }
    result = run(load_data(data, "stage").case, tmp_path / "stage.h5")
    found = result.summary["meshes"]["pinion-wheel"]
    speed, ratio = 1480.0 * math.pi / 30.0, 83 / 19
    spectrum = [(share, speed, power / speed * ratio) for share, power in ((0.75, 60e3), (0.25, 90e3))]
    case = replace(pair, operating=replace(pair.operating, gear_torque=spectrum[1][2]))
    assembly = assembled(case)
    factors = standard_of(case, assembly, rated_duty(case.settings, 343.15, face=1.2)).factors
    bins = life_bins(case, assembly, factors, spectrum)
    expected = capacity_of(case, assembly, factors, bins, case.settings)
    assert expected is not None
    assert found["margins"]["iso"]["life"] == pytest.approx(expected.life, rel=1e-4)
    known = spectrum_part(expected, required(case.settings))["spectrum"]
    for name, sides in known.items():
        if name != "duty_number":
            for side, values in sides.items():
                assert found["spectrum"][name][side] == pytest.approx(values, rel=1e-4)
    # and the bearings of the drawn shaft under the second duty
    assert set(result.summary["bearings"]) == {"out-1", "out-2"}
    with Record(result.path) as record:
        titles = [table.title for table in STUDIES["train-assessment"].besides("tables", record)]
        text = STUDIES["train-assessment"].own_page()(record)
    assert "Bearings" in titles
    assert sum("Miner's sum" in title for title in titles) == 2
    assert "Miner's sum, duty by duty" in text


def test_what_one_per_cent_of_stress_costs_is_the_slope_of_the_life_factor(pair: Any):
    """Z_NT of case-hardened steel falls from 1 to 0.85 from 5e7 to 1e10 cycles: ISO 6336-2, table 2."""
    found = capacity(pair, pair.settings).shortest
    exponent = math.log(1e10 / 5e7) / math.log(1.0 / 0.85)
    assert not found.unlimited
    assert found.left == pytest.approx(1.01**-exponent, rel=1e-6)


def test_a_life_without_end_is_written_as_a_lower_bound_and_a_shorter_one_is_not():
    ended, endless = as_life(3600.0, False), as_life(7200.0, True)
    life = QUANTITIES["life"]
    assert life.written_of(shorter_life(ended, endless, {})) == "1"
    assert life.written_of(shorter_life(endless)) == "≥ 2"
    assert shorter_life({}) == {}
    limits = with_unlimited(judged({"life": 3600.0}, {"life": 7200.0}), endless)
    assert written_limit("life", limits["life"]) == "≥ 2"
    assert LIMITS["life"].least


def test_a_lightly_loaded_pair_lasts_without_end():
    light = load_scenario("assessment-helical-24-95", {"operating.power": "100 kW"}).pair
    found = capacity(light, light.settings)
    assert found.shortest.unlimited
    assert found.shortest.left == 1.0


def test_an_assessment_takes_any_gearbox(tmp_path: Path):
    """A train under the short name of the kind is assessed as one, and so it is from its record."""
    data = {
        "title": "x",
        "kind": "assessment",
        "scenario": TRAIN,
        "assessment": {**RATED, "speeds": 0, "samples": 0},
    }
    loaded = load_data(data, "x")
    assert (loaded.study.kind, loaded.case.kind) == ("train-assessment", "train-assessment")
    again = load_data(tomllib.loads(loaded.case.toml), "again")
    assert again.case.limits == loaded.case.limits
    long = load_data(data | {"kind": "train-assessment"}, "x")
    assert long.case.gearbox.case.toml == loaded.case.gearbox.case.toml
    with pytest.raises(InputError, match=r"assessment\.speedz"):
        load_data(data | {"assessment": {"speedz": 0}}, "x")


@pytest.mark.soak
def test_stresses_of_the_simulation_are_those_of_the_pair(tmp_path: Path):
    """Spur teeth pressed and in motion: a train whose motion is by finite elements, and a pair."""
    teeth = {name: value for name, value in TEETH.items() if name != "helix_angle"}
    spur = {
        **TRAIN,
        "gear": {name: {**gear, "hand": None} for name, gear in TRAIN["gear"].items()},
        "stage": [{"gears": ["pinion", "wheel"], **teeth}],
        "mesh": {"compliance": "fem", "damping_ratio": 0.05},
        "solver": {"cycles": 60},
        "output": {"samples_per_cycle": 80},
    }
    for gear in spur["gear"].values():
        del gear["hand"]
    asked = {"application_factor": 1.25, "speeds": 0, "samples": 0}
    data = {"title": "x", "kind": "train-assessment", "scenario": spur, "assessment": asked}
    found = run(load_data(data, "x").case, tmp_path / "x.h5").summary["meshes"]["pinion-wheel"]
    sides = {
        side: {**gear, "bore_radius": bore}
        for side, gear, bore in zip(("pinion", "gear"), GEARS, ("10 mm", "35 mm"), strict=True)
    }
    pair = {
        "title": "y",
        "kind": "assessment",
        **OIL,
        "drive": {"family": "involute", **FLANKS, **teeth, **sides},
        "bearings": "rigid-1e9",
        "operating": {"pinion_speed": "1480 rpm", **DUTY},
        "assessment": asked | {"speeds": 8, "samples": 0, "friction_laws": ["niemann"]},
    }
    other = run(load_data(pair, "y").case, tmp_path / "y.h5").summary
    for name in ("sigma_H", "sigma_F", "S_H", "S_F"):
        for side in ("pinion", "gear"):
            assert found["simulated"][name][side] == pytest.approx(other["simulated"][name][side], rel=1e-9)
            assert found["iso"][name][side] == pytest.approx(other["iso"][name][side], rel=1e-6)
    for name in ("K_Hbeta", "K_Halpha", "c_prime", "c_gamma_alpha"):
        assert found["simulated"][name] == pytest.approx(other["simulated"][name], rel=1e-9)
