"""Maps of losses for other simulators: run in them where they are installed, else read by other means."""

import ctypes
import json
import re
import shutil
import subprocess
import sys
import xml.etree.ElementTree as ET
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from scipy.interpolate import RegularGridInterpolator
from scipy.io import loadmat

import tribodyn as td
from tests.support import loss_maps
from tests.support.closed_form_losses import map_case
from tests.support.loss_maps import RATIO, SHARE
from tests.support.modelica_rig import CONNECTORS, RIG
from tests.support.verbs import complaint, invoke
from tribodyn.exchange import FORMATS
from tribodyn.exchange.format import MAP
from tribodyn.record.loss_map import LossMap, loss_map
from tribodyn.record.reader import Record
from tribodyn.studies.protocol.run import run

OF_MAPS = [name for name, each in FORMATS.items() if MAP in each.takes]
MESH = ("P_VZP", "high", "closed form")


@pytest.fixture
def path(tmp_path: Path) -> Path:
    return loss_maps.write_map(tmp_path / "map.h5")


@pytest.fixture
def losses(path: Path) -> LossMap:
    with Record(path) as record:
        return loss_map(record)


@pytest.fixture
def places() -> np.ndarray:
    """Torque, speed, oil temperature: within the map, and beyond its ends."""
    spread = np.random.default_rng(7).uniform(-1.2, 1.2, (60, 3))
    return spread * [400.0, 200.0, 40.0] + [0.0, 0.0, 340.0]


def written(path: Path, to: str, name: str = "reducer", **choices: Any) -> Path:
    return td.export(path, to, path.with_name(name), choices).files[0]


@pytest.fixture(scope="module")
def of_a_run(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The record of a run of a map whose losses are closed forms."""
    folder = tmp_path_factory.mktemp("map")
    return run(map_case([0, 60, 120], [0, 150, 300], [300, 360], directions="both"), folder / "run.h5").path


@pytest.mark.parametrize("name", OF_MAPS)
def test_the_record_of_a_run_is_taken(name: str, of_a_run: Path, tmp_path: Path):
    choices = {"damping_ratio": "0.05"} if "damping_ratio" in FORMATS[name].choices else {}
    done = td.export(of_a_run, name, tmp_path / "reducer", choices)
    if name in ("csv", "mat", "modelica", "python", "c"):
        assert done.deviations[0].maximum < 1e-6
    if name == "modelica":
        text = done.files[0].read_text(encoding="utf-8")
        assert numbers_of(text, "errorOrders") == pytest.approx([20, 40, 60, 6, 12, 18])
        assert numbers_of(text, "errorAmplitudes") == pytest.approx([2e-6] * 3 + [1e-5] * 3)


@pytest.mark.parametrize("name", OF_MAPS)
def test_a_map_without_statics_goes_as_far_as_the_target_needs(name: str, tmp_path: Path):
    lacking = dict.fromkeys(("backlash", "transmission_error_phase", "mesh_order"))
    path = loss_maps.write_map(tmp_path / "map.h5", changes=lacking)
    assert td.export(path, name, tmp_path / "reducer").files
    lacking |= dict.fromkeys(("stiffness_total", "transmission_error_output"))
    path = loss_maps.write_map(tmp_path / "map.h5", changes=lacking)
    if name in ("modelica", "openfast"):
        assert "no stiffness" in complaint("export", path, "--to", name, folder=tmp_path)
    else:
        assert td.export(path, name, tmp_path / "less").files


@pytest.mark.parametrize("name", OF_MAPS)
def test_every_file_states_its_error_and_is_replaced(name: str, path: Path):
    words = ("export", path, "--to", name, "-o", path.with_name("reducer"))
    printed = invoke(*words)
    first = path.with_name("reducer" + FORMATS[name].endings[0])
    content = first.read_bytes()
    assert b"written by tribodyn" in content[:1000]
    stated = str(loadmat(first)["about"]) if name == "mat" else content.decode()
    for line in printed.splitlines():
        assert "maximum error" not in line or line in stated
    assert "maximum error" in printed
    invoke(*words)
    assert first.read_bytes() == content
    first.write_text("mine", encoding="utf-8")
    assert "did not make it" in complaint(*words)


def test_python_looks_up_without_numpy(path: Path, losses: LossMap, places: np.ndarray):
    module = written(path, "python")
    program = (
        "import json, sys, reducer; print(json.dumps([[f(*p) for p in json.loads(sys.argv[1])] "
        "for f in (reducer.drag, reducer.torque_at_input, reducer.efficiency)])); "
        "assert 'numpy' not in sys.modules"
    )
    command = [sys.executable, "-S", "-c", program, json.dumps(places.tolist())]
    ran = subprocess.run(command, cwd=module.parent, capture_output=True, text=True, check=True)
    compare(json.loads(ran.stdout), losses, places)


def test_c_compiles_without_a_warning_and_looks_up(path: Path, losses: LossMap, places: np.ndarray):
    compiler = shutil.which("cc")
    if compiler is None:
        pytest.skip("no C compiler")
    source = written(path, "c", "my reducer")
    library = source.with_name("reducer.so")
    flags = ["-std=c99", "-Wall", "-Wextra", "-pedantic", "-Werror", "-shared", "-fPIC"]
    subprocess.run([compiler, *flags, source.name, "-o", library.name], cwd=source.parent, check=True)
    loaded = ctypes.CDLL(str(library))

    def called(name: str) -> list[float]:
        function = getattr(loaded, f"my_reducer_{name}")
        function.restype, function.argtypes = ctypes.c_double, [ctypes.c_double] * 3
        return [function(*place) for place in places]

    compare([called(name) for name in ("drag", "torque_at_input", "efficiency")], losses, places)


def compare(found: Any, losses: LossMap, places: np.ndarray) -> None:
    """With the map, at places that most of are between its points."""
    torque, speed, temperature = places.T
    drag = losses.at(temperature, torque, speed)
    load = abs(RATIO) * torque
    assert np.allclose(found[0], drag, rtol=1e-8)
    assert np.allclose(found[1], load + drag, rtol=1e-7, atol=1e-7)
    efficiency = np.where(load > 0.0, load / (load + drag), (abs(load) - drag) / abs(load))
    assert np.allclose(found[2], efficiency, rtol=1e-7, atol=1e-7)


def test_matlab_has_tables_for_two_blocks(path: Path, losses: LossMap):
    read = loadmat(written(path, "mat", speed="100 rad/s"), simplify_cells=True)
    table = read["simulink"]
    axes = [table[f"breakpoints{number}"] for number in (1, 2, 3)]
    looked_up = RegularGridInterpolator(tuple(axes), table["drag"])([[120.0, 55.0, 310.0]])
    assert looked_up == pytest.approx(losses.at(310.0, 120.0, 55.0))
    gear = read["simscape"]
    base = gear["load_at_base_gear"]
    drag = loss_maps.STANDSTILL + loss_maps.VISCOUS * 100.0
    # of the closed form at 300 K: base = load (1 + share) + drag
    closed = 1.0 - ((base - drag) / (1.0 + SHARE)) / base
    assert np.allclose(1.0 - gear["efficiency"][0], closed, rtol=0.03)
    assert gear["efficiency"].shape == (3, len(base))
    assert read["statics"]["stiffness"][0] == loss_maps.STIFFNESS


def table_of(text: str) -> np.ndarray:
    block = re.search(r"lossTable\[:, 5\]=\{(.*?)\}\n", text, re.DOTALL)
    assert block
    return np.array([[float(x) for x in row.split(",")] for row in re.findall(r"\{(.*?)\}", block[1] + "}")])


def test_the_table_of_a_lossy_gear_balances_torques(path: Path, losses: LossMap):
    """By the equations of the standard library, at the torques at both ends that the map has."""
    table = table_of(written(path, "modelica", oil_temperature="300 K").read_text(encoding="utf-8"))
    assert np.array_equal(table[-1, 1:], table[-2, 1:])
    assert table[-1, 0] > table[-2, 0]
    assert np.allclose(table[:, 2], 2.0 - 1.0 / table[:, 1], rtol=1e-8)
    for number, speed in enumerate(losses.speed):
        row = table[np.abs(table[:, 0] - abs(speed)).argmin()]
        tau_a = losses.torque_at_input()[0, :, number]
        # w > 0: tau_loss where a drives, and where b drives; the driving side by where both are equal
        forward = (1.0 - row[1]) * tau_a + row[3]
        backward = (1.0 - 1.0 / row[2]) * tau_a + row[4]
        border = (row[3] - row[4]) / (row[1] - 1.0 / row[2])
        lost = np.where(tau_a - border > 0.0, forward, backward)
        assert np.allclose(tau_a - lost, abs(RATIO) * losses.torque, atol=2e-7)


def test_a_lossy_gear_of_a_map_of_one_direction_says_what_it_takes_for_the_other(tmp_path: Path):
    path = loss_maps.write_map(tmp_path / "map.h5", changes={"torque": np.array([0.0, 100.0, 400.0])})
    done = td.export(path, "modelica", tmp_path / "reducer")
    table = table_of(done.files[0].read_text(encoding="utf-8"))
    assert np.allclose(table[:, 2], 2.0 - 1.0 / table[:, 1], rtol=1e-8)
    assert any("loads of one sign only" in remark for remark in done.remarks)


def test_what_no_line_over_the_load_holds_is_stated_as_error(tmp_path: Path):
    """The residual of a parabola, by a fit of another kind."""

    def parabola(temperature: Any, torque: Any, speed: Any) -> Any:
        return 1.0 + 2e-5 * torque**2 + 0.0 * (speed + temperature)

    path = loss_maps.write_map(tmp_path / "map.h5", {MESH: parabola})
    done = td.export(path, "modelica", tmp_path / "reducer")
    stated = next(each for each in done.deviations if "Lossy" in each.of)
    loads = loss_maps.TORQUES
    sides = np.stack([np.ones(7), np.maximum(loads, 0.0), np.maximum(-loads, 0.0)], axis=1)
    exact = parabola(0.0, loads, 0.0)
    weights = np.gradient(loads) * np.where(np.abs(loads) == 400.0, 0.5, 1.0)
    root = np.sqrt(weights)[:, None]
    residual = sides @ np.linalg.lstsq(sides * root, exact * root[:, 0], rcond=None)[0] - exact
    assert stated.maximum == pytest.approx(np.abs(residual).max(), rel=1e-6)
    assert stated.mean == pytest.approx(np.average(np.abs(residual), weights=weights), rel=1e-6)


def test_modelica_is_well_formed(path: Path):
    file = written(path, "modelica")
    text = re.sub(r'"[^"]*"|//.*', "", file.read_text(encoding="utf-8"))
    for opened, closed in ("()", "[]", "{}"):
        assert text.count(opened) == text.count(closed)
    opened = re.findall(r"^ *(?:package|model|function) (\w+)", text, re.MULTILINE)
    closed = re.findall(r"^ *end (?!for|while|if)(\w+);", text, re.MULTILINE)
    assert sorted(opened) == sorted(closed)
    assert {"reducer", "Gearbox", "Lossy", "Example", "drag", "elasticTorque"} <= set(opened)
    for word in ("for", "while"):
        assert len(re.findall(rf"\bend {word};", text)) == len(re.findall(rf"^ *{word} ", text, re.MULTILINE))
    if (compiler := shutil.which("omc")) is not None:
        script = file.with_name("check.mos")
        script.write_text(
            'loadModel(Modelica); loadFile("reducer.mo"); checkModel(reducer.Example); getErrorString();'
        )
        ran = subprocess.run(
            [compiler, script.name], cwd=file.parent, capture_output=True, text=True, check=True
        )
        assert "completed successfully" in ran.stdout


def test_modelica_is_parsed(path: Path):
    parser = pytest.importorskip("pymoca.parser")
    read = parser.parse(written(path, "modelica").read_text(encoding="utf-8")).classes["reducer"]
    gearbox = read.classes["Gearbox"]
    assert {"flange_a", "flange_b", "heatPort", "J", "d", "backlash"} <= set(gearbox.symbols)
    # of as many unknowns as equations: seven of its own, one at every flange and at the port
    unknowns = [name for name, symbol in gearbox.symbols.items() if not symbol.prefixes]
    assert (
        len(gearbox.equations)
        == len([name for name in unknowns if "lange" not in name and name != "heatPort"]) + 3
    )


def test_modelica_runs_and_its_energy_balances(path: Path, losses: LossMap):
    """Work of the torques against heat, kinetic and elastic energy; the loss at the end from the map."""
    compiler = pytest.importorskip("rumoca")
    package = written(path, "modelica").read_text(encoding="utf-8")
    # the gear of the standard library and the example need more of it than is here
    package = re.sub(r"  model (Lossy|Example) .*?end \1;\n", "", package, flags=re.DOTALL)
    rig = path.with_name("rig") / "rig.mo"
    rig.parent.mkdir()  # it reads what else lies beside
    rig.write_text(CONNECTORS + package.replace("within ;", "") + RIG, encoding="utf-8")
    result = compiler.Session().load(str(rig), model="Rig").simulate(t=(0, 4.0), dt=0.01)
    of = dict(zip(result.names, np.asarray(result.to_numpy()), strict=True))
    speed, load = of["gearbox.w_a"], of["load.w"]
    work = 36.0 * of["gearbox.flange_a.phi"] + 300.0 * of["load.phi"]
    kinetic = 0.5 * loss_maps.INPUT_INERTIA * speed**2 + 0.5 * 20.0 * load**2
    twists, torques = (numbers_of(package, name) for name in ("twists", "twistTorques"))
    elastic = [np.trapezoid(*along(twists, torques, twist)) * np.sign(twist) for twist in of["gearbox.twist"]]
    stored = kinetic + np.array(elastic)
    assert np.allclose(work - of["oil.heat"] - (stored - stored[0]), 0.0, atol=1e-3 * work[-1])
    assert work[-1] > 500.0
    drag = losses.at(330.0, abs(of["gearbox.tau_b"][-1]), speed[-1])
    assert of["gearbox.tau_loss"][-1] == pytest.approx(drag, rel=1e-6)
    assert load[-1] == pytest.approx(RATIO * speed[-1], rel=0.01)


def along(twists: np.ndarray, torques: np.ndarray, twist: float) -> tuple[np.ndarray, np.ndarray]:
    """Torques and twists from 0 to a twist, whose last slope goes on."""
    slope = np.diff(torques)[[0, -1]] / np.diff(twists)[[0, -1]]
    far = np.array([-1.0, *twists, 1.0])
    over = [torques[0] + slope[0] * (-1.0 - twists[0]), *torques, torques[-1] + slope[1] * (1.0 - twists[-1])]
    inner = far[(far > min(0.0, twist)) & (far < max(0.0, twist))]
    points = np.array([min(0.0, twist), *inner, max(0.0, twist)])
    return np.interp(points, far, over), points


def numbers_of(text: str, name: str) -> np.ndarray:
    match = re.search(rf"{name}\[:\]=\{{(.*?)\}}", text)
    assert match
    return np.array([float(x) for x in match[1].split(",")])


def test_the_twist_of_modelica_has_backlash_and_stiffness(tmp_path: Path):
    """Against the integral of the compliance of the closed form, k = K (0.2 + 0.8 |T|/T0)."""
    torque = np.linspace(-400.0, 400.0, 401)
    path = loss_maps.write_map(
        tmp_path / "map.h5", changes={"torque": torque, "speed": np.array([0.0, 10.0])}
    )
    text = written(path, "modelica", torque="300 N*m").read_text(encoding="utf-8")
    twist, load = (numbers_of(text, name) for name in ("twists", "twistTorques"))
    exact = 400.0 / (0.8 * loss_maps.STIFFNESS) * np.log(5.0) + loss_maps.BACKLASH / 2
    assert twist[-1] == pytest.approx(exact, rel=1e-4)
    assert np.ptp(twist[load == 0.0]) == pytest.approx(loss_maps.BACKLASH)


def test_mujoco_turns_as_fast_as_the_friction_lets_it(path: Path):
    """A constant torque at the input: first acceleration and last speed."""
    mujoco = pytest.importorskip("mujoco")
    file = written(path, "mujoco", oil_temperature="300 K", torque="0 N*m")
    model = mujoco.MjModel.from_xml_path(str(file))
    data = mujoco.MjData(model)
    data.ctrl[0] = torque = 0.35
    model.opt.timestep = 1e-3
    for _ in range(20):
        mujoco.mj_step(model, data)
    at_output, inertia = torque / abs(RATIO), loss_maps.INPUT_INERTIA / RATIO**2
    still = loss_maps.STANDSTILL / abs(RATIO)
    assert abs(data.qvel[0]) == pytest.approx((at_output - still) / inertia * 0.02, rel=0.02)
    for _ in range(30000):
        mujoco.mj_step(model, data)
    # the input turns at the speed at which 0.3 + 0.002 |speed| is its torque, the other way round
    assert data.qvel[0] == pytest.approx(
        RATIO * (torque - loss_maps.STANDSTILL) / loss_maps.VISCOUS, rel=0.02
    )


def test_drake_reflects_the_inertia(path: Path):
    parsing = pytest.importorskip("pydrake.multibody.parsing")
    from pydrake.multibody.plant import MultibodyPlant  # pyright: ignore[reportMissingImports]

    plant = MultibodyPlant(0.0)
    parsing.Parser(plant).AddModels(str(written(path, "drake", torque="0 N*m", oil_temperature="300 K")))
    plant.WeldFrames(plant.world_frame(), plant.GetFrameByName("housing"))
    plant.Finalize()
    actuator = plant.GetJointActuatorByName("input")
    reflected = actuator.default_rotor_inertia() * actuator.default_gear_ratio() ** 2
    assert reflected == pytest.approx(loss_maps.INPUT_INERTIA / RATIO**2)
    damping = plant.GetJointByName("output").default_damping()
    assert damping == pytest.approx(loss_maps.VISCOUS / RATIO**2)


def test_a_urdf_is_read_by_another_program_too(path: Path):
    mujoco = pytest.importorskip("mujoco")
    file = written(path, "drake", torque="0 N*m", oil_temperature="300 K")
    # MuJoCo knows no tags of others
    text = re.sub(r"<drake:[^>]*/>", "", file.read_text(encoding="utf-8"))
    model = mujoco.MjModel.from_xml_string(text)
    assert model.dof_damping[0] == pytest.approx(loss_maps.VISCOUS / RATIO**2)
    assert model.dof_frictionloss[0] == pytest.approx(loss_maps.STANDSTILL / abs(RATIO))


def test_friction_of_a_joint_does_not_depend_on_how_dense_the_map_is(tmp_path: Path):
    """The least error over the range: of a fine even map by a fit of another kind, and of a dense corner."""

    def joint_of(torque: np.ndarray, speed: np.ndarray) -> tuple[float, float]:
        path = loss_maps.write_map(tmp_path / "map.h5", changes={"torque": torque, "speed": speed})
        joint = next(ET.parse(written(path, "mujoco")).iter("joint")).attrib
        return float(joint["damping"]), float(joint["frictionloss"])

    torque, speed = np.linspace(0.0, 400.0, 201), np.linspace(0.0, 200.0, 201)
    drag = loss_maps.mesh_drag(340.0, torque[:, None], speed) + loss_maps.seal_drag(
        340.0, torque[:, None], speed
    )
    fitted = np.polyfit(np.tile(speed * abs(RATIO), 201), drag.ravel() / abs(RATIO), 1)
    assert joint_of(torque, speed) == pytest.approx(tuple(fitted), rel=2e-3)
    crowded = np.concatenate([np.linspace(0.0, 20.0, 100), torque[11:]])
    assert joint_of(crowded, speed) == pytest.approx(tuple(fitted), rel=2e-3)


@pytest.mark.parametrize("ratio", [-0.1, 12.0])
def test_openfast_is_driven_by_its_slow_shaft(ratio: float, tmp_path: Path):
    def lost(temperature: Any, torque: Any, speed: Any) -> Any:
        return SHARE * abs(ratio * torque) + 0.0 * (speed + temperature)

    path = loss_maps.write_map(tmp_path / "map.h5", {MESH: lost}, {"ratio": ratio, "inertia_input": 3.0})
    lines = written(path, "openfast").read_text(encoding="utf-8").splitlines()
    values = {line.split()[1]: float(line.split()[0]) for line in lines if line[0] not in "!-"}
    forward = 1 / (1 + SHARE)
    assert values["GBoxEff"] == pytest.approx(100 * (forward if ratio > 1 else 2 - 1 / forward), rel=1e-5)
    assert values["GBRatio"] == pytest.approx(max(abs(ratio), 1 / abs(ratio)))
    # at the rotor: with the other end held, the same energy
    at_rotor = loss_maps.STIFFNESS * (ratio**2 if ratio > 1 else 1.0)
    assert values["DTTorSpr"] == pytest.approx(at_rotor)
    turning = 3.0 if ratio > 1 else 3.0 / ratio**2
    assert values["DTTorDmp"] == pytest.approx(2 * 0.07 * np.sqrt(at_rotor * turning), rel=1e-5)


def test_a_gearbox_that_locks_itself(tmp_path: Path):
    """Its map says so; who cannot hold it refuses it, or leaves that part out."""

    def much(temperature: Any, torque: Any, speed: Any) -> Any:
        return 1.2 * abs(RATIO * torque) + 0.0 * (speed + temperature)

    path = loss_maps.write_map(tmp_path / "map.h5", {MESH: much})
    assert "locks itself" in complaint("export", path, "--to", "openfast", folder=tmp_path)
    module: dict[str, Any] = {}
    exec(written(path, "python").read_text(encoding="utf-8"), module)
    assert module["efficiency"](-100.0, 50.0, 340.0) == pytest.approx(-0.2)
    assert module["torque_at_input"](-100.0, 50.0, 340.0) > 0.0
    done = td.export(path, "modelica", tmp_path / "reducer")
    assert "model Lossy" not in done.files[0].read_text(encoding="utf-8")
    assert any("LossyGear cannot hold" in remark for remark in done.remarks)


def test_what_a_target_needs_and_the_map_lacks_is_named(tmp_path: Path):
    def refused(to: str, changes: dict[str, Any], *words: str) -> str:
        path = loss_maps.write_map(tmp_path / "map.h5", changes=changes)
        return complaint("export", path, "--to", to, *words, folder=tmp_path)

    assert "no inertia" in refused("mujoco", {"inertia_input": np.nan})
    assert "no damping ratio" in refused("openfast", {"scenario": 'title = "map"\n'})
    assert "no nominal torque" in refused("modelica", {"nominal_torque": np.nan})
    assert "300 to 380" in refused("mujoco", {}, "--set", "oil_temperature=20 degC")
    assert "unit" in refused("mujoco", {}, "--set", "oil_temperature=60")
    assert "is no number" in refused("openfast", {}, "--set", "damping_ratio=much")
    assert "slow end, drives" in refused("openfast", {"torque": np.array([0.0, 400.0])})
