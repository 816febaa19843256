"""Slopes of a train's quantities beside differences of scenarios whose keys are changed."""

import tomllib

import numpy as np
import pytest

import tribodyn as td
from tribodyn.derivatives.differentiable import fixed_of
from tribodyn.derivatives.quantities import PairEvaluation, quantity_of
from tribodyn.input.sources import find_scenario

_UNITS = {"N m": "N*m", "m2/s": "m**2/s"}


def in_toml(value, unit):
    """A number of an SI unit as a scenario has it."""
    return float(value) if unit == "1" else f"{float(value)!r} {_UNITS.get(unit, unit)}"


def shipped(name, **operating):
    """A shipped scenario, with another key in place of the output's torque."""
    table = tomllib.loads(find_scenario(name).read_text(encoding="utf-8"))
    if operating:
        del table["operating"]["output_torque"]
        table["operating"] |= operating
    return table


def quantity(case, name):
    """Without a compiled program."""
    mesh, _, name = name.rpartition(".")
    pairs = [one.pair for one in case.meshes if mesh in ("", one.name)]
    if mesh:
        return float(quantity_of(pairs[0], name).function(PairEvaluation(pairs[0], fixed_of(pairs[0]))))
    loss = sum(quantity(case, f"{one.name}.friction_power") for one in case.meshes)
    ratio = [float(case.bodies[load.body].ratio) for load in case.loads]
    out = case.source.speed * sum(load.torque * n for load, n in zip(case.loads, ratio, strict=True))
    return {"friction_power": loss, "efficiency": out / (out + loss)}[name]


def compare(source, of, groups, overrides=None, rel=1e-5, alone=True):
    """Slopes with differences of scenarios; keys of a group are changed by the same factor.

    `alone`: values without slopes too, by a program of their own.
    """
    keys = " ".join(groups).split()
    case = td.scenario(source, overrides)
    function = td.differentiable(case, of, keys)
    values, slopes = function.jacobian(function.at)
    assert values == pytest.approx([quantity(case, name) for name in of], rel=1e-9)
    if alone:
        np.testing.assert_allclose(function.values(function.at), values, rtol=1e-12)
    for group in groups:
        places = [keys.index(key) for key in group.split()]
        found = slopes[:, places] @ function.at[places]
        step, ends = 1e-4, []
        for factor in (1.0 + step, 1.0 - step):
            changed = {
                keys[place]: in_toml(function.at[place] * factor, function.key_units[place])
                for place in places
            }
            end = td.scenario(source, (overrides or {}) | changed)
            ends.append(np.array([quantity(end, name) for name in of]))
        expected = (ends[0] - ends[1]) / (2.0 * step)
        np.testing.assert_allclose(
            found / values, expected / values, rtol=rel, atol=0.01 * rel, err_msg=group
        )
