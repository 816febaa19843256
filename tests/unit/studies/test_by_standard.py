"""K_v and contact temperature of runs: the standard's formulas written out, sums of temperatures."""

import math

import pytest

from tests.support.short_studies import short_case
from tribodyn.gears.by_standard import quality_of, rated
from tribodyn.geometry.assembly import assemble
from tribodyn.geometry.drive import Drive, GearBody, MaterialData
from tribodyn.geometry.families import involute
from tribodyn.standards.flank_tolerances import flank_tolerances

STEEL = MaterialData("steel", 206e9, 0.3, 7830.0, 46.0, 470.0, 6e9)


def test_a_drive_is_rated_as_the_formulas_say():
    # z 25/60, m 3 mm, b 40 mm, discs of steel; subcritical: K_v = 1 + N (0.32 B_p + 0.34 B_f + 0.23 B_k)
    bodies = [GearBody(z, 0.0, 1.0, 1.25, 0.25, 0.04, 0.01) for z in (25.0, 60.0)]
    assembly = assemble(involute.FAMILY, Drive(3e-3, math.radians(20.0), *bodies))
    tolerances = [flank_tolerances(6, 3e-3, d, 0.04) for d in (75e-3, 180e-3)]
    quality = quality_of([6, 6], tolerances)
    assert quality is not None
    inertias = ((1.0, 1e-3), (5.0, 3e-2))
    found = rated(assembly, (STEEL, STEEL), inertias, quality, (188.5, 240.0))
    base = [d / 2.0 * math.cos(math.radians(20.0)) for d in (75e-3, 180e-3)]
    mass = 1e-3 * 3e-2 / (1e-3 * base[1] ** 2 + 3e-2 * base[0] ** 2) / 0.04
    ratio = 188.5 * 25.0 / math.sqrt(found.stiffness.mesh / mass)
    line_load = 240.0 / 90e-3 / 0.04
    pitch = tolerances[1].single_pitch * math.cos(math.radians(20.0))
    assert found.line_load == pytest.approx(line_load)
    shares = [
        0.925 * f * found.stiffness.single_pair / line_load for f in (pitch, tolerances[1].profile_form)
    ]
    factor = 1.0 + ratio * (0.32 * shares[0] + 0.34 * shares[1] + 0.23)
    # ISO 6336-1 begins the main resonance at 0.85, or earlier below 100 N/mm
    assert ratio < 0.5
    assert found.dynamic.range == "subcritical"
    assert found.dynamic.resonance_ratio == pytest.approx(ratio)
    assert found.dynamic.factor == pytest.approx(factor)


def test_both_gears_have_a_quality_or_the_drive_has_none(tmp_path):
    fine, coarse = (flank_tolerances(grade, 3e-3, 75e-3, 0.04) for grade in (5, 8))
    assert quality_of([5, None], [fine, None]) is None
    both = quality_of([5, 8], [fine, coarse])
    assert both == (8.0, coarse.single_pitch, coarse.profile_form, 2013)
    assert short_case("gear-pair", tmp_path).pair.quality is None
    assert short_case("gear-pair", tmp_path, drive__quality=6).pair.quality.grade == 6.0
