"""Speeds, torques, phases and assembly of planetary sets, each by a second way."""

from fractions import Fraction
from itertools import permutations

import numpy as np
import pytest

from tests.support.planetary_phases import mesh_phases
from tests.support.single_set import excited, mesh_frequency, speeds, torques, willis
from tribodyn.errors import InputError
from tribodyn.train.phases import Engagement, ToothedShaft, nominal_phases
from tribodyn.train.planetary import (
    CARRIER,
    MEMBERS,
    RING,
    SUN,
    SetTeeth,
    check_assembly,
    nearest_teeth,
)

TEETH = SetTeeth(18, 36, -90)
ARRANGEMENTS = list(permutations(MEMBERS, 2))
#: Driven over driving speed by held and driving member, with i = ring over sun = 5; textbook forms.
I = Fraction(5)  # noqa: E741
RATIOS = {
    (RING, SUN): 1 / (1 + I),
    (RING, CARRIER): 1 + I,
    (SUN, RING): I / (1 + I),
    (SUN, CARRIER): (1 + I) / I,
    (CARRIER, SUN): -1 / I,
    (CARRIER, RING): -I,
}


@pytest.mark.parametrize(("held", "driving"), ARRANGEMENTS)
def test_ratios_of_the_six_arrangements(held, driving):
    found = speeds(TEETH, held, driving)
    (driven,) = set(MEMBERS) - {held, driving}
    assert found[driven] == RATIOS[held, driving]
    # pitch points: sun and planet, planet and ring move alike there; radii as teeth
    sun, planet, ring = TEETH.sun, TEETH.planet, -TEETH.ring
    centre = (sun + planet) * found[CARRIER]
    assert sun * found[SUN] == centre - planet * found["planet"]
    assert ring * found[RING] == centre + planet * found["planet"]


@pytest.mark.parametrize("efficiency", [1.0, 0.97])
@pytest.mark.parametrize(("held", "driving"), ARRANGEMENTS)
def test_powers_of_the_six_arrangements(held, driving, efficiency):
    """Torques balance; what is lost is what rolls through the meshes, and nothing without friction."""
    turning, found = speeds(TEETH, held, driving), torques(TEETH, held, driving, 7.0, efficiency)
    assert found[driving] == pytest.approx(7.0, rel=1e-14)
    assert sum(found.values()) == pytest.approx(0.0, abs=1e-12)
    power = sum(found[member] * float(turning[member]) for member in MEMBERS)
    rolling = [found[member] * float(turning[member] - turning[CARRIER]) for member in (SUN, RING)]
    assert power == pytest.approx(sum(rolling), abs=1e-12)
    assert power == pytest.approx((1.0 - efficiency) * max(rolling), abs=1e-12)


def test_efficiency_of_a_set_with_its_ring_held():
    """(1 − i η)/(1 − i), i = z_r/z_s of the carrier held, and backwards (1 − i)/(1 − i/η)."""
    efficiency, ratio = 0.97, TEETH.ring / TEETH.sun
    for driving, expected in (
        (SUN, (1.0 - ratio * efficiency) / (1.0 - ratio)),
        (CARRIER, (1.0 - ratio) / (1.0 - ratio / efficiency)),
    ):
        turning, found = speeds(TEETH, RING, driving), torques(TEETH, RING, driving, 1.0, efficiency)
        driven = CARRIER if driving == SUN else SUN
        assert -found[driven] * float(turning[driven]) == pytest.approx(expected, rel=1e-14)


def test_all_meshes_have_one_frequency():
    turning = {name: 30.0 * float(speed) for name, speed in speeds(TEETH, RING, SUN).items()}
    expected = mesh_frequency(TEETH, turning)
    for teeth, name in ((TEETH.planet, "planet"), (-TEETH.ring, RING)):
        rolling = teeth * abs(turning[name] - turning[CARRIER]) / (2.0 * np.pi)
        assert rolling == pytest.approx(expected, rel=1e-14)
    assert sum(willis(TEETH).values()) == 0


@pytest.mark.parametrize("teeth", [SetTeeth(18, 36, -93), SetTeeth(23, 35, -94), SetTeeth(24, 31, -87)])
@pytest.mark.parametrize("planets", [3, 4])
def test_phases_are_those_of_turned_teeth(teeth, planets):
    """Of planets wherever they fit: teeth put together mesh by mesh, the ring's by the planets' teeth."""
    whole = teeth.sun - teeth.ring
    angles = 0.4 + 2.0 * np.pi * np.round(np.arange(planets) * whole / planets) / whole
    half = (0.047, 0.043)
    gears = [ToothedShaft("sun", 0, teeth.sun, 1)]
    meshes = []
    for i, angle in enumerate(angles):
        gears += [
            ToothedShaft("planet", 1 + 2 * i, teeth.planet, -1),
            ToothedShaft("where the ring is", 2 + 2 * i, 50, 1),
        ]
        meshes.append(Engagement("mesh", (0, 1 + 2 * i), angle, (0.05, half[0]), 0.0))
        meshes.append(Engagement("mesh", (1 + 2 * i, 2 + 2 * i), angle, (half[1], 0.03), 0.0))
    expected = np.array(nominal_phases(gears, meshes).meshes).reshape(-1, 2).T
    found = np.array(mesh_phases(teeth, angles.tolist(), half))
    np.testing.assert_allclose((found - expected + 0.5) % 1.0, 0.5, atol=1e-11)
    # tables from the points of entry
    entries = (-0.7, -0.9)
    later = np.array(mesh_phases(teeth, angles.tolist(), half, entries))[1]
    np.testing.assert_allclose((later - found[1] - 0.2 + 0.5) % 1.0, 0.5, atol=1e-11)


@pytest.mark.parametrize("sense", [1, -1])
@pytest.mark.parametrize("planets", [3, 4, 5])
def test_what_a_harmonic_excites_is_what_forces_add_up_to(planets, sense):
    """Harmonic forces at the phases of equally spaced planets, added up on the sun."""
    for sun in range(15, 15 + planets):
        teeth = SetTeeth(sun, 20, -(40 + (-sun - 40) % planets))
        angles = 2.0 * np.pi * np.arange(planets) / planets
        check_assembly(teeth, angles.tolist(), "planets")
        of_sun, of_ring = mesh_phases(teeth, angles.tolist(), (0.05, 0.05), sense=sense)
        for harmonic in (1, 2, 3, 4):
            for phases in (of_sun, of_ring):
                force = np.exp(2j * np.pi * harmonic * phases)
                torque = abs(np.sum(force)) > 1e-9 * planets
                push = max(abs(np.sum(force * np.exp(way * 1j * angles))) for way in (1, -1)) > 1e-9
                kinds = excited(teeth, planets, harmonic)
                assert kinds == (("rotational",) if torque else ("translational",) if push else ("planet",))


def test_planets_that_do_not_fit():
    angles = (2.0 * np.pi * np.arange(3) / 3).tolist()
    check_assembly(SetTeeth(18, 36, -93), angles, "stage.0.planets")
    with pytest.raises(InputError) as caught:
        check_assembly(SetTeeth(19, 36, -93), angles, "stage.0.planets")
    message = str(caught.value)
    assert message.startswith("stage.0.planets")
    assert "planet 2 stands 0.333 pitches" in message
    assert "18 and 93 or 19 and 92" in message
    assert nearest_teeth(SetTeeth(19, 36, -93), angles) == [(18, -93), (19, -92)]
    # the angle that is named fits
    check_assembly(SetTeeth(19, 36, -93), [0.0, 2.0 * np.pi * round(112 / 3) / 112], "stage.0.planets")
    assert f"{np.degrees(2.0 * np.pi * round(112 / 3) / 112):.6g} deg" in message


def test_angles_that_no_numbers_of_teeth_near_by_fit():
    assert nearest_teeth(SetTeeth(19, 36, -93), [0.0, 2.0 * np.pi * 0.3334567], most=1) == []
