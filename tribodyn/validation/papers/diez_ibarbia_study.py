"""Values behind the figures of Diez-Ibarbia et al.: a shifted pair by equal loads and by load contact.

The latter is the proposed approach of section 2.2: load sharing with constant friction coefficient in slow
rotation, corner contact included.

Every pair of the study is the paper's 18/36 with a shift x1 = −x2 in one of three ways of choosing the tips
(`shifted`), at one of five operating conditions, with Niemann's mean coefficient of friction.
"""

import math
from functools import cache
from typing import Literal, NamedTuple

import numpy as np

from tribodyn.compliance.sharing.load_sharing import (
    LEVEL,
    LoadedFlanks,
    effective_contact_ratio,
    extended_rolls,
    flexibility,
)
from tribodyn.compliance.sharing.loaded_contact import check_contact, reach
from tribodyn.compliance.sharing.slices import PairFlexibility
from tribodyn.gears.case import LubricatedCase
from tribodyn.geometry.assembly import assemble
from tribodyn.geometry.corner_contact import pair_geometry
from tribodyn.geometry.drive import Drive, tip_radius
from tribodyn.geometry.families.involute import FAMILY
from tribodyn.geometry.modification import UNMODIFIED, Modifications, back_flanks, uneven_teeth
from tribodyn.geometry.path import kinematics
from tribodyn.mesh.quasi_static import efficiency
from tribodyn.numerics.elementary import cos, sin, sqrt
from tribodyn.numerics.shapes import Array, Float
from tribodyn.standards.loss_factors import equal_loads, hoehn
from tribodyn.studies.efficiency.published import tip_contact_ratios
from tribodyn.studies.protocol.load import load_scenario
from tribodyn.tribology.closure import nominal_conditions
from tribodyn.tribology.friction.niemann import niemann

#: Positions over one pitch: the efficiency is then known to 1e-6 (test_load_contact_efficiency).
POSITIONS = 240
# Corners are followed to this many deflections of a single pair; two is enough for any load sharing.
_REACH = 2.5


class LoadContact(NamedTuple):
    """One mesh cycle of a pair in slow rotation."""

    efficiency: float  # as `mesh.power_flow` defines it
    #: effective contact ratio: pinion angle over which a pair carries load, over the pitch
    contact_ratio: float
    #: roll, normal_load: (position, pair), pinion angle of each pair from the pitch point, rad, and its load,
    #: N
    roll: Float[Array, "position pair"]
    normal_load: Float[Array, "position pair"]
    loss: Float[Array, "position pair"]  # (position, pair), friction work per pinion angle, N m/rad


def load_contact(
    flexible: PairFlexibility,
    gear_torque: float,
    friction_coefficient: float,
    positions: int = POSITIONS,
    modifications: Modifications = UNMODIFIED,
    slices: int = 1,
    coupled: bool = True,
) -> LoadContact:
    """Run a pair through one mesh cycle of equal steps under a constant torque and friction coefficient.

    The torque T_g (N m) is negative where the gear drives, on back flanks; modifications, slices and coupling
    as for `loaded_contact.roll_through`, without pitch errors. Raises InputError if the torque drives
    nothing, or as `roll_through` does.
    """
    for broken in uneven_teeth(modifications):
        raise broken
    assembly = flexible.assembly
    torque, way = abs(gear_torque), math.copysign(1.0, gear_torque)
    if way < 0.0:
        modifications = back_flanks(modifications, float(assembly.path.pressure_angle(0.0)))
    flanks = LoadedFlanks(flexible, modifications, slices, coupled)
    check_contact(flanks, torque)
    ratio = assembly.path.pinion_pitch_radius / assembly.path.gear_pitch_radius
    limits = reach(flanks, torque, _REACH)
    roll = extended_rolls(assembly, limits, positions)
    shared = flanks.share(roll, torque, way * friction_coefficient)
    sliding = np.abs(pair_geometry(assembly, roll).motion.sliding)
    loss = friction_coefficient * shared.normal_load * sliding
    gear, lost = gear_torque * ratio, float(np.mean(np.sum(loss, axis=1)))
    return LoadContact(
        efficiency=float(efficiency(gear + lost, gear, lost)),
        contact_ratio=effective_contact_ratio(roll, shared, 2.0 * np.pi / assembly.drive.pinion.teeth),
        roll=roll,
        normal_load=shared.normal_load,
        loss=loss,
    )


Scenario = Literal["S1", "S2", "S3"]
#: Shifts x1 at which it is checked whether the efficiency falls.
SHIFTS: dict[Scenario, tuple[float, ...]] = {
    "S1": (0.0, 0.1, 0.2),
    "S2": (0.0, 0.1, 0.3, 0.5, 0.7),
    "S3": (0.0, 0.1, 0.3, 0.5, 0.7),
}

#: Operating conditions: power W, speed rpm.
CONDITIONS = {
    "OC1": (25e3, 1500.0),
    "OC2": (25e3, 6000.0),
    "OC3": (50e3, 3000.0),
    "OC4": (100e3, 1500.0),
    "OC5": (100e3, 6000.0),
}
# Mesh of the shifted pairs: efficiencies within 1e-5 of those of the finer one used without shift.
_LEVEL_OF_SHIFTED = 1
#: Points over the path of contact of the curves by equal loads.
_POINTS = 801


class Course(NamedTuple):
    """One pair of teeth from first to last contact; arrays (point,), increasing roll."""

    roll: Float[Array, " point"]  # pinion angle from the pitch point, rad
    share: Float[Array, " point"]  # LSR = F_N/F_Nmax, F_Nmax = T_G/ρ_oG
    sliding: Float[Array, " point"]  # |V_s|/V, V the pitch line velocity
    loss: Float[Array, " point"]  # H_vinst = μ F_N |V_s|/(F_Nmax V), the paper's (4)


def shifted(drive: Drive, scenario: Scenario, shift: float) -> Drive:
    """Shift the pinion of an involute pair without shift by x1 = `shift` and the gear by −x1.

    Section 3 of the paper. S1 keeps the tip radii; S2 the contact ratio, with R_1 = m (z1/2 + x1 + h_a*),
    ε2 = ε_α − ε1 and R_2 from ε2 (Diez-Ibarbia (16)-(19)); S3 has R_i = m (z_i/2 + x_i + h_a*).
    """
    pinion = drive.pinion._replace(profile_shift=shift, tip_radius=None)
    gear = drive.gear._replace(profile_shift=-shift, tip_radius=None)
    both = drive._replace(pinion=pinion, gear=gear)
    if scenario == "S3":
        return both
    if scenario == "S1":
        radii = tip_radius(drive, "pinion"), tip_radius(drive, "gear")
        return both._replace(
            pinion=pinion._replace(tip_radius=radii[0]), gear=gear._replace(tip_radius=radii[1])
        )
    kept = sum(tip_contact_ratios(FAMILY, drive)) - tip_contact_ratios(FAMILY, both)[0]
    path = FAMILY.working_path(both)
    angle = path.pressure_angle(0.0)
    radius = path.gear_pitch_radius
    base_pitch = 2.0 * math.pi * path.pinion_pitch_radius * cos(angle) / pinion.teeth
    outer = sqrt((radius * sin(angle) + kept * base_pitch) ** 2 + (radius * cos(angle)) ** 2)
    return both._replace(gear=gear._replace(tip_radius=outer))


@cache
def mean_friction(condition: str, on_gear: bool = False) -> float:
    """Niemann's mean friction coefficient of the paper's pair at an operating condition."""
    _, rpm = CONDITIONS[condition]
    overrides = {
        "operating.pinion_speed": f"{rpm * math.pi / 30.0!r} rad/s",
        "operating.gear_torque": f"{gear_torque(condition, on_gear)!r} N*m",
    }
    return float(niemann(nominal_conditions(_case(overrides))))


def gear_torque(condition: str, on_gear: bool = False) -> float:
    """Torque on the gear at an operating condition, N m.

    Table 1's torques belong to its powers and speeds, and are taken as the pinion's; its terms say "on the
    gear", which `on_gear` takes them for.
    """
    power, rpm = CONDITIONS[condition]
    return (1.0 if on_gear else 2.0) * power / (rpm * math.pi / 30.0)


def drive() -> Drive:
    """Return the paper's pair without shift."""
    return _plain_case().drive


def elastic(pair: Drive, level: int = LEVEL) -> PairFlexibility:
    """Finite elements of the paper's pair, shifted or not, of its material."""
    return flexibility(assemble(FAMILY, pair), _plain_case().materials, level=level, held=True)


def loss_factors(pair: Drive) -> tuple[float, float]:
    """H_v by Höhn's formula and by the integral behind it."""
    tips = tip_contact_ratios(FAMILY, pair)
    teeth, ratio = pair.pinion.teeth, pair.gear.teeth / pair.pinion.teeth
    return hoehn(*tips, teeth, ratio), equal_loads(*tips, teeth, ratio)


def peak(scenario: Scenario) -> tuple[float, float]:
    """Shift at which Höhn's efficiency is largest, and the shift beyond which it is below that without."""
    from scipy.optimize import brentq, minimize_scalar

    base = drive()

    def factor(shift: float) -> float:
        return loss_factors(shifted(base, scenario, shift))[0]

    best = float(minimize_scalar(factor, bounds=(0.0, 0.4), method="bounded").x)  # pyright: ignore
    start = factor(0.0)
    back = brentq(lambda shift: factor(shift) - start, best, 0.6)
    return best, float(back)  # pyright: ignore[reportArgumentType]


def equal_load_efficiencies(scenario: Scenario, shift: float, condition: str) -> tuple[float, float]:
    """Efficiency of a shifted pair by Höhn's formula, and by the integral behind it."""
    mu = mean_friction(condition)
    formula, integral = loss_factors(pair_of(scenario, shift))
    return 1.0 - mu * formula, 1.0 - mu * integral


@cache
def at_load(scenario: Scenario, shift: float, condition: str) -> LoadContact:
    """Mesh cycle of a shifted pair at an operating condition by the load contact model."""
    return load_contact(_flexible(scenario, shift), gear_torque(condition), mean_friction(condition))


@cache
def pair_of(scenario: Scenario, shift: float) -> Drive:
    """Return the paper's pair shifted; without shift every scenario is the same pair."""
    return shifted(drive(), scenario, shift)


def theoretical_contact_ratio(scenario: Scenario, shift: float) -> float:
    """Contact ratio of the path of a shifted pair."""
    return sum(tip_contact_ratios(FAMILY, pair_of(scenario, shift)))


def course_at_load(scenario: Scenario, shift: float, condition: str) -> Course:
    """Load sharing and losses of one pair by the load contact model, from its first to its last load."""
    cycle = at_load(scenario, shift, condition)
    path = _flexible(scenario, shift).assembly.path
    force = gear_torque(condition) / (path.gear_pitch_radius * math.cos(float(path.pressure_angle(0.0))))
    order = np.argsort(cycle.roll, axis=None)
    roll, load, loss = (values.ravel()[order] for values in (cycle.roll, cycle.normal_load, cycle.loss))
    loaded = np.flatnonzero(load > 0.0)
    part = slice(max(loaded[0] - 1, 0), loaded[-1] + 2)
    share = load[part] / force
    power = loss[part] / (force * path.pinion_pitch_radius)
    mu = mean_friction(condition)
    sliding = np.divide(power, mu * share, out=np.full_like(share, np.nan), where=share > 0.0)
    return Course(roll[part], share, sliding, power)


def course_by_equal_loads(scenario: Scenario, shift: float, condition: str) -> Course:
    """Return the same by equal loads on all pairs in contact, as Höhn's formula has it."""
    path = FAMILY.working_path(pair_of(scenario, shift))
    after, before = tip_contact_ratios(FAMILY, pair_of(scenario, shift))
    ends = -before, after
    # in pitches from the pitch point, with a point on either side of every jump
    jumps = [end + step for end in ends for step in (-2, -1, 1, 2) if -before < end + step < after]
    near_jumps = [jump + side for jump in jumps for side in (-1e-9, 1e-9)]
    at = np.sort(np.concatenate([np.linspace(*ends, _POINTS), near_jumps]))
    pairs = np.floor(after - at) + np.floor(at + before) + 1.0
    pitch = 2.0 * math.pi / drive().pinion.teeth
    share = 1.0 / pairs
    sliding = np.abs(kinematics(path, path.signed_distance(pitch * at)).sliding) / path.pinion_pitch_radius
    return Course(pitch * at, share, sliding, mean_friction(condition) * share * sliding)


@cache
def _flexible(scenario: Scenario, shift: float) -> PairFlexibility:
    return elastic(pair_of(scenario, shift), _LEVEL_OF_SHIFTED)


@cache
def _plain_case() -> LubricatedCase:
    return _case({})


def _case(overrides: dict[str, str]) -> LubricatedCase:
    return load_scenario("involute-18-36", overrides).pair
