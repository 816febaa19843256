"""Laws of film and friction that are handed over from Python: defined anywhere, in every integrator."""

import tomllib
from types import SimpleNamespace

import numpy as np
import pytest

from tribodyn import FilmLaw, FrictionLaw, InputError, Parameter
from tribodyn.kernels.native.arguments import function_layout
from tribodyn.numerics.elementary import exp, log
from tribodyn.record.reader import Record
from tribodyn.solve.ensemble import march
from tribodyn.solve.initial import initial_state
from tribodyn.studies.motion.prepare import prepare
from tribodyn.studies.protocol.load import load_scenario
from tribodyn.studies.protocol.run import run, with_law

SHORT = {"solver.cycles": 1, "output.samples_per_cycle": 40, "solver.rtol": 1e-8}
FINE = {**SHORT, "output.samples_per_cycle": 400}
COULOMB = {"friction": {"law": "coulomb", "coefficient": 0.05, "sliding": "kinematic"}}
IN_A_NOTEBOOK = """
from tribodyn.numerics.elementary import exp

def coefficient(contact, film, surfaces, parameters):
    return 0.03 + 0.05 * exp(-contact.entrainment / 2.0)
"""


def falling(contact, film, surfaces, parameters):
    return 0.03 + 0.05 * exp(-contact.entrainment / 2.0)


def closure(minimum):
    def coefficient(contact, film, surfaces, parameters):
        return minimum + 0.05 * exp(-contact.entrainment / 2.0)

    return coefficient


def notebook():
    """As a cell of a notebook defines it: its source is in no file."""
    cell = {}
    exec(IN_A_NOTEBOOK, cell)
    return cell["coefficient"]


def constant(contact, film, surfaces, parameters):
    return 0.05


def thin(contact, surfaces, parameters):
    return log(2e-7) + 0.0 * contact.line_load, 1.0, 0.0


PLACES = {"module": falling, "closure": closure(0.03), "notebook": notebook()}


@pytest.fixture(scope="module")
def case():
    return load_scenario("crc-23-47", {**SHORT, "solver.method": "dopri5"})


def assert_work_grows(record):
    """The work of friction in the native kernel grows by what NumPy makes of the law, over trapezoids."""
    work, power, time = (record[name] for name in ("work_friction", "power_friction", "time"))
    grown = np.cumsum(0.5 * (power[1:] + power[:-1]) * np.diff(time))
    np.testing.assert_allclose(work[1:] - work[0], grown, rtol=3e-3)  # pairs come and go in between


@pytest.mark.soak
@pytest.mark.parametrize("place", PLACES)
def test_a_law_works_wherever_it_is_defined(place, tmp_path):
    """The same formula in the native kernel as in NumPy."""
    case = load_scenario("crc-23-47", {**FINE, "solver.method": "dopri5"})
    result = run(case, tmp_path / "run.h5", friction=FrictionLaw(place, "", PLACES[place]))
    with Record(result.path) as record:
        coefficient = 0.03 + 0.05 * np.exp(-record["entrainment_speed"] / 2.0)
        np.testing.assert_allclose(record["friction_coefficient"], coefficient, rtol=1e-12)
        assert_work_grows(record)


@pytest.mark.soak
def test_the_lanes_take_a_law_that_is_a_closure(case):
    """Eight cases side by side under a constant from outside the function, as under the shipped law."""
    coefficient = 0.05

    def closed(contact, film, surfaces, parameters):
        return coefficient

    own = prepare(with_law(case, FrictionLaw, FrictionLaw("own", "", closed))).model
    shipped = prepare(load_scenario("crc-23-47", {**SHORT, **COULOMB})).model
    states = np.tile(initial_state(own, "static"), (8, 1))
    given = {"cycles": 2, "window": 1, "samples": 20, "rtol": 1e-8, "method": "dopri5", "workers": 1}
    ends = [march([model] * 8, states, **given).state for model in (own, shipped)]
    np.testing.assert_allclose(ends[0], ends[1], rtol=1e-9, atol=1e-18)


def test_an_efficiency_study_takes_a_law(tmp_path):
    """The efficiency under a constant law is that under Coulomb's."""
    study = {"friction.law": "coulomb", "friction.coefficient": 0.05}
    case = load_scenario("efficiency-crc-23-47", study)
    own = run(case, tmp_path / "own.h5", friction=FrictionLaw("own", "", constant))
    assert own.summary["efficiency"] == run(case, tmp_path / "shipped.h5").summary["efficiency"]


def test_the_record_names_the_laws_that_were_used(tmp_path):
    """Their names and keys with units; the old law's keys are gone, the table's other keys stay."""
    keys = (
        Parameter("floor", "number", "at speed"),
        Parameter("reference_speed", "velocity", "of the decay", 2.0, "chosen"),
    )

    def decay(contact, film, surfaces, parameters):
        return parameters.floor + 0.05 * exp(-contact.entrainment / parameters.reference_speed)

    own = FrictionLaw("decay", "", decay, keys=keys).with_values(floor=0.03)
    coulomb = load_scenario("crc-23-47", {**FINE, **COULOMB, "solver.method": "dopri5"})
    result = run(coulomb, tmp_path / "own.h5", film=FilmLaw("thin", "", thin), friction=own)
    with Record(result.path) as record:
        film, load = record["central_film_thickness"], record["normal_load"]
        speed, coefficient = record["entrainment_speed"], record["friction_coefficient"]
        assert_work_grows(record)
        assert record.scenario["film"] == {"law": "python:thin"}
        text, friction = str(record.attrs["scenario"]), record.scenario["friction"]
        assert record.attrs["scenario_sha256"] != coulomb.sha256
        assert record.summary["friction_law"] == "python:decay"
    np.testing.assert_allclose(film[load > 0.0], 2e-7, rtol=1e-12)
    np.testing.assert_allclose(coefficient, 0.03 + 0.05 * np.exp(-speed / 2.0), rtol=1e-12)
    assert (friction.pop("sliding"), friction.pop("reversal_width")) == ("kinematic", "20 um")
    assert friction == {"law": "python:decay", "floor": 0.03, "reference_speed": "2.0 m/s"}
    assert tomllib.loads(coulomb.toml)["friction"]["law"] == "coulomb"
    again = tmp_path / "again.toml"
    again.write_text(text, encoding="utf-8")
    with pytest.raises(InputError, match=r'friction.law = "python:decay".*handed over from Python'):
        load_scenario(again)


def test_two_laws_of_one_name_in_one_file_have_kernels_of_their_own():
    """What is kept on disk is looked up by this identity."""
    first, second = (lambda c, f, s, p: 0.03), (lambda c, f, s, p: 0.05)
    layouts = [function_layout(law) for law in (first, second)]
    assert all(layout.kept for layout in layouts)
    assert layouts[0].identity != layouts[1].identity


def test_a_law_of_a_notebook_or_with_numbers_from_around_it_is_known_again():
    """By what it does, not by its name, and the numbers that it takes, in whatever order these are equal."""
    assert function_layout(notebook()).identity == function_layout(falling).identity
    for make in (notebook, lambda: closure(0.03)):
        assert function_layout(make()).kept
        assert function_layout(make()).identity == function_layout(make()).identity
    assert function_layout(closure(0.03)).identity != function_layout(closure(0.04)).identity

    def of_three(a, b, c, d=0.0):
        return lambda x, own=d: a + 2.0 * b + 4.0 * c + own

    given = [(1, 2, 1), (2, 1, 1), (1, 1, 2), (1, 1, 1), (1.0, 1, 1), (True, 1, 1), (1, 1, 1, 1)]
    assert len({function_layout(of_three(*numbers)).identity for numbers in given}) == len(given)
    assert not function_layout(closure(np.zeros(2))).kept


@pytest.mark.parametrize("scenario", ["load-contact-18-36", "irefc", "backlash-oscillator"])
@pytest.mark.parametrize("table", ["film", "friction"])
def test_a_case_without_laws_refuses_one(scenario, table, tmp_path):
    given = {"film": FilmLaw("own", "", thin), "friction": FrictionLaw("own", "", constant)}
    with pytest.raises(InputError, match=f"has no {table} law"):
        run(load_scenario(scenario), tmp_path / "no.h5", **{table: given[table]})
    assert not list(tmp_path.iterdir())


@pytest.mark.parametrize("given", [np.exp, "coulomb", FilmLaw("film", "", thin), SimpleNamespace(name="x")])
def test_what_is_no_law_is_refused(given, case, tmp_path):
    with pytest.raises(InputError, match=r"expected a FrictionLaw.*tribodyn\.FrictionLaw"):
        run(case, tmp_path / "no.h5", friction=given)


def test_a_key_without_a_value_is_named(case, tmp_path):
    own = FrictionLaw("own", "", constant, keys=(Parameter("floor", "number", "at speed"),))
    with pytest.raises(InputError, match=r'friction\.floor: missing: law = "python:own" needs it'):
        run(case, tmp_path / "no.h5", friction=own)


def slick(contact, film, surfaces, parameters):
    """Falls with the entrainment speed; with numpy's exponential."""
    return 0.03 + 0.09 * np.exp(-contact.entrainment / 2.0)


def test_a_function_is_a_law(case, tmp_path):
    """In five lines; the same to the last bit as the law made of it. JAX cannot trace functions of numpy."""
    short = run(case, tmp_path / "short.h5", friction=slick)
    long = run(case, tmp_path / "long.h5", friction=FrictionLaw("slick", "", slick))
    assert short.summary["efficiency"] == long.summary["efficiency"]
    with Record(short.path) as record:
        assert record.scenario["friction"]["law"] == "python:slick"
        found = record["friction_coefficient"]
        expected = 0.03 + 0.09 * np.exp(-record["entrainment_speed"] / 2.0)
        np.testing.assert_allclose(found, expected, rtol=1e-12)
    through_jax = load_scenario("crc-23-47", {"solver.cycles": 1, "solver.method": "tsit5"})
    with pytest.raises(InputError, match=r"solver\.method: a law calls what JAX cannot trace"):
        run(through_jax, tmp_path / "jax.h5", friction=slick)
