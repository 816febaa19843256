"""Seals, pump, carriers and oil in meshes: closed forms, borders of regimes, units."""

import math

import numpy as np
import pytest

from tribodyn.tribology.losses import seals
from tribodyn.tribology.losses.carriers import CARRIERS, CarrierInOil, enclosed_drum
from tribodyn.tribology.losses.churning import CHURNING
from tribodyn.tribology.losses.loss import OilState, Sump, Wheel
from tribodyn.tribology.losses.meshes import MESHES, MeshInOil, iso_14179_2, mauz
from tribodyn.tribology.losses.pump import PumpData, pump_torque
from tribodyn.tribology.losses.windage import WINDAGE

RPM = math.pi / 30.0
OIL = OilState(0.030, 850.0)
SUMP = Sump(2e-3, 0.2)
#: FZG type C: 16 and 24 teeth of 4.5 mm, centre distance 91.5 mm, 14 mm wide; dipped to the axes.
PINION = Wheel(36.6e-3, 41.23e-3, 31.1e-3, 14e-3, 4.5e-3, 16.0, 41.23e-3)
GEAR = Wheel(54.9e-3, 59.18e-3, 49.1e-3, 14e-3, 4.5e-3, 24.0, 59.18e-3)
MESH = MeshInOil(PINION, GEAR, 4.5e-3)
DRUM = CarrierInOil(0.2, 0.06, 0.2, 0.01)


def test_seals_by_hand():
    """A lip of 50 mm at 1500 rpm: 28.8 W by part 2; 19.1 and 29.4 W of both materials by part 1."""
    speed = 1500 * RPM
    assert seals.iso_14179_2(seals.SealData(50e-3), OIL).torque * speed == pytest.approx(28.84, rel=1e-3)
    for material, power in (("nbr", 19.08), ("fkm", 29.35)):
        found = seals.iso_14179_1(seals.SealData(50e-3, 2, material), OIL).torque
        assert found * speed == pytest.approx(2 * power, rel=1e-3)
    synthetic = OIL._replace(synthetic=True)
    assert seals.iso_14179_2(seals.SealData(50e-3), synthetic).exceeded == ("mineral oil",)


def test_a_pump_takes_pressure_times_flow():
    """12 l/min against 5 bar at an efficiency of 0.8: 125 W, either way it is given, at any gear ratio."""
    speed = 1800 * RPM
    for pump in (
        PumpData(5e5, flow=0.2e-3),
        PumpData(5e5, displacement=0.2e-3 / 30.0),
        PumpData(5e5, displacement=0.2e-3 / 60.0, ratio=2.0),
    ):
        assert pump_torque(pump, speed).torque * speed == pytest.approx(125.0)


def test_a_drum_in_slow_laminar_oil():
    """Faces shear the gap between two discs: π µ ω R⁴/s; half immersed half of it."""
    thin = CarrierInOil(0.2, 0.0, 0.2, 0.01)
    oil, speed = OilState(3.0, 900.0), 0.01
    exact = math.pi * 3.0 * speed * 0.1**4 / 0.01
    assert enclosed_drum(thin, speed, oil, SUMP).torque == pytest.approx(exact)
    half = CarrierInOil(0.2, 0.0, 0.1, 0.01)
    assert enclosed_drum(half, speed, oil, SUMP).torque == pytest.approx(0.5 * exact)


@pytest.mark.parametrize("method", list(CARRIERS))
def test_drag_of_a_carrier_has_no_steps_and_dies_at_rest(method):
    speeds = np.concatenate([[0.0], np.geomspace(1e-4, 400.0, 4001)])
    torque = CARRIERS[method](DRUM, speeds, OilState(0.05, 870.0), SUMP).torque
    assert torque[0] == 0.0
    assert np.all(np.isfinite(torque))
    assert np.all(torque[1:] > 0.0)
    assert np.all(np.abs(np.diff(np.log(torque[1:]))) < 0.03)


def test_a_fast_drum_in_turbulent_oil():
    """Re = ω R²/ν beyond 10⁶: 0.102 G^0.1 Re^−⅕ of the faces, and 0.065 of the rim; limits of the gap."""
    oil, speed = OilState(0.002, 850.0), 300.0
    reynolds, thin = 850 / 0.002 * 300 * 0.01, 850 / 0.002 * 300 * 0.1 * 0.01
    face = 0.5 * 0.102 * 0.1**0.1 * reynolds**-0.2 * 850 * 300**2 * 0.1**5
    rim = 0.5 * math.pi * 0.065 * 0.1**0.3 * thin**-0.2 * 850 * 300**2 * 0.1**4 * 0.06
    found = enclosed_drum(DRUM, speed, oil, SUMP)
    assert found.torque == pytest.approx(face + rim, rel=1e-9)
    assert found.exceeded == ()
    assert enclosed_drum(CarrierInOil(0.2, 0.06, 0.2, 0.05), speed, oil, SUMP).exceeded


def test_a_drum_knows_no_units():
    """Lengths, times and masses in other units: the torque in those units."""
    length, time, mass = 7.0, 3.0, 11.0
    other = CarrierInOil(0.2 * length, 0.06 * length, 0.13 * length, 0.01 * length)
    oil = OilState(0.03 * mass / (length * time), 850.0 * mass / length**3)
    given = enclosed_drum(CarrierInOil(0.2, 0.06, 0.13, 0.01), 50.0, OIL, SUMP).torque
    found = enclosed_drum(other, 50.0 / time, oil, SUMP).torque
    assert found == pytest.approx(given * mass * length**2 / time**2, rel=1e-9)


def test_oil_sprayed_into_a_mesh_knows_no_units():
    """Mauz' torque has the exponents of a torque; the viscosity only as a ratio to 40 mm²/s."""
    length, time, mass = 7.0, 3.0, 11.0

    def scaled(wheel):
        sizes = [length * size for size in wheel[:5]]
        return Wheel(*sizes, wheel.teeth, length * wheel.immersion)

    mesh = MESH._replace(flow=3e-5, jet_speed=2.0)
    flow, jet = 3e-5 * length**3 / time, 2.0 * length / time
    other = MeshInOil(scaled(PINION), scaled(GEAR), 4.5e-3 * length, flow, jet)
    oil = OilState(40e-6 * 850.0, 850.0)
    density = 850.0 * mass / length**3
    given = mauz(mesh, 300.0, oil, SUMP).torque
    found = mauz(other, 300.0 / time, OilState(40e-6 * density, density), SUMP).torque
    assert found == pytest.approx(given * mass * length**2 / time**2, rel=1e-9)


def test_the_impulse_of_a_jet():
    """Where teeth leave the mesh ρ Q r (v + v_s); a jet that is faster than the teeth drives them not."""
    out = MESH._replace(flow=3e-5, jet_speed=20.0, into_mesh=False)
    assert mauz(out, 300.0, OIL, SUMP).torque == pytest.approx(850 * 3e-5 * 36.6e-3 * (300 * 36.6e-3 + 20))
    slow = mauz(MESH._replace(flow=3e-5, jet_speed=20.0), np.array([0.0, 300.0]), OIL, SUMP).torque
    assert slow[0] == 0.0
    assert slow[1] == pytest.approx(
        4.12 * 850 * 3e-5**0.75 * 36.6e-3 * (300 * 36.6e-3) ** 1.25
        * (14e-3 * 4.5e-3) ** 0.25 * (0.03 / 850 * 1e6 / 40) ** 0.25 * (10.13 / (2.3 * 4.5)) ** 0.5,
        rel=1e-9,
    )  # fmt: skip


def test_a_stage_in_its_bath_by_hand():
    """Depths of 41.23 and 59.18 mm, b = 14 mm, l_h = 200 mm at 8.3 m/s; limits of depth and speed."""
    speed = 8.3 / 36.6e-3
    depths = 41.23 + 59.18
    constant = 0.063 * depths / 10 + 0.0128 * 1.4**3
    splash = (4 / 3) ** 1.5 * 2 * 59.18 / 200
    exact = splash * constant * math.exp((depths / 800 + 0.2) * 0.83)
    found = iso_14179_2(MESH, speed, OIL, SUMP)
    assert found.torque == pytest.approx(exact)
    assert ["10 to 60 m/s" in limit for limit in found.exceeded] == [True]
    assert iso_14179_2(MESH, 12.0 / 36.6e-3, OIL, SUMP).exceeded == ()
    deep = MESH._replace(driven=GEAR._replace(immersion=65e-3))
    assert len(iso_14179_2(deep, np.array([0.0, 2000.0]), OIL, SUMP).exceeded) == 2
    dry = MESH._replace(driver=PINION._replace(immersion=0.0), driven=GEAR._replace(immersion=0.0))
    assert iso_14179_2(dry, np.array([0.0, 200.0]), OIL, SUMP).torque == pytest.approx([0.0, 0.0])


def test_splash_of_the_stage_beside_that_of_its_gears():
    """FZG type C dipped to the axes at 8.3 m/s in VG 100 at 90 °C (9 mm²/s): both methods, order of power.

    Churning of either gear by Changenet & Velex holds for one alone; a stage has squeezing besides.
    """
    speed, oil = 8.3 / 36.6e-3, OilState(0.0075, 830.0)
    stage = iso_14179_2(MESH, speed, oil, SUMP).torque * speed
    single = CHURNING["changenet-velex"]
    alone = sum(
        single(wheel, at, oil, SUMP).torque * at for wheel, at in ((PINION, speed), (GEAR, speed * 2 / 3))
    )
    assert 0.1 < alone / stage < 10.0


def test_arrays_are_as_numbers_and_all_end_at_rest():
    speeds = np.array([0.0, 10.0, 200.0, 1500.0])
    oils = OilState(np.array([0.5, 0.1, 0.03, 0.006]), np.array([880.0, 870.0, 850.0, 800.0]))
    mesh = MESH._replace(flow=3e-5, jet_speed=10.0)
    in_oil = [
        *((formula, PINION) for formula in CHURNING.values()),
        *((formula, DRUM) for formula in CARRIERS.values()),
        *((formula, mesh) for formula in MESHES.values()),
    ]
    for formula, what in in_oil:
        found = formula(what, speeds, oils, SUMP).torque
        assert np.all(np.isfinite(found))
        for number in range(4):
            oil = OilState(oils.viscosity[number], oils.density[number])
            assert formula(what, speeds[number], oil, SUMP).torque == pytest.approx(found[number])
    for blown in WINDAGE.values():
        found = blown(PINION, speeds, OIL).torque
        assert found[0] == 0.0
        assert [blown(PINION, speed, OIL).torque for speed in speeds] == pytest.approx(list(found))
