"""Pitting, bending and life of a pair: given factors replace computed ones; load spectra; what is refused."""

import math
from typing import Any

import pytest

from tribodyn.cases.assessment_part import Meshing
from tribodyn.compliance.iso6336 import blank_factor
from tribodyn.errors import InputError
from tribodyn.gears.prepare import assembled
from tribodyn.gears.rating.capacity import Capacity, capacity_of, life_bins
from tribodyn.gears.rating.standard import Standard, iso_part, rated_duty, standard_of
from tribodyn.geometry.drive import SIDES
from tribodyn.studies.assessment.parts import faces_of, other_torques, request_of
from tribodyn.studies.motion.train import assessable as whole
from tribodyn.studies.protocol.load import load_scenario


def case_of(changes: dict[str, Any] | None = None) -> Any:
    return load_scenario("assessment-helical-24-95", changes or {}).pair


def rated(changes: dict[str, Any] | None = None, **of_gears: Any) -> tuple[Standard, Capacity]:
    """Standard and capacity with a K_Hβ of 1.1 of the contact analysis."""
    case = case_of(changes)
    assembly = assembled(case)
    standard = standard_of(case, assembly, rated_duty(case.settings, case.oil_temperature, face=1.1))
    bins = life_bins(case, assembly, standard.factors, case.spectrum)
    capacity = capacity_of(case, assembly, standard.factors, bins, case.settings, **of_gears)
    assert capacity is not None
    return standard, capacity


@pytest.fixture(scope="module")
def plain() -> tuple[Standard, Capacity]:
    return rated()


GIVEN = {
    "application_factor": ("K_A", 1.5),
    "mesh_load_factor": ("K_gamma", 1.2),
    "dynamic_factor": ("K_v", 1.3),
    "face_load_factor": ("K_Hbeta", 2.06),
    "transverse_load_factor": ("K_Halpha", 1.4),
}


@pytest.mark.parametrize("key", GIVEN)
def test_a_given_factor_replaces_the_computed_one_everywhere(key: str, plain):
    """Stresses grow with its root and with it, film shrinks, contact grows hotter, scuffing nears."""
    name, value = GIVEN[key]
    case = case_of()
    before = iso_part(case, plain[0])
    standard, capacity = rated({f"assessment.{key}": value})
    after = iso_part(case, standard)
    assert after[name] == value
    grown = standard.factors.flank / plain[0].factors.flank
    assert grown > 1.1
    for gear, other in zip(capacity.gears, plain[1].gears, strict=True):
        assert gear.pitting.stress == pytest.approx(other.pitting.stress * math.sqrt(grown), rel=1e-9)
        assert other.bending.stress < gear.bending.stress <= other.bending.stress * grown * 1.0001
        assert gear.pitting.safety < other.pitting.safety
    assert after["lambda_GF"]["worst"] < before["lambda_GF"]["worst"]
    assert standard.flash_contact > plain[0].flash_contact
    assert standard.integral.integral > plain[0].integral.integral


def test_a_gear_blank_softens_the_mesh_and_moves_its_resonance(plain):
    standard, _ = rated({"assessment.gear_blank_factor": 0.8})
    before, after = plain[0].factors, standard.factors
    assert after.stiffness.mesh == pytest.approx(0.8 * before.stiffness.mesh, rel=1e-9)
    assert after.dynamic.resonance_speed == pytest.approx(
        math.sqrt(0.8) * before.dynamic.resonance_speed, rel=1e-9
    )


def test_rim_and_web_as_drawn_soften_the_mesh_and_raise_the_root_stress(plain):
    """C_R of the gear by ISO 6336-1, 1 of the solid pinion, and their mean; Y_B of a thin rim."""
    drawn = {"drive.gear.rim_thickness": "30 mm", "drive.gear.web_thickness": "90 mm"}
    standard, capacity = rated(drawn)
    blank = (1.0 + blank_factor(90.0 / 360.0, 30.0 / 14.0)) / 2.0
    assert standard.factors.stiffness.blank == pytest.approx(blank)
    assert blank < 1.0
    assert capacity.gears[0].factors["Y_B"] == 1.0
    root = 95 * 14.0 / (2 * math.cos(math.radians(10.0))) + 14.0 * (0.6691 - 1.25)
    height = 1395.376 / 2 - root
    assert capacity.gears[1].factors["Y_B"] == pytest.approx(1.6 * math.log(2.242 * height / 30.0), rel=1e-6)
    both = rated(drawn | {"assessment.gear_blank_factor": 0.7})[0]
    assert both.factors.stiffness.blank == 0.7


def test_a_spectrum_of_equal_duties_is_one_duty_without_application_factor():
    duty = {"power": "5000 kW", "pinion_speed": "1165.9 rpm"}
    spectrum = {"duty": [{"share": share, **duty} for share in (1.0, 3.0)], "operating.duty": 1}
    _, several = rated(spectrum)
    _, one = rated({"assessment.application_factor": 1.0})
    for gear, other in zip(several.gears, one.gears, strict=True):
        for name in ("pitting", "bending"):
            assert getattr(gear, name).safety == pytest.approx(getattr(other, name).safety, rel=1e-6)
            assert getattr(gear, name).cycles == pytest.approx(getattr(other, name).cycles, rel=1e-12)


TWO_DUTIES = [
    {"share": 0.7, "power": "7000 kW", "pinion_speed": "1165.9 rpm"},
    {"share": 0.3, "power": "3500 kW", "pinion_speed": "300 rpm"},
]


def test_a_spectrum_is_as_safe_whichever_of_its_duties_is_assessed():
    """K_Hβ of each duty, as the contact analysis has them, and its own K_v, K_Hα and Z_v."""
    faces, found = (1.1, 1.25), []
    for number in (1, 2):
        case = case_of({"duty": TWO_DUTIES, "operating.duty": number})
        assembly = assembled(case)
        duty = rated_duty(case.settings, case.oil_temperature, face=faces[number - 1])
        factors = standard_of(case, assembly, duty).factors
        bins = life_bins(case, assembly, factors, case.spectrum, faces)
        found.append(capacity_of(case, assembly, factors, bins, case.settings))
    one, other = found
    assert one.gears[0].factors["Z_v"] > 1.02 * other.gears[0].factors["Z_v"]
    for first, second in zip(one.gears, other.gears, strict=True):
        for name in ("pitting", "bending"):
            for value in ("safety", "damage", "life", "cycles"):
                own = getattr(getattr(first, name), value)
                assert own == pytest.approx(getattr(getattr(second, name), value), rel=1e-6), (name, value)


def test_the_contact_is_analysed_at_the_torque_of_every_duty():
    """K_Hβ of the duties is one list, whichever of them the ratios are to."""
    found = []
    for number, ratio in ((1, 1.25 / 1.1), (2, 1.1 / 1.25)):
        case = case_of({"duty": TWO_DUTIES, "operating.duty": number})
        own = case.operating.gear_torque
        assert other_torques(case) == (next(torque for *_, torque in case.spectrum if torque != own),)
        quantities = {"face_load_factor": (1.1, 1.25)[number - 1], "face_load_ratios": [ratio]}
        found.append(faces_of(case, quantities))
    assert found == [pytest.approx([1.1, 1.25])] * 2
    assert request_of(case).spectrum_torques == other_torques(case)
    given = case_of({"duty": TWO_DUTIES, "operating.duty": 1, "assessment.face_load_factor": 1.3})
    assert request_of(given).spectrum_torques == ()


def test_the_damage_of_a_spectrum_is_the_sum_over_duties_each_assessed_alone():
    """At the safety of both together Miner's sum is 1: cycles over those that each endures by itself."""
    _, both = rated({"duty": TWO_DUTIES, "operating.duty": 1})
    endured = []
    for duty in TWO_DUTIES:
        alone = {key: value for key, value in duty.items() if key != "share"}
        changes = {f"operating.{key}": value for key, value in alone.items()}
        endured.append(rated(changes | {"assessment.application_factor": 1.0})[1])
    for gear, total in enumerate(both.gears):
        summed = 0.0
        for duty, alone in zip(TWO_DUTIES, endured, strict=True):
            pitting = alone.gears[gear].pitting
            cycles = pitting.curve.endured(total.pitting.safety * pitting.stress)
            summed += duty["share"] * pitting.cycles / cycles
        assert summed == pytest.approx(1.0, rel=1e-4)


def test_rare_overloads_cost_less_than_lasting_ones():
    def spectrum(share: float) -> Capacity:
        duties = [
            {"share": 1.0 - share, "power": "5000 kW", "pinion_speed": "1165.9 rpm"},
            {"share": share, "power": "12000 kW", "pinion_speed": "1165.9 rpm"},
        ]
        return rated({"duty": duties, "operating.duty": 1})[1]

    rare, often = spectrum(1e-4), spectrum(0.5)
    for name in ("pitting", "bending"):
        low, high = (getattr(each.gears[0], name).safety for each in (often, rare))
        assert low < high


def test_life_ends_where_the_safety_is_the_required_one():
    """The life at which Miner's sum is 1, asked for as the required one, has just the required safety."""
    changes = {"operating.power": "20000 kW", "assessment.required_life": "1000 h"}
    _, first = rated(changes)
    for side, gear in zip(SIDES, first.gears, strict=True):
        for failure, required in ((gear.pitting, 1.0), (gear.bending, 1.4)):
            if failure.unlimited:
                continue
            again = rated(changes | {"assessment.required_life": f"{failure.life / 3600.0!r} h"})[1]
            other = again.gears[SIDES.index(side)]
            found = other.pitting if failure is gear.pitting else other.bending
            assert found.safety == pytest.approx(required, rel=1e-6)
            assert found.damage == pytest.approx(1.0, rel=1e-5)
    assert not all(failure.unlimited for gear in first.gears for failure in (gear.pitting, gear.bending))


def test_idlers_and_gears_with_two_pinions_stand_less(plain):
    _, twice = rated(meshing=(Meshing(2), Meshing()))
    assert twice.gears[0].pitting.cycles == 2.0 * plain[1].gears[0].pitting.cycles
    _, idler = rated(meshing=(Meshing(), Meshing(1, reversed=True)))
    assert idler.gears[1].bending.safety / plain[1].gears[1].bending.safety == pytest.approx(0.69, abs=0.03)
    assert idler.gears[1].pitting == plain[1].gears[1].pitting


@pytest.mark.parametrize("drive", ["ring of a train", "spur-25-51", "helical-fzg-20-30"])
def test_internal_external_spur_and_helical_pairs_have_every_factor(drive: str):
    changes = {"drive": {"like": drive, "material": "42CrMo4", "quality": 6}}
    if drive.startswith("ring"):
        train = load_scenario("wind-turbine-gearbox-assessment")
        meshes = whole.meshes(train.gearbox.case)
        case = next(each.pair for each in meshes if each.pair.drive.pinion.teeth < 0)
        assembly, settings = assembled(case), train.settings
    else:
        case = case_of({**changes, "operating.power": "20 kW"})
        assembly, settings = assembled(case), case.settings
    standard = standard_of(case, assembly, rated_duty(settings, 353.15, face=1.1))
    bins = life_bins(case, assembly, standard.factors)
    capacity = capacity_of(case, assembly, standard.factors, bins, settings)
    assert capacity is not None
    found = capacity.by_name()
    entries = [entry if isinstance(entry, dict) else {"": entry} for entry in found.values()]
    numbers = [value for entry in entries for value in entry.values()]
    assert all(math.isfinite(value) and value >= 0.0 for value in numbers)
    assert 0.8 < found["Y_F"]["pinion"] < 3.0
    assert 1.0 < found["Y_S"]["gear"] < 4.0


def test_without_a_heat_treatment_there_are_no_safeties():
    case = case_of({"drive": {"like": "helical-24-95", "material": "steel-liu-ni-2022"}})
    assembly = assembled(case)
    standard = standard_of(case, assembly, rated_duty(case.settings, 353.15, face=1.0))
    assert capacity_of(case, assembly, standard.factors, [], case.settings) is None


@pytest.mark.parametrize("key", ["required_life", "required_safety_pitting", "required_safety_bending"])
def test_a_required_safety_needs_the_strength_of_the_material(key: str):
    value = "100 h" if key == "required_life" else 1.2
    changes = {
        "drive": {"like": "helical-24-95", "material": "steel-liu-ni-2022"},
        f"assessment.{key}": value,
    }
    with pytest.raises(InputError) as caught:
        case_of(changes)
    assert caught.value.key == f"assessment.{key}"
    assert "heat" in str(caught.value) or "treatment" in str(caught.value)


@pytest.mark.parametrize(
    ("changes", "key"),
    [
        ({"assessment.required_life": "0 h"}, "assessment.required_life"),
        ({"assessment.dynamic_factor": 0.9}, "assessment.dynamic_factor"),
        ({"assessment.required_life": "20000"}, "assessment.required_life"),
        ({"assessment.face_load_factor": 0.5}, "assessment.face_load_factor"),
        ({"drive.material.treatment": "hardened"}, "drive.material.treatment"),
        ({"drive.material.contact_stress_limit": "0 MPa"}, "drive.material.contact_stress_limit"),
        ({"operating.pinion_speed": "0 rpm"}, "operating.pinion_speed"),
        ({"drive.gear.web_thickness": "90 mm"}, "drive.gear.rim_thickness"),
        (
            {"drive.gear.rim_thickness": "30 mm", "drive.gear.web_thickness": "400 mm"},
            "drive.gear.web_thickness",
        ),
    ],
)
def test_numbers_without_sense_are_named(changes: dict[str, Any], key: str):
    with pytest.raises(InputError) as caught:
        case_of(changes)
    assert caught.value.key == key
