"""Energy method: closed forms of the beam and of the contact, similarity, symmetry."""

import math
from dataclasses import replace

import numpy as np
import pytest

from tribodyn.compliance.energy import (
    _POINTS,
    beam_compliance,
    hertz_coefficient,
    hertz_linear,
    loaded_tooth,
    neighbour_coupling,
    polynomials_over_ring,
    section_integrals,
    tooth_compliance,
)
from tribodyn.compliance.foundation import ring_compliance, sainsot_velex
from tribodyn.geometry.assembly import assemble
from tribodyn.geometry.body import tooth_outline
from tribodyn.geometry.drive import SIDES, Drive, GearBody, MaterialData
from tribodyn.geometry.families import crc, involute
from tribodyn.geometry.path import distance_at_radius, kinematics
from tribodyn.geometry.tooth import contact_in_tooth_frame

STEEL = MaterialData("steel", 207e9, 0.3, 7850.0, 46.0, 470.0, 6e9)


def body(teeth, bore, width=0.0267):
    return GearBody(float(teeth), 0.0, 1.0, 1.25, 0.25, width, bore)


def drive(pressure_angle=20.0, pinion=None, gear=None):
    pinion, gear = pinion or body(18, 0.012), gear or body(36, 0.025)
    return Drive(0.003, math.radians(pressure_angle), pinion, gear)


def loaded(family, pair, side):
    return loaded_tooth(assemble(family, pair), side)


def pair_compliance(family, pair, material, r, width=0.0267):
    parts = [tooth_compliance(loaded(family, pair, s), material, width, np.asarray(r)) for s in SIDES]
    return parts[0].total + parts[1].total + hertz_linear(material, material, width)


class TestBeam:
    def test_prism_is_the_timoshenko_cantilever(self):
        length, half, lever, angle, nu = 5e-3, 2e-3, 4e-3, 0.3, 0.3
        x = 0.02 + length * (1 + _POINTS) / 2
        totals = section_integrals(x, np.full_like(x, half), 0.02).sum(axis=0)
        bending, shear, axial = beam_compliance(totals, lever, angle, nu)
        inertia, area = (2 * half) ** 3 / 12, 2 * half
        moment_squared = (lever**3 - (lever - length) ** 3) / 3  # ∫ (u − s)² ds
        assert bending == pytest.approx(math.cos(angle) ** 2 * moment_squared / inertia, rel=1e-12)
        assert shear == pytest.approx(1.2 * 2 * (1 + nu) * math.cos(angle) ** 2 * length / area, rel=1e-12)
        assert axial == pytest.approx(math.sin(angle) ** 2 * length / area, rel=1e-12)

    @pytest.mark.parametrize("tip", [0.3, 0.1])
    def test_wedge_up_to_a_thin_tip(self, tip):
        # y falls linearly from 1 to `tip`; ∫ dx/y³ = (1/tip² − 1)/(2 slope)
        x = (1 + _POINTS) / 2
        slope = 1 - tip
        totals = section_integrals(x, 1 - slope * x, 0.0).sum(axis=0)
        assert totals[0] == pytest.approx(1.5 * (1 / tip**2 - 1) / (2 * slope), rel=1e-7)
        assert totals[3] == pytest.approx(-0.5 * math.log(tip) / slope, rel=1e-9)

    @pytest.mark.parametrize("name", ["involute", "crc", "far from the pitch point"])
    def test_outline_integrated_point_by_point(self, name):
        pair = drive(22.81, body(23, 0.015), body(47, 0.025))
        r = np.array([-3e-3, 0.0, 4e-3])
        if name.startswith("far"):  # by a large profile shift all of the flank is on one side
            pinion = body(60, 0.06)._replace(profile_shift=1.3, addendum=0.8)
            gear = body(70, 0.06)._replace(profile_shift=-1.3, addendum=2.2)
            pair = drive(20.0, pinion, gear)
        tooth = loaded(crc.FAMILY if name == "crc" else involute.FAMILY, pair, "pinion")
        if name.startswith("far"):
            radii = np.array([tooth.tooth.form_radius, tooth.tooth.tip_radius])
            first, last = np.asarray(distance_at_radius(tooth.path, radii))
            assert first > 0.0
            r = first + np.array([0.4, 0.9]) * (last - first)
        result = tooth_compliance(tooth, STEEL, 0.02, r)
        outline = tooth_outline(tooth.tooth, 4000, 4000)
        x, y = np.r_[outline.fillet_x, outline.flank_x[1:]], np.r_[outline.fillet_y, outline.flank_y[1:]]
        contact = contact_in_tooth_frame(tooth.path, tooth.pitch_half_angle, r)
        for i in range(len(r)):
            below = x < contact.x[i]
            s, half = np.r_[x[below], contact.x[i]], np.r_[y[below], contact.y[i]]
            angle = contact.load_angle[i]
            moment = math.cos(angle) * (contact.x[i] - s) - math.sin(angle) * contact.y[i]
            bending = np.trapezoid(moment**2 / (2 * half**3 / 3), s) / (207e9 * 0.02)
            shear = np.trapezoid(1.2 * math.cos(angle) ** 2 / (2 * half), s) * 2.6 / (207e9 * 0.02)
            axial = np.trapezoid(math.sin(angle) ** 2 / (2 * half), s) / (207e9 * 0.02)
            assert result.bending[i] == pytest.approx(bending, rel=1e-6)
            assert result.shear[i] == pytest.approx(shear, rel=1e-6)
            assert result.axial[i] == pytest.approx(axial, rel=1e-6)

    @pytest.mark.parametrize("shift", [0.5, 0.55, 0.565])
    def test_tips_down_to_an_edge(self, shift):
        # eight teeth, tips 0.07 … 0.001 modules thick; Gauss-Legendre on intervals that shrink to the tip
        pair = drive(
            20.0, body(8, 0.004)._replace(profile_shift=shift), body(9, 0.004)._replace(profile_shift=0.5)
        )
        assembly = assemble(involute.FAMILY, pair)
        tooth = loaded_tooth(assembly, "pinion")
        r = np.linspace(assembly.r_start, assembly.r_end, 5)
        result = tooth_compliance(tooth, STEEL, 0.02, r)
        contact = contact_in_tooth_frame(tooth.path, tooth.pitch_half_angle, r)
        outline = tooth_outline(tooth.tooth, 2, 4000)
        fillet_x, fillet_y = outline.fillet_x, outline.fillet_y
        first = float(distance_at_radius(tooth.path, tooth.tooth.form_radius))
        nodes, weights = np.polynomial.legendre.leggauss(40)
        for i in range(5):
            ends = r[i] - (r[i] - first) * np.append(0.7 ** np.arange(40), 0.0)
            half = np.diff(ends)[:, None] / 2
            at = ends[:-1, None] + half * (1 + nodes)
            x, y, _ = contact_in_tooth_frame(tooth.path, tooth.pitch_half_angle, at)
            flank = kinematics(tooth.path, at)
            # dx/dr = u_p cos λ/(r_p cos α), λ the flank's angle to the tooth's axis
            lean = flank.pressure_angle - tooth.pitch_half_angle + tooth.path.rotation(at)
            rate = flank.pinion_speed / flank.pinion_normal_arm * np.cos(lean)
            lever = contact.x[i] - contact.y[i] * math.tan(contact.load_angle[i])
            moment = (lever - x) ** 2 * 1.5 / y**3 * rate
            bending = np.sum(weights * half * moment)
            bending += np.trapezoid((lever - fillet_x) ** 2 * 1.5 / fillet_y**3, fillet_x)
            bending *= math.cos(contact.load_angle[i]) ** 2 / (207e9 * 0.02)
            assert result.bending[i] == pytest.approx(bending, rel=1e-6)


class TestBody:
    @pytest.mark.parametrize("side", SIDES)
    @pytest.mark.parametrize("kind", ["sainsot-velex", "ring"])
    def test_the_load_is_carried_down_to_the_root_circle(self, side, kind):
        """By statics; the body then gives way over its own width, and the whole is the sum of the parts."""
        pair = drive(22.81, body(23, 0.015, 0.03), body(47, 0.025, 0.024))
        tooth = loaded(involute.FAMILY, pair, side)._replace(held=True)
        soft = replace(STEEL, youngs_modulus=110e9)
        r = np.array([-3e-3, 1e-3, 4e-3])
        result = tooth_compliance(tooth, soft, 0.02, r, kind)
        contact = contact_in_tooth_frame(tooth.path, tooth.pitch_half_angle, r if side == "pinion" else -r)
        root = tooth.tooth.root_radius
        wide = 0.03 if side == "pinion" else 0.024
        outline = tooth_outline(tooth.tooth, 50, 50)
        half_angle = np.arctan2(outline.fillet_y[0], outline.fillet_x[0])
        assert np.hypot(outline.fillet_x[0], outline.fillet_y[0]) == pytest.approx(root)
        for i in range(3):
            inwards, across = math.sin(contact.load_angle[i]), math.cos(contact.load_angle[i])
            moment = across * (contact.x[i] - root) - inwards * contact.y[i]
            np.testing.assert_allclose(result.root_load[i], [inwards, across, moment / root], rtol=1e-10)
            if kind == "ring":
                flexibility = ring_compliance(
                    0.0, half_angle, tooth.body.bore_radius / root, 0.3, 2048, held=True
                )
                expected = result.root_load[i] @ flexibility @ result.root_load[i] / (110e9 * wide)
            else:
                l_star, m_star, p_star, q_star = sainsot_velex(root / tooth.body.bore_radius, half_angle)
                share = moment / across / (2 * half_angle * root)
                # L* (u/S)² + M* u/S + P* (1 + Q* tan² α), times cos² α
                shape = l_star * share**2 + m_star * share + p_star * (1 + q_star * (inwards / across) ** 2)
                expected = across**2 * shape / (110e9 * wide)
            assert result.foundation[i] == pytest.approx(expected, rel=1e-8)
        parts = result.bending + result.shear + result.axial + result.foundation
        np.testing.assert_allclose(result.total, parts, rtol=1e-14)
        # the beam is as wide as the contact, the body as the gear
        thin = tooth_compliance(tooth, soft, 0.01, r, kind)
        np.testing.assert_allclose(thin.total - thin.foundation, 2 * (result.total - result.foundation))

    @pytest.mark.parametrize("pitches", [1, 2])
    def test_a_neighbour_is_whole_pitches_away_on_the_side_that_entered_first(self, pitches):
        pair = drive(22.81, body(23, 0.015, 0.03), body(47, 0.025, 0.024))
        for side, teeth, wide, sense in (("pinion", 23, 0.03, 1), ("gear", 47, 0.024, -1)):
            tooth = loaded(involute.FAMILY, pair, side)
            angle = sense * 2 * math.pi * pitches / teeth
            ratio = tooth.body.bore_radius / tooth.tooth.root_radius
            tip = tooth.tooth.tip_radius / tooth.tooth.root_radius
            ring = ring_compliance(angle, tooth.root_half_angle, ratio, 0.3, tip_ratio=tip) / (207e9 * wide)
            found = neighbour_coupling(tooth, STEEL, pitches)
            np.testing.assert_allclose(found, ring, rtol=1e-8, atol=1e-10 * np.abs(ring).max())

    def test_polynomials_over_the_ring_is_their_ratio_at_the_pitch_point(self):
        tooth = loaded(involute.FAMILY, drive(), "gear")
        fitted, ring = (
            tooth_compliance(tooth, STEEL, 1.0, np.zeros(1), kind).foundation
            for kind in ("sainsot-velex", "ring")
        )
        assert polynomials_over_ring(tooth, STEEL) == pytest.approx(fitted[0] / ring[0], rel=1e-12)


class TestPair:
    def test_similar_gears_have_the_same_compliance(self):
        r = np.array([-2e-3, 0.0, 3e-3])
        small = drive()
        large = small._replace(
            module=2 * small.module,
            pinion=small.pinion._replace(bore_radius=0.024),
            gear=small.gear._replace(bore_radius=0.05),
        )
        expected = pair_compliance(involute.FAMILY, small, STEEL, r)
        np.testing.assert_allclose(
            pair_compliance(involute.FAMILY, large, STEEL, 2 * r), expected, rtol=1e-10
        )

    @pytest.mark.parametrize("family", [involute.FAMILY, crc.FAMILY])
    def test_equal_gears_are_symmetric(self, family):
        pair = drive(22.0, body(30, 0.015), body(30, 0.015))
        r = np.linspace(-4e-3, 4e-3, 9)
        pinion = tooth_compliance(loaded(family, pair, "pinion"), STEEL, 0.02, r)
        gear = tooth_compliance(loaded(family, pair, "gear"), STEEL, 0.02, -r)
        for ours, other in zip(pinion, gear, strict=True):
            np.testing.assert_allclose(ours, other, rtol=1e-8)
        later, earlier = (neighbour_coupling(loaded(family, pair, s), STEEL, 1) for s in SIDES)
        np.testing.assert_allclose(later, earlier.T, rtol=1e-8)

    @pytest.mark.parametrize("family", [involute.FAMILY, crc.FAMILY])
    @pytest.mark.parametrize(("pinion", "gear"), [(23, 47), (30, 60), (50, 50)])
    def test_steel_pairs_are_as_stiff_as_steel_pairs_are(self, family, pinion, gear):
        pair = drive(22.0, body(pinion, 0.3e-3 * 3 * pinion), body(gear, 0.3e-3 * 3 * gear))
        stiffness = 1 / (pair_compliance(family, pair, STEEL, np.zeros(1)) * 0.0267)
        assert 13e9 < stiffness[0] < 19e9


class TestHertz:
    def test_load_dependent_does_not_know_units(self):
        # the same formula in N and mm
        in_millimetres = 1.275 / (207e3**0.9 * 26.7**0.8) * 1e-3
        assert hertz_coefficient(STEEL, STEEL, 0.0267) == pytest.approx(in_millimetres, rel=1e-12)

    def test_of_two_materials_each_brings_its_part(self):
        soft = replace(STEEL, youngs_modulus=110e9, poisson_ratio=0.25)
        halves = [2 * (1 - m.poisson_ratio**2) / (math.pi * m.youngs_modulus * 0.02) for m in (STEEL, soft)]
        assert hertz_linear(STEEL, soft, 0.02) == pytest.approx(sum(halves), rel=1e-14)
        mean = 2 * 207e9 * 110e9 / (207e9 + 110e9)
        expected = hertz_coefficient(
            replace(STEEL, youngs_modulus=mean), replace(STEEL, youngs_modulus=mean), 0.02
        )
        assert hertz_coefficient(STEEL, soft, 0.02) == pytest.approx(expected, rel=1e-12)
