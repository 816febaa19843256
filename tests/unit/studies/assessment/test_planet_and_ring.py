"""A planet against a through-hardened ring: what is printed for the first stage of NREL's 5 MW gearbox."""

import tomllib

import pytest

from tribodyn.gears.prepare import assembled
from tribodyn.gears.rating.capacity import capacity_of, life_bins
from tribodyn.gears.rating.rating_text import ring_said
from tribodyn.gears.rating.standard import rated_duty, standard_of
from tribodyn.interface.scenario import scenario

SET = """
title = "NREL 5 MW stage 1"
kind = "train-assessment"
[scenario]
title = "stage 1"
kind = "gear-train"
mean_roughness = "0.6 um"
quality = 6
bearings = "stiff-2e9"
[scenario.lubricant]
type = "mineral"
viscosity_40 = "220 mm**2/s"
viscosity_100 = "19 mm**2/s"
density_15 = "890 kg/m**3"
fzg_scuffing_stage = 14
fzg_micropitting_stage = 10
[scenario.gear.sun]
teeth = 19
face_width = "491 mm"
profile_shift = 0.6170
tip_diameter = "978.808 mm"
bore_diameter = "482.33 mm"
material = {like = "18CrNiMo7-6", contact_stress_limit = "1500 MPa", bending_stress_limit = "430 MPa"}
[scenario.gear.planet]
teeth = 17
face_width = "491 mm"
profile_shift = 0.8021
tip_diameter = "905.470 mm"
bore_diameter = "408.99 mm"
material = {like = "18CrNiMo7-6", contact_stress_limit = "1500 MPa", bending_stress_limit = "430 MPa"}
[scenario.gear.ring]
teeth = 56
internal = true
face_width = "491 mm"
profile_shift = -0.5013
tip_diameter = "2475.118 mm"
outer_diameter = "2994.24 mm"
fillet_radius = 0.30
cutter_teeth = 36
mean_roughness = "1.05 um"
[scenario.gear.ring.material]
like = "42CrMo4"
contact_stress_limit = "700 MPa"
bending_stress_limit = "290 MPa"
hardness="2.35 GPa"
yield_strength="1000 MPa"
[[scenario.stage]]
type = "planetary"
name = "s"
sun = "sun"
planet = "planet"
ring = "ring"
carrier = "carrier"
planets = 3
held = "ring"
module = "45 mm"
rack = "ISO 53 A"
centre_distance = "863 mm"
[[scenario.body]]
name = "carrier"
mass = "5000 kg"
inertia = "6000 kg*m**2"
[scenario.operating]
input = "carrier"
output = "sun"
input_speed = "12.1 rpm"
power = "5000 kW"
oil_temperature = "75 degC"
[scenario.mesh]
damping_ratio = 0.05
[scenario.friction]
law = "niemann"
[assessment]
edition = 2006
application_factor = 1.25
face_load_factor = 1.15
mesh_load_factor = 1.10
transverse_load_factor = 1.0
required_life = "175200 h"
required_safety_pitting = 1.25
required_safety_bending = 1.56
speeds = 0
# planet Rz 4.8 µm, ring 8 µm; K_v at least 1.05 (IEC 61400-4)
peak_roughness = "6.4 um"
dynamic_factor = 1.05
"""


def rated(**changes):
    """Planet and ring by name, the ring as `pinion`."""
    case = scenario(tomllib.loads(SET))
    settings = case.settings.model_copy(update=changes)
    mesh = next(one for one in case.whole.meshes(case.subject.case) if one.name == "s-ring-1")
    pair, assembly = mesh.pair, assembled(mesh.pair)
    duty = rated_duty(
        settings,
        float(pair.lubricant.temperature),
        face=settings.face_of(mesh.name),
        mesh=settings.mesh_load_factor,
    )
    standard = standard_of(pair, assembly, duty)
    bins = life_bins(pair, assembly, standard.factors)
    capacity = capacity_of(pair, assembly, standard.factors, bins, settings, mesh.meshing)
    assert capacity is not None
    return capacity.by_name()


def test_factors_by_the_softer_ring_and_the_planet_s_safety_are_those_printed():
    found = rated()
    planet = {name: found[name]["gear"] for name in ("Z_L", "Z_v", "Z_R", "S_H")}
    assert planet == {
        "Z_L": pytest.approx(1.038, abs=5e-4),
        "Z_v": pytest.approx(0.916, abs=5e-4),
        "Z_R": pytest.approx(1.025, abs=5e-4),
        "S_H": pytest.approx(1.80, abs=5e-3),
    }


def test_the_ring_s_root_by_formula_is_the_one_printed_and_stands_beside_the_fillet_as_cut():
    cut, formula = rated(), rated(ring_root="formula")
    printed = {"h_F": (78.40, 1e-3), "s_Fn": (129.40, 1e-3), "rho_F": (22.24, 1e-3), "sigma_F0": (95.32, 1e6)}
    for name, (value, unit) in printed.items():
        assert formula[name]["pinion"] / unit == pytest.approx(value, abs=5.1e-3), name
    assert formula["Y_F"]["pinion"] == pytest.approx(1.27, abs=5e-3)
    assert formula["Y_S"]["pinion"] == pytest.approx(2.13, abs=5e-3)
    assert formula["S_F"]["pinion"] == pytest.approx(2.79, abs=5e-3)
    for name in ("rho_F", "sigma_F0"):
        assert cut[f"{name}_formula"] == formula[name]
        assert formula[f"{name}_cut"] == cut[name]
    assert formula["sigma_F0_cut"]["gear"] == pytest.approx(formula["sigma_F0"]["gear"], rel=1e-12)
    (said,) = ring_said(cut)
    assert "22.24 mm, 95.3 N/mm² by the formula" in said
    assert not ring_said({name: value for name, value in cut.items() if "_formula" not in name})
