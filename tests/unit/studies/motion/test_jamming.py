"""When a train says that it jams: against the room that linear programming leaves its planets."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.optimize import brentq, linprog

from tests.support.planet_sets import planet_set, set_case
from tests.support.train_scenarios import case_of_table
from tribodyn.geometry.assembly import Assembly
from tribodyn.geometry.backlash import normal_backlash
from tribodyn.studies.motion.assembly import PreparedGearbox
from tribodyn.studies.motion.check import check
from tribodyn.studies.motion.planetary.jamming import jams
from tribodyn.studies.motion.prepare import prepare


def thinner(allowance: float = -20.0, **changes) -> PreparedGearbox:
    """A set whose teeth are thinner, um."""
    table = planet_set(**changes)
    for gear in table["gear"].values():
        gear["thickness_allowance"] = f"{allowance} um"
    return prepare(case_of_table(table))


def fits(prepared: PreparedGearbox, errors: np.ndarray) -> bool:
    """Whether a sun, a ring and planets that only turn have a place with all flanks apart or just touching.

    Unknown are rotations along the line of action: sun, ring, planets.
    """
    case, planets = prepared.case, len(errors)
    (of_sun, of_ring) = (case.meshes[m].pair.mesh.backlash for m in (0, planets))
    cosine = np.cos(float(prepared.tables[0].assembly.path.pressure_angle(0.0)))
    rows, bounds = [], []
    for k, error in enumerate(cosine * errors):
        for wheel, sign, backlash in ((0, 1.0, of_sun), (1, -1.0, of_ring)):
            row = np.zeros(2 + planets)
            row[wheel], row[2 + k] = 1.0, sign
            rows += [row, -row]
            bounds += [error + backlash, -error]
    return linprog(np.zeros(2 + planets), rows, np.array(bounds) * 1e6, bounds=(None, None)).status == 0


def test_a_set_without_allowances_says_that_it_jams():
    case = set_case()
    assert [mesh.pair.mesh.backlash for mesh in case.meshes][-1] == 0.0
    (said,) = jams(prepare(case))
    assert said.startswith("no backlash where meshes close a loop, set-ring-1 (and 2, 3): both flanks")
    assert 'gear.ring.thickness_allowance = "-40 um"' in said
    assert said in check(case).warnings
    assert jams(thinner()) == []


def test_one_planet_closes_no_loop():
    assert jams(prepare(set_case(planets=1))) == []


def test_tangential_errors_against_the_room_that_is_left():
    prepared, rng, seen = thinner(), np.random.default_rng(3), []
    for scale in np.linspace(5e-6, 60e-6, 12):
        errors = rng.uniform(-scale, scale, 3)
        own = prepared.case.sets[0]
        offsets = {
            planet: (-error * np.sin(angle), error * np.cos(angle))
            for planet, angle, error in zip(own.planets, own.angles, errors, strict=True)
        }
        links = tuple(
            replace(link, offset=offsets[link.ends[0]]) if link.lever else link
            for link in prepared.case.links
        )
        said = jams(replace(prepared, case=replace(prepared.case, links=links)))
        seen.append(fits(prepared, errors))
        assert seen[-1] == (not said)
    assert len(set(seen)) == 2


@pytest.mark.parametrize(("member", "sign"), [("sun", -1.0), ("ring", 1.0)])
def test_radial_errors_against_the_backlash_at_another_distance(member: str, sign: float):
    m = 0 if member == "sun" else 3
    assembly = thinner().tables[m].assembly
    distance = float(assembly.path.pinion_pitch_radius + assembly.path.gear_pitch_radius)

    def left(error: float) -> float:
        nearer = assembly.drive._replace(centre_distance=distance + sign * error * np.sign(distance))
        return float(normal_backlash(Assembly(assembly.family, nearer)))

    eaten = brentq(left, 20e-6, 180e-6)
    for share, jammed in ((0.97, False), (1.03, True)):
        said = jams(thinner(radial_pin_errors=[f"{sign * share * eaten} m", "0 m", "0 m"]))
        assert bool(said) == jammed
        assert not said or f"of the mesh set-{member}-1 is" in said[0]
