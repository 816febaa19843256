"""The drive train of OpenFAST's ElastoDyn: the lines of its input file, seen from the rotor.

OpenFAST documentation, "ElastoDyn primary input file", section DRIVETRAIN: GBoxEff in percent, GBRatio the
speed of the generator over that of the rotor, DTTorSpr and DTTorDmp at the low-speed shaft.
"""

from collections.abc import Mapping

import numpy as np

from tribodyn.exchange.format import MAP, ExchangeFormat, Exported, Written, deviation
from tribodyn.exchange.heading import heading
from tribodyn.exchange.maps.chosen import (
    CHOICES,
    DAMPING_RATIO,
    SPEED,
    TORQUE,
    at_temperature,
    celsius,
    damping_ratio,
    inertia,
    nominal,
    shares,
    stiffness,
)


def write(exported: Exported, name: str, choices: Mapping[str, float]) -> Written:
    """Lines to be put in place of those of a file; the efficiency is read back and compared."""
    losses = exported.losses
    rotor_is_input = abs(losses.ratio) >= 1.0
    torque = nominal(exported, "torque", choices, losses.torque)
    if (torque > 0.0) is not rotor_is_input:
        torque = -torque  # the rotor drives
        _require(exported, torque)
    speed = nominal(exported, "speed", choices, losses.speed)
    temperature, drag = at_temperature(exported, choices)
    load = abs(losses.ratio * torque)
    lost = float(losses.at(temperature, torque, speed))
    efficiency = load / (load + lost) if rotor_is_input else 1.0 - lost / load
    if efficiency <= 0.0:
        raise exported.refused("locks itself where the rotor drives", "OpenFAST has no such gearbox")
    to_rotor = losses.ratio**2 if rotor_is_input else 1.0
    spring = stiffness(exported, torque) * to_rotor
    turning = inertia(exported) * (1.0 if rotor_is_input else losses.ratio**-2)
    share = damping_ratio(exported, choices)
    rows = (
        (f"{100 * efficiency:.6g}", "GBoxEff", "Gearbox efficiency (%)"),
        (f"{max(abs(losses.ratio), 1 / abs(losses.ratio)):.9g}", "GBRatio", "Gearbox ratio (-)"),
        (f"{spring:.6g}", "DTTorSpr", "Drivetrain torsional spring (N-m/rad)"),
        (
            f"{2 * share * np.sqrt(spring * turning):.6g}",
            "DTTorDmp",
            "Drivetrain torsional damper (N-m/(rad/s))",
        ),
    )
    lines = [f"{value:>13}   {key:11} - {about}" for value, key, about in rows]
    read = {line.split()[1]: float(line.split()[0]) for line in lines}["GBoxEff"] / 100
    # of what the rotor gives: the part that is lost, at the input of the map
    driven = losses.torque > 0.0 if rotor_is_input else losses.torque < 0.0
    loads = np.abs(losses.ratio * losses.torque[driven])[:, None]
    share_lost = 1.0 / read - 1.0 if rotor_is_input else 1.0 - read
    deviations = (
        deviation(
            "drag at the input",
            "N m",
            np.broadcast_to(share_lost * loads, drag[driven].shape),
            drag[driven],
            "the loads of the map that the rotor drives, at this oil temperature",
            shares(losses.torque, losses.speed)[driven],
        ),
    )
    turns = "the same way" if losses.ratio > 0.0 else "opposite ways"
    remarks = (
        f"efficiency at {torque:.6g} N m at the map's output, {speed:.6g} rad/s, {celsius(temperature)} oil",
        f"the rotor is the map's {'input' if rotor_is_input else 'output'}; rotor and generator turn {turns}",
        f"damper: {share:.3g} of critical for the gearbox's own inertia, {turning:.4g} kg m^2 at the rotor",
    )
    top = heading(exported, "! ", deviations, remarks)
    section = "---------------------- DRIVETRAIN ".ljust(80, "-")
    return Written({".dat": top + "\n".join([section, *lines]) + "\n"}, deviations, remarks)


def _require(exported: Exported, torque: float) -> None:
    axis = exported.losses.torque
    if not axis[0] <= torque <= axis[-1]:
        rule = "has no loads that the rotor, its slow end, drives"
        raise exported.refused(rule, "map torques of the other sign too")


FORMAT = ExchangeFormat(
    "openfast",
    "drive train of OpenFAST's ElastoDyn: GBoxEff, GBRatio, DTTorSpr, DTTorDmp",
    (".dat",),
    takes=(MAP,),
    write=write,
    choices={**CHOICES, **TORQUE, **SPEED, **DAMPING_RATIO},
)
