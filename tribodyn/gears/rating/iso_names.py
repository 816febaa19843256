"""Factors of ISO 6336-2 and -3 by their names in the standard, as programs read them."""

from tribodyn.standards import bending, pitting
from tribodyn.standards.metals import Metal


def common_names(
    mesh: pitting.PittingMesh, shape: pitting.Geometry, influence: pitting.Influences
) -> dict[str, float]:
    """What both gears have in common."""
    return {
        "F_t": pitting.tangential_load(mesh),
        "Z_H": shape.zone,
        "Z_E": shape.elasticity,
        "Z_epsilon": shape.contact_ratio,
        "Z_beta": shape.helix,
        "Z_B": shape.single_pair[0],
        "Z_D": shape.single_pair[1],
        "f_ZCa": mesh.unmodified_factor,
        "Z_X": influence.size,
        "sigma_H0": shape.nominal,
        "Y_ST": bending.STRESS_CORRECTION_TEST,
    }


def flank_names(metal: Metal, influence: pitting.Influences, gear: int) -> dict[str, float]:
    """Of the flank of pinion (0) or gear (1)."""
    return {
        "sigma_Hlim": metal.contact_limit,
        "Z_L": influence.lubricant[gear],
        "Z_v": influence.speed[gear],
        "Z_R": influence.roughness[gear],
        "Z_W": influence.hardening[gear],
    }


def root_names(
    metal: Metal, root: bending.BendingGear, nominal: bending.Stress, relative: bending.Relative
) -> dict[str, float]:
    """Of the root of a gear."""
    return {
        "sigma_Flim": metal.bending_limit,
        "h_F": root.section.arm,
        "s_Fn": root.section.thickness,
        "rho_F": root.section.notch_radius,
        "Y_F": nominal.form,
        "f_epsilon": nominal.distribution,
        "Y_S": nominal.correction,
        "Y_beta": nominal.helix,
        "Y_B": nominal.rim,
        "Y_DT": nominal.deep,
        "Y_delta_relT": relative.notch,
        "Y_R_relT": relative.surface,
        "Y_X": relative.size,
        "Y_M": relative.alternating,
        "sigma_F0": nominal.nominal,
    }


def other_root_names(
    root: bending.BendingGear, nominal: bending.Stress, by_formula: bool
) -> dict[str, float]:
    """Of the root by the choice of `ring_root` that is not taken, for comparison."""
    name = "cut" if by_formula else "formula"
    return {f"rho_F_{name}": root.section.notch_radius, f"sigma_F0_{name}": nominal.nominal}
