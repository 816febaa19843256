"""The pair of the template by the standards' formulas, worked out here from drawing and data sheet alone.

Formulas of ISO/TR 15144-1:2014 and ISO 6336-1, method B, in their own units (mm, N, °C).
"""

import math
from typing import Any

import pytest

from tests.support.short_studies import written_template
from tribodyn.gears.prepare import assembled
from tribodyn.gears.rating.standard import RatedDuty, Standard, iso_part, standard_of
from tribodyn.standards import scuffing
from tribodyn.studies.protocol.load import load_scenario

TEETH, SHIFT, MODULE, WIDTH, CENTRE = (25, 60), (0.2, 0.1), 3.0, 40.0, 129.0
ANGLE = math.radians(20.0)
ROUGHNESS, GRADE = 0.8, 6
POWER, SPEED = 20.0, 1800.0 * math.pi / 30.0  # kW, rad/s
MODULUS, POISSON = 206e3, 0.3
CONTACT = math.sqrt(42.0 * 7850.0 * 484.0)  # B_M, W s^½/(m² K)
OIL = 80.0

BASE = [MODULE * z / 2.0 * math.cos(ANGLE) for z in TEETH]
WORKING = math.acos(sum(BASE) / CENTRE)
TIPS = [MODULE * (z / 2.0 + 1.0 + x) for z, x in zip(TEETH, SHIFT, strict=True)]
TANGENTS = [math.sqrt(tip**2 - base**2) for tip, base in zip(TIPS, BASE, strict=True)]
PITCH = math.pi * MODULE * math.cos(ANGLE)
PARTS = [(tip - base * math.tan(WORKING)) / PITCH for tip, base in zip(TANGENTS, BASE, strict=True)]
RATIO = sum(PARTS)
TORQUE = POWER / SPEED * 1e3  # N m


def viscosity(celsius: float) -> float:
    """Dynamic, Pa s, of 220 and 19 mm²/s, 890 kg/m³."""

    def double(value: float) -> float:
        return math.log10(math.log10(value + 0.7))

    slope = (double(220.0) - double(19.0)) / math.log10(373.15 / 313.15)
    kinematic = 10.0 ** (10.0 ** (double(220.0) - slope * math.log10((celsius + 273.15) / 313.15))) - 0.7
    return 1e-6 * kinematic * (890.0 - 0.7 * (celsius + 273.15 - 289.0))


def pressure_viscosity(celsius: float) -> float:
    """α, 1/Pa, of mineral oil."""
    return 2.657e-8 * viscosity(38.0) ** 0.1348 * (1.0 + 516.0 * (1.0 / (celsius + 273.0) - 1.0 / 311.0))


def stiffness() -> tuple[float, float]:
    """c' and c_γα, N/(mm µm); F_t K_A/b is below 100 N/mm."""
    (z1, z2), (x1, x2) = TEETH, SHIFT
    flexibility = 0.04723 + 0.15551 / z1 + 0.25791 / z2 - 0.00635 * x1 - 0.11654 * x1 / z1
    flexibility += -0.00193 * x2 - 0.24188 * x2 / z2 + 0.00529 * x1**2 + 0.00182 * x2**2
    line = TORQUE * 1e3 / (MODULE * TEETH[0] / 2.0) / WIDTH
    rack = 1.0 + 0.5 * (1.2 - 1.25)
    single = 0.8 * rack / flexibility * (line / 100.0) ** 0.25
    return single, single * (0.75 * RATIO + 0.25)


def deviations() -> tuple[float, float]:
    """f_pb of the gear and f_fα, µm, of grade 6 by ISO 1328-1:2013, after running in."""
    step = math.sqrt(2.0) ** (GRADE - 5)
    pitch = step * (0.001 * MODULE * TEETH[1] + 0.4 * MODULE + 5.0) * math.cos(ANGLE)
    form = step * (0.55 * MODULE + 5.0)
    return pitch * (1.0 - 0.075), form * (1.0 - 0.075)


@pytest.fixture(scope="module")
def case(tmp_path_factory: pytest.TempPathFactory) -> Any:
    duty = {"operating.power": "20 kW", "operating.oil_temperature": "80 degC"}
    scenario = written_template("assessment", tmp_path_factory.mktemp("hand"))
    return load_scenario(scenario, {**duty, "drive.mean_roughness": "0.8 um"}).pair


@pytest.fixture(scope="module")
def found(case: Any) -> tuple[dict[str, Any], Any]:
    standard = standard_of(case, assembled(case), RatedDuty(case.oil_temperature))
    return iso_part(case, standard), standard


#: K_A, K_Hβ and X_S of oil that is sprayed in.
APPLICATION, FACE, SPRAYED = 1.25, 1.3, 1.2


@pytest.fixture(scope="module")
def harder(case: Any) -> Standard:
    return standard_of(
        case, assembled(case), RatedDuty(case.oil_temperature, APPLICATION, face=FACE, lubrication="spray")
    )


def test_stiffness_and_load_factors(found: tuple[dict[str, Any], Any]):
    iso, standard = found
    single, mesh = stiffness()
    assert iso["c_prime"] == pytest.approx(single * 1e9, rel=1e-9)
    assert iso["c_gamma_alpha"] == pytest.approx(mesh * 1e9, rel=1e-9)
    line = TORQUE * 1e3 / (MODULE * TEETH[0] / 2.0) / WIDTH
    pitch, form = deviations()
    # N ≤ N_S, ε_γ ≤ 2, no relief credited: B_k = 1
    assert standard.factors.dynamic.range == "subcritical"
    slope = 0.32 * single * pitch / line + 0.34 * single * form / line + 0.23
    assert iso["K_v"] == pytest.approx(1.0 + standard.factors.dynamic.resonance_ratio * slope, rel=1e-9)
    transverse = RATIO / 2.0 * (0.9 + 0.4 * mesh * pitch / (line * iso["K_v"]))
    assert iso["K_Halpha"] == pytest.approx(min(max(transverse, 1.0), 3.0 / (4.0 - RATIO)), rel=1e-9)


def test_friction_bulk_temperature_and_losses(found: tuple[dict[str, Any], Any]):
    iso, _ = found
    losses = (PARTS[0] ** 2 + PARTS[1] ** 2 + 1.0 - RATIO) * (1.0 / TEETH[0] + 1.0 / TEETH[1]) * math.pi
    friction, bulk = friction_and_bulk(iso["K_v"] * iso["K_Halpha"], losses)
    assert iso["H_v"] == pytest.approx(losses, rel=1e-9)
    for name in ("worst", "A", "AB", "B", "C", "D", "DE", "E"):
        assert iso["mu_m"][name] == pytest.approx(friction, rel=1e-9)
        assert iso["theta_M"][name] == pytest.approx(bulk, abs=1e-6)
    assert iso["loss"] == pytest.approx(POWER * 1e3 * friction * losses, rel=1e-9)


def friction_and_bulk(factor: float, losses: float) -> tuple[float, float]:
    """μ_m and θ_M, °C, with the product of the load factors."""
    at_pitch = [base * math.tan(WORKING) for base in BASE]
    radius = at_pitch[0] * at_pitch[1] / sum(at_pitch)
    line = factor * TORQUE * 1e3 / BASE[0] / WIDTH
    speeds = 2.0 * SPEED * at_pitch[0] * 1e-3
    rough = 2.2 * (ROUGHNESS / radius) ** 0.25
    friction = 0.045 * (line / (speeds * radius)) ** 0.2 * (1e3 * viscosity(OIL)) ** -0.05 * rough
    return friction, OIL + 7400.0 * (POWER * friction * losses / (CENTRE * WIDTH)) ** 0.72 / 1.2


def test_film_at_every_point(found: tuple[dict[str, Any], Any]):
    iso, _ = found
    factor = iso["K_v"] * iso["K_Halpha"]
    friction, bulk = friction_and_bulk(factor, iso["H_v"])
    length = RATIO * PITCH
    from_start = TANGENTS[0] - length  # of the base tangent point
    to_pitch = BASE[0] * math.tan(WORKING) - from_start
    share = (7.0 - 2.0) / 15.0  # Q of grades up to 7
    double = length - PITCH
    points = {
        "A": (0.0, share),
        "AB": (double / 2.0, share + 1.0 / 6.0),
        "B": (double, 1.0),
        "C": (to_pitch, 1.0),
        "D": (PITCH, 1.0),
        "DE": (PITCH + double / 2.0, share + 1.0 / 6.0),
        "E": (length, share),
    }
    modulus = MODULUS / (1.0 - POISSON**2)
    films = {}
    for name, (distance, carried) in points.items():
        first = from_start + distance
        second = CENTRE * math.sin(WORKING) - first
        radius = first * second / (first + second)
        speeds = SPEED * first * 1e-3, SPEED * TEETH[0] / TEETH[1] * second * 1e-3
        pressure = math.sqrt(
            factor * TORQUE * 1e3 / BASE[0] / WIDTH * carried * modulus / (2.0 * math.pi * radius)
        )
        width = math.sqrt(8.0 * radius * pressure / modulus)
        into = CONTACT * (math.sqrt(speeds[0]) + math.sqrt(speeds[1]))
        slip = abs(speeds[0] - speeds[1])

        flash = math.sqrt(math.pi) / 2.0 * friction * pressure * 1e6 * slip * width * math.sqrt(1e-3)
        flash /= into
        contact = bulk + flash
        material = pressure_viscosity(bulk) * modulus * 1e6
        speed = viscosity(bulk) * sum(speeds) / (2.0 * modulus * 1e6 * radius * 1e-3)
        load = 2.0 * math.pi * pressure**2 / modulus**2
        sliding = pressure_viscosity(contact) * viscosity(contact)
        sliding /= pressure_viscosity(bulk) * viscosity(bulk)
        films[name] = 1600.0 * radius * material**0.6 * speed**0.7 * load**-0.13 * sliding**0.22
    for name, film in films.items():
        assert iso["h_Y"][name] == pytest.approx(film * 1e-6, rel=1e-6), name
        assert iso["lambda_GF"][name] == pytest.approx(film / ROUGHNESS, rel=1e-6), name
    assert iso["h_Y"]["worst"] == pytest.approx(min(films.values()) * 1e-6, rel=1e-6)
    assert iso["lambda_GF"]["worst"] == pytest.approx(min(films.values()) / ROUGHNESS, rel=1e-6)


def test_load_factors_under_more_load(harder: Standard):
    """K_A makes the teeth stiffer below 100 N/mm; K_A K_v K_Hβ share deviations among more pairs."""
    line = APPLICATION * TORQUE * 1e3 / (MODULE * TEETH[0] / 2.0) / WIDTH
    single, mesh = (value * APPLICATION**0.25 for value in stiffness())
    pitch, _ = deviations()
    assert line < 100.0
    assert harder.factors.stiffness.single_pair == pytest.approx(single * 1e9, rel=1e-9)
    assert harder.factors.stiffness.mesh == pytest.approx(mesh * 1e9, rel=1e-9)
    assert harder.factors.stiffness.mesh_face == pytest.approx(0.85 * mesh * 1e9, rel=1e-9)
    transverse = RATIO / 2.0 * (0.9 + 0.4 * mesh * pitch / (line * harder.factors.dynamic.factor * FACE))
    assert harder.factors.transverse == pytest.approx(
        min(max(transverse, 1.0), 3.0 / (4.0 - RATIO)), rel=1e-9
    )


def test_flash_temperature_place_by_place(harder: Standard):
    """ISO/TR 13989-1, (3) and (22) to (28), at 201 places of the path; w of the base circle for the rise."""
    factor = APPLICATION * harder.factors.dynamic.factor * harder.factors.transverse * FACE
    reference = factor * TORQUE * 1e3 / (MODULE * TEETH[0] / 2.0) / WIDTH
    line = factor * TORQUE * 1e3 / BASE[0] / WIDTH
    at_pitch = [base * math.tan(WORKING) for base in BASE]
    radius = at_pitch[0] * at_pitch[1] / sum(at_pitch)
    speeds = 2.0 * SPEED * at_pitch[0] * 1e-3
    oil = (1e3 * viscosity(OIL)) ** -0.05
    friction = 0.060 * (reference / (speeds * radius)) ** 0.2 * oil * ROUGHNESS**0.25
    length = RATIO * PITCH
    from_start, double = TANGENTS[0] - length, length - PITCH
    modulus = MODULUS / (1.0 - POISSON**2)
    rises = []
    for number in range(201):
        distance = length * number / 200.0
        first = from_start + distance
        second = CENTRE * math.sin(WORKING) - first
        share = min(1.0 / 3.0 + min(distance, length - distance) / double / 3.0, 1.0)
        share = 1.0 if min(distance, length - distance) > double * (1.0 - 1e-9) else share
        v1, v2 = SPEED * first * 1e-3, SPEED * TEETH[0] / TEETH[1] * second * 1e-3
        curved = first * second / (first + second)
        half = math.sqrt(8.0 * line * share * curved / (math.pi * modulus))  # mm
        heat = 1.11 * friction * line * share * 1e3 * abs(v1 - v2)
        # X_J of unmodified flanks before the pitch point, C_eff = K_A F_bt/(b c_γα) in µm
        struck = max(at_pitch[0] - first, 0.0) / length
        relief = APPLICATION * TORQUE * 1e3 / BASE[0] / WIDTH / (harder.factors.stiffness.mesh * 1e-9)
        heat *= 1.0 + relief / 50.0 * struck**3
        rises.append(heat / (math.sqrt(2e-3 * half) * CONTACT * (math.sqrt(v1) + math.sqrt(v2))))
    bulk = OIL + 273.15 + 0.47 * SPRAYED * sum(rises) / len(rises)
    assert harder.flash_bulk == pytest.approx(bulk, rel=1e-6)
    assert harder.flash_contact == pytest.approx(bulk + max(rises), rel=1e-6)


def test_integral_temperature_is_of_drawing_and_data_sheet(harder: Standard):
    """What ISO/TR 13989-2 asks for, in SI; the line load is that of the reference circle."""
    factor = APPLICATION * harder.factors.dynamic.factor * harder.factors.transverse * FACE
    radius = MODULE * TEETH[0] / 2.0 * 1e-3
    mesh = scuffing.ScuffingMesh(
        line_load=factor * TORQUE / radius / (WIDTH * 1e-3),
        pitch_speed=SPEED * radius,
        viscosity=viscosity(OIL),
        oil_temperature=OIL + 273.15,
        roughness=ROUGHNESS * 1e-6,
        reduced_modulus=MODULUS * 1e6 / (1.0 - POISSON**2),
        thermal_contact=CONTACT,
        pressure_angle=ANGLE,
        lubrication=SPRAYED,
        tip_relief=1.0 + 0.06 * max(PARTS) + 0.02 * max(PARTS) ** 2,  # (32) without tip relief
    )
    expected = scuffing.integral_temperature(harder.path, mesh)
    assert harder.integral == pytest.approx(expected, rel=1e-7)
    assert harder.path.tip_contact_ratios == pytest.approx(PARTS, rel=1e-9)
    assert harder.path.pressure_angle == pytest.approx(WORKING, rel=1e-9)
