"""Laws of links: against SciPy on equations of the test's own, energy, every compiler, bad input."""

from itertools import product
from typing import Any

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from tests.support.right_hand_sides import assert_right_hand_sides_agree, at_several_conditions
from tests.support.soak_parameters import all_in_soak
from tests.support.spring_trains import Gears, prepared_springs, scenario_of, spring_model
from tests.support.states import sampled
from tests.support.train_matrices import Body, Mesh, Shaft, Train
from tests.support.train_scenarios import case_of_table
from tribodyn.dynamics.recorded.outputs import evaluated, mesh_outputs, train_outputs
from tribodyn.errors import InputError
from tribodyn.numerics.parameter import Parameter
from tribodyn.solve.transient import TransientSettings
from tribodyn.studies.motion.assembly import PreparedGearbox
from tribodyn.studies.protocol.run import with_link_law
from tribodyn.train.links.chain import tangent_stiffness, twist_under
from tribodyn.train.links.law import LinkLaw
from tribodyn.train.structure import turn_of

#: Inertias of a gear and a flywheel behind a coupling, kg m²; mesh, coupling: N/m, N m/rad, N m s/rad.
GEAR, FLYWHEEL, MESH, COUPLING, DAMPER = 4e-3, 2e-2, 3e8, 2e4, 1.5
TEETH, RADIUS, ALPHA, SPEED = 30, 0.045, np.radians(20.0), 100.0
#: Load of the flywheel: mean, amplitude (N m), frequency (Hz). That of the gear keeps its teeth in contact.
MEAN, SWING, RATE, OF_GEAR = 20.0, 60.0, 70.0, 900.0
PLAY, SHARE, CYCLES, GROWTH = 4e-3, 0.05, 30, 4e5
DURATION = CYCLES * 2.0 * np.pi / (TEETH * SPEED)


def hardening(twist, stiffness, parameters):
    """Stiffness that grows with the square of the twist."""
    squared = parameters.growth * twist * twist
    return stiffness * twist * (1.0 + squared), stiffness * twist * twist * (0.5 + 0.25 * squared), 1.0


HARDENING = LinkLaw(
    "hardening",
    "a cubic spring",
    hardening,
    keys=(Parameter("growth", "number", "of the stiffness, 1/rad²", default=GROWTH, source="chosen here"),),
)


def scenario(law: dict[str, Any], **operating: Any) -> dict[str, Any]:
    bodies = (Body(1.0, 1e-2), Body(1.0, GEAR), Body(1.0, FLYWHEEL))
    mesh = Mesh((0, 1), (RADIUS, RADIUS), 0.0, ALPHA, -1, MESH)
    train = Train(bodies, (), (Shaft((1, 2), COUPLING, DAMPER),), (mesh,))
    swing = {"amplitude": f"{SWING} N*m", "frequency": f"{RATE} Hz"}
    duty = {"input_speed": f"{SPEED} rad/s", "output_torque": f"{MEAN} N*m"}
    made = scenario_of(
        train, [Gears((TEETH, TEETH), 3e-3)], 0.0, {**duty, "output_torque_harmonics": [swing], **operating}
    )
    made["load"] = [{"at": "b1", "torque": f"{OF_GEAR} N*m"}]
    made["link"][0] |= {"name": "coupling", **law}
    return made


def with_play(share: float = SHARE) -> dict[str, Any]:
    return {"law": "play", "play": f"{PLAY} rad", "contact_share": share}


def sharp(twist: float) -> tuple[float, float]:
    """Torque of a coupling that touches at the end of its play, and whether its damper acts."""
    beyond = abs(twist) - 0.5 * PLAY
    return (COUPLING * np.copysign(beyond, twist), 1.0) if beyond > 0.0 else (0.0, 0.0)


def gradual(twist: float) -> tuple[float, float]:
    """The same where contact spreads over a width of twist, evenly about the end of the play."""
    width, beyond = SHARE * PLAY, abs(twist) - 0.5 * PLAY
    if abs(beyond) >= 0.5 * width:
        return sharp(twist)
    spread = beyond + 0.5 * width
    return COUPLING * np.copysign(spread**2 / (2.0 * width), twist), spread / width


def cubic(twist: float) -> tuple[float, float]:
    return COUPLING * (twist + GROWTH * twist**3), 1.0


def expected(law: Any, start: np.ndarray, times: np.ndarray, rtol: float = 1e-11) -> np.ndarray:
    """Rotations of gear and flywheel and their rates (time, 4), the driver turning evenly; by SciPy."""
    mesh = MESH * (RADIUS * np.cos(ALPHA)) ** 2

    def rates(t: float, state: np.ndarray) -> list[float]:
        gear, wheel, gear_rate, wheel_rate = state
        torque, share = law(gear - wheel)
        torque += DAMPER * share * (gear_rate - wheel_rate)
        load = MEAN + SWING * np.cos(2.0 * np.pi * RATE * t)
        return [gear_rate, wheel_rate, (-mesh * gear - torque - OF_GEAR) / GEAR, (torque - load) / FLYWHEEL]

    found = solve_ivp(rates, (0.0, times[-1]), start, "DOP853", times, rtol=rtol, atol=1e-15, max_step=2e-5)
    return found.y.T


def places(prepared: PreparedGearbox) -> list[int]:
    """Where the states have the rotations of gear and flywheel, and their rates."""
    layout = prepared.model.layout
    turns = [turn_of(prepared.names.index(name), layout) for name in ("b1", "b2")]
    return [*turns, *(layout.half + turn for turn in turns)]


def motion(prepared: PreparedGearbox, method: str, rtol: float) -> tuple[np.ndarray, np.ndarray]:
    """Times and states of a run from the static equilibrium."""
    settings = TransientSettings(method, rtol, CYCLES, 10**6, 50)
    cycles, states = sampled(prepared.model, settings)
    return cycles * DURATION / CYCLES, states


def off(states: np.ndarray, wanted: np.ndarray) -> float:
    """Largest difference over what each coordinate ranges through."""
    return float(np.max(np.max(np.abs(states - wanted), axis=0) / np.ptp(wanted, axis=0)))


def with_law(law: LinkLaw) -> PreparedGearbox:
    case: Any = with_link_law(case_of_table(scenario({})), "coupling", law)
    return prepared_springs(case)


LAWS = {
    "play": (lambda: spring_model(scenario(with_play())), gradual),
    "cubic": (lambda: with_law(HARDENING), cubic),
}


@pytest.mark.parametrize(
    ("law", "method"),
    all_in_soak(
        product(LAWS, ["dopri5", "rodas4", "tsit5", "radau"]),
        [("play", "dopri5")],
        names=2,
    ),
)
def test_two_bodies_move_as_scipy_finds(law, method):
    make, torque = LAWS[law]
    prepared = make()
    times, states = motion(prepared, method, 1e-9)
    found = states[:, places(prepared)]
    twist = found[:, 0] - found[:, 1]
    if law == "play":  # it goes through the whole play, and back
        assert np.min(twist) < -0.5 * PLAY
        assert np.max(twist) > 0.5 * PLAY
    assert off(found, expected(torque, found[0], times)) < 1e-5


def test_contact_over_the_default_width_is_a_sharp_one():
    prepared = spring_model(scenario({"law": "play", "play": f"{PLAY} rad"}))
    times, states = motion(prepared, "dopri5", 1e-9)
    found = states[:, places(prepared)]
    assert off(found, expected(sharp, found[0], times, 1e-10)) < 1e-4


@pytest.mark.parametrize("law", LAWS)
def test_energy_balances(law):
    prepared = LAWS[law][0]()
    cycles, states = sampled(prepared.model, TransientSettings("dopri5", 1e-10, CYCLES, 10**6, 50))
    seen = evaluated(cycles, states, prepared.model)
    whole = train_outputs(seen, mesh_outputs(0, seen)["sliding_loss"])
    change = {name[5:]: whole[name][-1] - whole[name][0] for name in whole if name.startswith("work_")}
    stored = whole["stored_energy"][-1] - whole["stored_energy"][0]
    left = change["in"] + change["parametric"] - change["out"] - stored
    left -= change["friction"] + change["damping"]
    assert change["damping"] > 0.0
    assert abs(left) < 1e-8 * abs(change["in"])


def test_every_compiler_makes_the_same_of_several_laws(rng):
    """A coupling with play, one of a law from here, and a linear one."""
    model = several().model
    assert_right_hand_sides_agree(at_several_conditions(model), rng, rtol=1e-11)


def test_static_twist_and_tangent_stiffness():
    """A torque turns a coupling by half its play and that of a spring; the tangent is the spring's."""
    model = spring_model(scenario(with_play())).model
    assert twist_under(0, 30.0, model) == pytest.approx(30.0 / COUPLING + 0.5 * PLAY, rel=1e-12)
    assert twist_under(0, -30.0, model) == pytest.approx(-30.0 / COUPLING - 0.5 * PLAY, rel=1e-12)
    assert tangent_stiffness(0, 30.0, model) == pytest.approx(COUPLING, rel=1e-8)
    assert tangent_stiffness(0, 0.0, model) == 0.0


def several() -> PreparedGearbox:
    made = scenario(with_play())
    for number in (3, 4):
        made["body"].append({"name": f"b{number}", "mass": "1 kg", "inertia": "1e-2 kg*m**2"})
        made["link"].append({"ends": [f"b{number - 1}", f"b{number}"], "stiffness": "3e4 N*m/rad"})
    made["link"][1]["name"] = "shaft"
    return prepared_springs(with_link_law(case_of_table(made), "shaft", HARDENING))  # pyright: ignore[reportArgumentType]


@pytest.mark.parametrize(
    ("link", "key", "rule"),
    [
        ({"law": "slack"}, "link.0.law", "no such link law"),
        ({"law": "play"}, "link.0.play", "needs it"),
        ({"law": "play", "play": "-1 deg"}, "link.0.play", ""),
        ({"law": "linear", "play": "1 deg"}, "link.0.play", 'it is a key of law = "play"'),
        ({"law": "auto"}, "link.0.law", "no such link law"),
        ({"law": "play", "play": "1 deg", "stiffness": None}, "link.0.stiffness", 'law = "play" needs it'),
    ],
)
def test_bad_input_is_refused(link, key, rule):
    made = scenario({})
    made["link"][0] |= link
    if made["link"][0]["stiffness"] is None:
        del made["link"][0]["stiffness"]
    with pytest.raises(InputError) as refused:
        case_of_table(made)
    errors = getattr(refused.value, "errors", (refused.value,))
    assert any(error.key == key and rule in error.rule for error in errors), str(refused.value)


def more_than_its_damper(twist, stiffness, parameters):
    return stiffness * twist, 0.5 * stiffness * twist * twist, 2.0


def branched(twist, stiffness, parameters):
    if twist > 0.0:
        return stiffness * twist, 0.5 * stiffness * twist * twist, 1.0
    return 0.0, 0.0, 0.0


@pytest.mark.parametrize(
    ("law", "rule"),
    [
        (more_than_its_damper, "share of the damping"),
        (branched, "fails on arrays"),
    ],
)
def test_a_law_that_is_none_is_refused(law, rule):
    case: Any = with_link_law(case_of_table(scenario({})), "coupling", law)
    with pytest.raises(InputError, match=rule):
        prepared_springs(case)


def test_a_link_that_is_not_there_is_refused():
    with pytest.raises(InputError, match='did you mean "coupling"'):
        with_link_law(case_of_table(scenario({})), "couplin", hardening)
