"""What the functions of a notebook refuse: one line each that names the argument, before anything runs."""

import numpy as np
import pytest

import tribodyn as td

CASE, TORQUE = "crc-23-47", "operating.gear_torque"
VARY = {TORQUE: "100:300:100 N*m"}
CONTACT = {
    "line_load": 1e6,
    "radius": 0.01,
    "entrainment_speed": 10.0,
    "viscosity": 0.01,
    "pressure_viscosity": 2e-8,
    "effective_modulus": 2.3e11,
}
SHORT = {"solver.cycles": 2}


@pytest.mark.parametrize(
    ("function", "values", "keys", "said"),
    [
        ("scenario", (3,), {}, "scenario: expected a name"),
        ("scenario", (CASE, 3), {}, "overrides = 3: is no mapping"),
        ("scenario", (CASE, [("a", 1)]), {}, "overrides"),
        ("scenario", (CASE, {"\ud800": 1}), {}, "holds a control character"),
        ("scenario", (CASE, {TORQUE: object()}), {}, "not a quantity but an object"),
        ("scenario", (CASE, {TORQUE: None}), {}, "operating.gear_torque: missing"),
        ("check", (CASE, "a=b"), {}, "overrides"),
        ("run", (CASE, SHORT), {"output": 3}, "output = 3: is no path"),
        ("run", (CASE, SHORT), {"output": "a\0b"}, "output"),
        ("run", (CASE, SHORT), {"progress": 3}, "progress = 3: is neither a function"),
        ("run", (CASE, SHORT), {"links": [1]}, "links"),
        ("run", (CASE, SHORT), {"force": "no"}, "force"),
        ("run", (CASE, SHORT), {"film": 3}, "film = 3: expected a FilmLaw"),
        ("sweep", (CASE, None), {}, "vary"),
        ("sweep", (CASE, 3), {}, "vary = 3: is neither a mapping"),
        ("sweep", (CASE, {TORQUE: []}), {}, TORQUE),
        ("sweep", (CASE, VARY), {"transient": -1}, "transient = -1: is no whole number from 1 on"),
        ("sweep", (CASE, VARY), {"transient": 1.5}, "transient"),
        ("sweep", (CASE, VARY), {"transient": 0}, "transient"),
        ("sweep", (CASE, VARY), {"refine": "a"}, "refine"),
        ("sweep", (CASE, VARY), {"refine": 2, "refine_by": 3}, "refine_by"),
        ("sweep", (CASE, VARY), {"engine": "x"}, "engine"),
        ("sweep", (CASE, VARY), {"workers": 0}, "workers = 0: is no whole number from 1 on"),
        ("sweep", (CASE, VARY), {"workers": "a"}, "workers"),
        ("sweep", (CASE, VARY), {"direction": []}, "direction"),
        ("sweep", (CASE, VARY), {"signals": "1 s", "run_in": "a"}, "run_in"),
        ("sweep", (CASE, VARY), {"signals": "1 s", "seed": "a"}, "seed"),
        ("sweep", (CASE, VARY), {"signals": "1 s", "test": 2}, "test"),
        ("sweep", (CASE, VARY), {"signals": "1 s"}, "missing: what a data set holds"),
        ("open", (None,), {}, "path = None: is no path"),
        ("open", ("nope.h5",), {}, "no such file"),
        ("line_contact", (), {**CONTACT, "line_load": 10**400}, "line_load"),
        ("line_contact", (), {**CONTACT, "line_load": np.ones(2)}, "line_load"),
        ("line_contact", (), {**CONTACT, "start": 3}, "start"),
        ("line_contact", (), {**CONTACT, "lubricant": {}}, "lubricant"),
        ("drive", ("diez-ibarbia-18-36", 3), {}, "overrides"),
        ("drive", ("diez-ibarbia-18-36", {"pinion.teeth": 20}), {}, "= 20: is no key of a drive"),
        ("constraints", ("diez-ibarbia-18-36", {"x": 1}), {}, "is no key of a drive"),
        ("gradient", (CASE, "efficiency", 3), {}, "wrt"),
        ("gradient", (CASE, "nope", TORQUE), {}, "nope"),
        ("validate", (None,), {}, "paper"),
        ("validate", ("helical-report-2017", 3), {}, "progress"),
        ("compare_laws", (CASE, 3), {}, "overrides"),
        ("design", (CASE, 3), {}, "free = 3: is neither a mapping"),
        ("identify", (CASE, {"e": [0.0]}, {"mesh.damping_ratio": (0.0, 1.0)}), {"workers": 0}, "workers"),
    ],
)  # fmt: skip
def test_a_bad_argument_is_one_line_that_names_it(function: str, values, keys, said: str):
    with pytest.raises(td.InputError) as error:
        getattr(td, function)(*values, **keys)
    assert said in str(error.value)
    assert "\n" not in str(error.value)


def test_a_call_that_does_not_fit_is_python_s_own_error():
    with pytest.raises(TypeError, match=r"gradient\(\) missing 2 required"):
        td.gradient(CASE)  # pyright: ignore[reportCallIssue]
