"""What a measuring machine finds on a gear does in the mesh what geometry says it must.

The machine looks at the datum face, the gear's end at the most negative z, from outside: what is clockwise
for it is counter-clockwise seen from +z. So it finds teeth, flanks and directions wherever the gear turns to.
"""

from functools import lru_cache
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import tribodyn as td
from tests.support.own_teeth import errors
from tribodyn.exchange.measured_gear import (
    HELIX,
    LEFT,
    PROFILE,
    RIGHT,
    FlankTrace,
    MeasuredGear,
)
from tribodyn.geometry.assembly import assemble
from tribodyn.geometry.families import family
from tribodyn.mesh.teeth.fields import LEADING, TRAILING
from tribodyn.studies.measured_flanks import import_measured
from tribodyn.studies.motion.assembly import PreparedGearbox
from tribodyn.studies.motion.prepare import prepare

STIFF = {"mesh.compliance": "constant", "mesh.stiffness": "3e8 N/m", "solver.cycles": 1081}
BACK = {"mesh.backlash": "0.1 mm", "operating.gear_torque": "-500 N*m"}
TEETH = {"pinion": 23, "gear": 47}
AT = np.linspace(0.13, 47.0, 19)
EDGE = {"start": 1.0, "end": -1.0}  # counter-clockwise seen from +z is clockwise for who looks at this end


@lru_cache
def plain(back: bool = False) -> PreparedGearbox:
    return prepare(td.scenario("involute-23-47", STIFF | (BACK if back else {})))


@lru_cache
def rigid(back: bool, count: int) -> np.ndarray:
    return errors(plain(back).model, AT[:count])


def opened(
    measured: MeasuredGear,
    side: str,
    folder: Path,
    datum: str = "",
    back: bool = False,
    count: int = len(AT),
) -> Any:
    """By how much the measurement of a gear opens the mesh along the path's normal, m."""
    target = folder / "measured.toml"
    import_measured([(Path("measured"), measured)], "involute-23-47", side, datum, target, force=True)
    changes: dict[str, Any] = STIFF | (BACK if back else {})
    case = prepare(td.scenario(target, changes))
    cosine = np.cos(float(plain().assembly.path.pressure_angle(0.0)))
    return (errors(case.model, AT[:count]) - rigid(back, count)) * cosine


def direction(side: str, angle: float, at: np.ndarray) -> np.ndarray:
    """Where a mark on a gear stands after mesh cycles, an angle counter-clockwise from tooth 1; rad."""
    gear = ["pinion", "gear"].index(side)
    prepared = plain()
    sense = prepared.case.toothed_shafts[gear].sense
    return prepared.phases.teeth[gear] + angle + sense * 2.0 * np.pi * at / TEETH[side]


def shift(side: str, size: float, angle: float) -> np.ndarray:
    """By how much an axis that stands off opens the mesh: the shift along the normal to the mate, m."""
    prepared = plain()
    mesh = prepared.case.meshes[0]
    across = np.array([np.cos(mesh.azimuth), np.sin(mesh.azimuth)])
    along = prepared.case.toothed_shafts[0].sense * np.array([-across[1], across[0]])
    alpha = float(prepared.assembly.path.pressure_angle(0.0))
    normal = along * np.cos(alpha) + across * np.sin(alpha)
    turned = direction(side, angle, AT)
    moved = size * np.stack([np.cos(turned), np.sin(turned)], axis=-1) @ normal
    return -moved if side == "pinion" else moved


@pytest.mark.parametrize("datum", ["start", "end"])
@pytest.mark.parametrize("side", ["pinion", "gear"])
def test_runout_is_the_eccentricity_in_its_direction(side: str, datum: str, tmp_path: Path):
    """Readings of 2 e from gap to gap; the error is e along the normal, once per revolution."""
    size, angle, z = 15e-6, 0.7, TEETH[side]
    gaps = 2.0 * np.pi * (np.arange(z) + 0.5) / z
    measured = MeasuredGear(radial=size * np.cos(gaps - angle))
    found = opened(measured, side, tmp_path, datum)
    expected = shift(side, size, EDGE[datum] * angle)
    np.testing.assert_allclose(found, expected, rtol=0.0, atol=2e-3 * size)


@pytest.mark.parametrize("datum", ["start", "end"])
@pytest.mark.parametrize("side", ["pinion", "gear"])
def test_pitch_of_an_eccentric_gear_is_felt_as_its_eccentricity(side: str, datum: str, tmp_path: Path):
    """Teeth in their order and flanks on their side: else phase or sign of the error would be another.

    On the reference circle a flank of a gear moved by e in the direction φ stands forward along the normal by
    e cos(φ − ν), clockwise by as much over cos α; ν is the direction of the outward normal there. A tooth
    has its error while it is in contact, so that the mesh follows in steps of a pitch.
    """
    size, angle, z = 15e-6, 0.7, TEETH[side]
    alpha, teeth = np.radians(20.0), 2.0 * np.pi * np.arange(z) / z
    index = {}
    for flank, clockwise in ((RIGHT, 1.0), (LEFT, -1.0)):
        normal = teeth + clockwise * (np.pi / (2 * z) + np.pi / 2 - alpha)
        index[flank] = clockwise * size * np.cos(angle - normal) / np.cos(alpha)
    found = opened(MeasuredGear(pitch=index), side, tmp_path, datum)
    expected = shift(side, size, EDGE[datum] * angle)
    # over a pair's time of contact, 1.6 pitches, the direction turns by as much
    np.testing.assert_allclose(found, expected, rtol=0.0, atol=size * 2.0 * np.pi * 0.9 / z)


@pytest.mark.parametrize("side", ["pinion", "gear"])
def test_a_left_flank_carries_where_the_pinion_turns_clockwise(side: str, tmp_path: Path):
    """Seen from the datum face it turns counter-clockwise, and tooth tips at the top move to the left.

    A slope on left flanks alone is felt while the pinion drives, on right ones alone while the gear does.
    """
    place = np.linspace(0.0, 60e-3, 61)
    for flank, felt_back in ((LEFT, False), (RIGHT, True)):
        slope = FlankTrace(PROFILE, 5, flank, place, -1e-3 * place)  # less material towards the tip
        measured = MeasuredGear(traces=(slope,))
        for back in (False, True):
            found = opened(measured, side, tmp_path, back=back, count=6)
            assert (np.ptp(found) > 3e-6) == (back == felt_back)


@pytest.mark.parametrize("side", ["pinion", "gear"])
def test_missing_material_opens_the_mesh_by_the_profile_where_one_pair_carries(side: str, tmp_path: Path):
    """The error of a slope over the length of roll is that slope times the length from the pitch point.

    Zero is on the reference circle, which is the pitch circle here.
    """
    place = np.linspace(0.0, 60e-3, 61)
    measured = MeasuredGear(traces=(FlankTrace(PROFILE, 5, LEFT, place, -4e-4 * place),))
    found = opened(measured, side, tmp_path)
    prepared = plain()
    begin, end = (float(limit) for limit in prepared.assembly.roll_limits)
    pitch = float(prepared.assembly.pitch_angle)
    roll = begin + pitch * np.mod(AT, 1.0)
    one = roll + pitch > end  # no second pair
    base = float(prepared.assembly.path.pinion_pitch_radius) * np.cos(np.radians(20.0))
    distance = roll[one] * base * (1.0 if side == "pinion" else -1.0)
    assert np.sum(one) > 5
    np.testing.assert_allclose(found[one], 4e-4 * distance, rtol=0.0, atol=2e-8)


def test_a_helix_leans_to_its_end_of_the_face(tmp_path: Path):
    """A flank with material missing away from the datum face; the same from the other end the other way."""
    width = 20e-3
    place = np.linspace(0.0, width, 9)
    trace = FlankTrace(HELIX, 1, LEFT, place, -1e-3 * place)
    for datum, sign in (("start", 1.0), ("end", -1.0)):
        side = LEFT if datum == "start" else RIGHT
        measured = MeasuredGear(traces=(trace._replace(flank=side),))
        target = tmp_path / "measured.toml"
        import_measured([(Path("m"), measured)], "involute-23-47", "pinion", datum, target, force=True)
        table = td.scenario(target).pair.teeth[0][0]
        assert np.all(sign * np.diff(table.errors, axis=2) > 0.0)


def test_a_run_with_a_measured_pinion_has_its_runout_once_per_revolution(tmp_path: Path):
    """F_r = 2 e: in slow rotation the transmission error has e/cos α_w at the order of the shaft."""
    size, z = 10e-6, TEETH["pinion"]
    radial = size * np.cos(2.0 * np.pi * (np.arange(z) + 0.5) / z)
    target = tmp_path / "measured.toml"
    measured = [(Path("m"), MeasuredGear(radial=radial))]
    done = import_measured(measured, "involute-23-47", "pinion", output=target)
    (runout,) = done.evaluation.deviations
    assert runout.value == pytest.approx(2.0 * size, rel=0.01)  # of an odd number of readings
    changes = {key: value for key, value in STIFF.items() if not key.startswith("solver")}
    changes |= {"operating.pinion_speed": "20 rpm", "solver.revolutions": 1, "output.samples_per_cycle": 10}
    run = td.run(target, changes | {"friction.law": "none"}, output=tmp_path / "run.h5")
    error = np.asarray(run.data["transmission_error_rotational"])[: 10 * z]
    amplitude = 2.0 * abs(np.fft.rfft(error)[1]) / len(error)
    assert amplitude * np.cos(np.radians(20.0)) == pytest.approx(size, rel=5e-3)


def test_of_an_idler_either_flank_is_where_it_is_touched(tmp_path: Path):
    """Right flanks against left ones: each in the mesh in which it carries."""
    place = np.linspace(0.0, 80e-3, 81)
    left = FlankTrace(PROFILE, 1, LEFT, place, -1e-4 * place)
    measured = MeasuredGear(traces=(left, left._replace(flank=RIGHT, deviation=2e-4 * place)))
    target = tmp_path / "train.toml"
    import_measured([(Path("m"), measured)], "planetary-24-84", "planet", output=target)
    case = td.scenario(target, {"solver.cycles": 100})
    sun, ring = (
        next(m for m in case.meshes if name in {case.gears[gear].name for gear in m.gears})
        for name in ("sun", "ring")
    )
    for mesh, planet, flank in ((sun, 1, TRAILING), (ring, 0, LEADING)):
        (own,) = (each for each in mesh.pair.teeth[planet] if flank in each.flanks)
        # which of them is the left one the sense of the planet against its carrier says
        clockwise = case.toothed_shafts[mesh.gears[planet]].sense > 0
        slope = -2e-4 if clockwise == (flank == LEADING) else 1e-4
        limits = [float(limit) for limit in mesh_path(mesh)]
        assert np.ptp(own.errors[0]) == pytest.approx(abs(slope) * (limits[1] - limits[0]), rel=1e-9)
        assert np.sign(own.errors[0, -1, 0] - own.errors[0, 0, 0]) == np.sign(slope)


def mesh_path(mesh: Any) -> tuple[Any, Any]:
    """Where the path of contact of a mesh begins and ends, m."""
    return assemble(family(mesh.pair.family), mesh.pair.drive).limits
