"""Values outside the field's usual range: what is said of them, and that nothing is said of the rest."""

import json
import math
from pathlib import Path

import pytest

from tests.support.verbs import ROOT, ended, sets
from tools.usual_ranges import usual_ranges
from tribodyn.gears.duty import nominal_duty
from tribodyn.gears.plausibility import USUAL, unusual_values
from tribodyn.geometry.assembly import assemble
from tribodyn.geometry.families import family
from tribodyn.input.sources import names, shipped
from tribodyn.studies.protocol.load import load, load_scenario

DRY, OILED = "involute-18-36", "efficiency-oil-18-36"
#: Name of a range -> a scenario and a slip that leaves that range.
SLIPS = {
    "module": (DRY, {"drive.module": "300 mm"}),
    "face_width": (DRY, {"drive.pinion.face_width": "200 mm", "drive.gear.face_width": "200 mm"}),
    "rim": (DRY, {"drive.pinion.bore_radius": "22.5 mm"}),
    "gear_ratio": (DRY, {"drive.gear.teeth": 360}),
    "contact_ratio": (DRY, {"drive.pinion.addendum": 0.62, "drive.gear.addendum": 0.62}),
    "pitch_line_speed": (DRY, {"operating.pinion_speed": "150000 rpm"}),
    "specific_load": (OILED, {"operating.power": "200 kW"}),
    "hertz_pressure": (OILED, {"operating.power": "200 kW"}),
    "roughness": (DRY, {"drive.mean_roughness": "3 mm"}),
    "roughness_over_module": (DRY, {"drive.roughness": "10 um", "drive.module": "0.6 mm"}),
    "mesh_damping": (DRY, {"mesh.damping_ratio": 5.0}),
    "bearing_damping": (DRY, {"bearings.pinion.damping_ratio": 5.0}),
    "bearing_stiffness": (DRY, {"bearings.pinion.stiffness_x": "1e5 N/m"}),
    "viscosity_40": (OILED, {"lubricant.viscosity_40": "22000 mm**2/s"}),
    "viscosity_slope": (OILED, {"lubricant.viscosity_100": "219 mm**2/s"}),
    "oil_temperature": (OILED, {"operating.oil_temperature": "180 degC"}),
    "inlet_viscosity": (DRY, {"lubricant.inlet_viscosity": "10.6 Pa*s"}),
    "pressure_viscosity": (DRY, {"lubricant.pressure_viscosity": "150 1/GPa"}),
    "oil_density": (DRY, {"lubricant.density": "82 kg/m**3"}),
    "youngs_modulus": (DRY, {"drive.material.youngs_modulus": "2.06 GPa"}),
    "material_density": (DRY, {"drive.material.density": "785 kg/m**3"}),
    "friction_coefficient": (DRY, {"friction.coefficient": 0.47}),
    "relief": (DRY, {"drive.pinion.modification.tip_relief": "200 um", "mesh.compliance": "fem"}),
    "backlash": (DRY, {"mesh.backlash": "1 mm"}),
}


@pytest.mark.parametrize("name", SLIPS)
def test_a_slip_is_named(name: str):
    scenario, slip = SLIPS[name]
    case = load_scenario(scenario, {"film.law": "dowson-higginson"} | slip)  # named: none is chosen
    said = unusual_values(case.pair, getattr(case, "bearings", ()))
    assert any(sentence.startswith(f"{USUAL[name].what}: ") for sentence in said)


def test_every_range_is_tried():
    assert set(SLIPS) == set(USUAL)


def test_shipped_scenarios_are_usual():
    of_gears = [name for name in names(shipped("scenarios")) if load(name).study.has_gears]
    for name in of_gears:
        case = load_scenario(name)
        assert not unusual_values(case.pair, getattr(case, "bearings", ())), name


def test_the_duty_is_that_of_iso_6336():
    """σ_H0 = Z_H Z_E √(F_t/(b d_1) (u + 1)/u) of nominal teeth at the pitch point (ISO 6336-2)."""
    case = load_scenario(DRY).pair
    duty = nominal_duty(case, assemble(family(case.family), case.drive))
    torque, ratio, width, diameter = 318.3, 2.0, 26.7e-3, 54e-3
    load = torque / (0.5 * ratio * diameter)
    material = case.materials[0]
    elastic = math.sqrt(material.youngs_modulus / (2 * math.pi * (1 - material.poisson_ratio**2)))
    zone = math.sqrt(2 / (math.cos(math.radians(20)) ** 2 * math.tan(math.radians(20))))
    pressure = zone * elastic * math.sqrt(load / (width * diameter) * (ratio + 1) / ratio)
    assert duty.hertz_pressure == pytest.approx(pressure * 1e-6, rel=1e-6)
    assert duty.line_load == pytest.approx(load / width * 1e-3, rel=1e-6)
    assert duty.pitch_line_speed == pytest.approx(0.5 * diameter * 1500 * math.pi / 30, rel=1e-6)
    assert duty.power == pytest.approx(159.15 * 1500 * math.pi / 30 * 1e-3, rel=1e-6)


def test_the_pitch_point_of_a_cycloid_has_no_pressure():
    case = load_scenario("cycloidal-23-47").pair
    duty = nominal_duty(case, assemble(family(case.family), case.drive))
    assert duty.place == "end of contact"
    assert 0.0 < duty.hertz_pressure < 5000.0


def test_check_prints_the_duty_first_and_warns(tmp_path: Path):
    words = ("check", DRY, *sets("mesh.damping_ratio=5"))
    result = ended(*words, folder=tmp_path)
    assert result.exit_code == 0
    assert "can be computed, but has 1 unusual value" in result.stdout
    assert result.stdout.index("F_t/b") < result.stdout.index("centre distance")
    for number in ("159.2 N m", "4.241 m/s", "220.8 N/mm", "1.611"):
        assert number in result.stdout
    assert "warning: Damping ratio of the mesh: 5; usual is 0.01 to 0.2" in result.stderr
    data = json.loads(ended(*words, "--json", folder=tmp_path).stdout)
    assert len(data["unusual"]) == 1
    assert data["duty"]["contact ratio"][0] == pytest.approx(1.6111, rel=1e-4)


def test_the_documentation_has_the_table():
    assert usual_ranges() in (ROOT / "docs" / "scenario.md").read_text(encoding="utf-8")
