"""Torsion of the drivetrains of two reference turbines: printed frequencies, free and generator held.

J. Jonkman et al., NREL/TP-500-38060 (2009): ratio 97; A. R. Nejad, Y. Guo, Z. Gao, T. Moan, Wind Energy 19
(2016); C. Bak et al., DTU Wind Energy Report I-0092 (2013): ratio 50; S. Wang, A. R. Nejad, T. Moan (2020).
"""

from typing import Any

import numpy as np
import pytest
from scipy.linalg import eigh

from tests.support.train_scenarios import case_of_table, prepared_train
from tribodyn.dynamics.modes import linearised, natural_frequencies
from tribodyn.studies.motion.prepare import prepare
from tribodyn.train.structure import turn_of

#: Rotor and generator, kg m²; the whole drivetrain at the rotor, N m/rad; ratio; free, generator held, Hz.
PRINTED = {
    "NREL 5 MW": (57_231_535.0, 534.116, 867_637_000.0, 97, 2.18, 0.6205),
    "DTU 10 MW": (156_348_032.0, 1500.5, 2_317_025_352.0, 50, 4.003, 0.612),
}


def two_inertias(turbine: str, drives: str) -> list[float]:
    """Frequencies of rotor and generator: all compliance in a shaft, and a stiff mesh of the ratio."""
    rotor, generator, stiffness, ratio, *_ = PRINTED[turbine]
    bodies = {"rotor": rotor, "wheel": 1e-3 * rotor / ratio, "pinion": generator}
    table: dict[str, Any] = {
        "kind": "gear-train",
        "title": turbine,
        "lubricant": "liu-ni-2022",
        "material": "18CrNiMo7-6",
        "mean_roughness": "0.6 um",
        "body": [
            {"name": name, "mass": "1 kg", "inertia": f"{inertia!r} kg*m**2"}
            for name, inertia in bodies.items()
        ],
        "link": [{"ends": ["rotor", "wheel"], "stiffness": f"{stiffness!r} N*m/rad"}],
        "mesh": [
            {
                "bodies": ["wheel", "pinion"],
                "teeth": [20 * ratio, 20],
                "module": "2 mm",
                "pressure_angle": "20 deg",
                "face_width": "100 mm",
                "stiffness": "1e14 N/m",
                "damping_ratio": 0.0,
            }
        ],
        "operating": {"input": "rotor", "output": "pinion", "input_speed": "10 rpm", "power": "1 MW"},
        "bearings": {},
        "friction": {"law": "none"},
        "film": {"law": "dowson-higginson"},
    }
    if drives == "generator":  # its rotation is prescribed: it is held
        table["operating"] |= {"input": "pinion", "output": "rotor"}
    else:
        table["operating"] |= {"source": "torque"}
    prepared = prepare(case_of_table(table))
    return natural_frequencies(prepared.model, [each.cycle for each in prepared.tables]).tolist()


@pytest.mark.parametrize("turbine", PRINTED)
def test_two_inertias_have_the_printed_frequencies(turbine: str):
    *_, free, held = PRINTED[turbine]
    assert two_inertias(turbine, "rotor")[0] == pytest.approx(free, rel=2e-3)
    assert two_inertias(turbine, "generator")[0] == pytest.approx(held, rel=2e-3)


def test_the_gearbox_of_10_mw_gives_as_its_drivetrain_is_printed_to():
    """With its shafts, pins, meshes and bodies; whose inertia the printed free frequency does not have."""
    prepared = prepared_train("dtu-10mw-gearbox", **{"mesh.slices": 5, "friction.law": "none"})
    model, names = prepared.model, prepared.names
    mass, stiffness = linearised(model, [each.cycle for each in prepared.tables])
    rotor, generator = (turn_of(names.index(name), model.layout) for name in ("rotor", "pinion"))
    kept = np.ix_(*2 * [np.delete(np.arange(len(mass)), generator)])
    held = np.sqrt(eigh(stiffness[kept], mass[kept], eigvals_only=True)[0]) / (2.0 * np.pi)
    assert held == pytest.approx(PRINTED["DTU 10 MW"][5], rel=2e-3)
    load = np.zeros(len(mass) - 1)
    load[rotor - (rotor > generator)] = 1.0
    k_eq = 1.0 / float(np.linalg.solve(stiffness[kept], load) @ load)
    inertia_r, inertia_g, printed, ratio, free, _ = PRINTED["DTU 10 MW"]
    assert k_eq == pytest.approx(printed, rel=1e-3)
    lone = np.sqrt(k_eq * (1.0 / inertia_r + 1.0 / (inertia_g * ratio**2))) / (2.0 * np.pi)
    assert lone == pytest.approx(free, rel=2e-3)
    # as all bodies behind the rotor turn with the generator, Rayleigh
    ratios = np.asarray(model.bodies.ratio) / float(model.bodies.ratio[names.index("rotor")])
    turning = np.asarray(model.bodies.inertia) * ratios**2
    behind = float(np.sum(turning)) - float(turning[names.index("rotor")])
    assert behind > 1.05 * inertia_g * ratio**2
    together = np.sqrt(k_eq * (1.0 / inertia_r + 1.0 / behind)) / (2.0 * np.pi)
    lowest = natural_frequencies(model, [each.cycle for each in prepared.tables])[0]
    assert lowest == pytest.approx(together, rel=0.02)
    assert lowest < free
