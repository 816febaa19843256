"""A train that is no train, or whose scenario contradicts itself: one message with the place and the rule."""

from copy import deepcopy
from pathlib import Path

import pytest
import tomli_w

from tests.support.train_changes import BARE_MESH, Change, bare, drop, put
from tests.support.train_scenarios import REDUCER, train_case
from tribodyn.errors import InputErrors

GEAR = {"teeth": 31, "face_width": "40 mm"}
STAGE = {"module": "4 mm", "pressure_angle": "20 deg"}


#: What is changed; where the message says it stands, and words of its rule.
REFUSED: dict[str, tuple[list[Change], str, str]] = {
    "a gear without mesh": ([put("gear.spare", GEAR)], "gear.spare", "meshes with no other gear"),
    "two inputs": (
        [put("operating.input", ["pinion-1", "wheel-2"])],
        "operating.input",
        "a train has one input; name one",
    ),
    "a loop whose ratios contradict": (
        [
            put("gear.idler", GEAR),
            put("stage.+", {"gears": ["wheel-1", "idler"], **STAGE, "module": "3 mm"}),
            put("stage.+", {"gears": ["idler", "wheel-2"], **STAGE}),
        ],
        "stage.3",
        "turn the same way",
    ),
    "two ways of unequal ratio": (
        [
            put("gear.x", GEAR),
            put("gear.y", GEAR | {"teeth": 32}),
            put("stage.+", {"gears": ["pinion-1", "x"], **STAGE, "module": "3 mm"}),
            put("stage.+", {"gears": ["y", "wheel-2"], **STAGE}),
            put("shaft.+", {"name": "second", "gears": ["x", "y"]}),
        ],
        "stage.3",
        "ratios contradict each other: by this mesh wheel-2 turns at 736/1767 of the input's speed",
    ),
    "a body without inertia": (
        [put("body", [{"name": "flywheel", "mass": "3 kg"}])],
        "body.0.inertia",
        "missing; add inertia",
    ),
    "a shaft without gears": ([put("shaft.+", {"name": "third"})], "shaft.1.gears", "add gears = a list"),
    "a sensor of no kind": (
        [put("sensor", [{"name": "A", "rate": "20 kHz"}])],
        "sensor.0.kind",
        'add kind = one of "acceleration", "force"',
    ),
    "a body with none": (
        [put("body", [{"name": "flywheel", "mass": "3 kg", "inertia": "0 kg*m**2"}])],
        "body.0.inertia",
        "must be greater than zero",
    ),
    "a body that nothing turns": (
        [put("body", [{"name": "flywheel", "mass": "3 kg", "inertia": "1 kg*m**2"}])],
        "body.0",
        "not connected to the input",
    ),
    "colliding tip circles": (
        [
            put("gear.third", GEAR | {"teeth": 57}),
            put("stage.+", {"gears": ["pinion-2", "third"], **STAGE, "azimuth": "60 deg"}),
            put("load", [{"at": "third", "torque": "10 N*m"}]),
        ],
        "gear.third",
        "its tip circle overlaps that of wheel-2 by",
    ),
    "gears that mesh in two planes": (
        [put("gear.pinion-1.plane", 1), put("gear.wheel-1.plane", 2)],
        "gear.wheel-1.plane",
        "gears that mesh stand in one plane",
    ),
    "gears of one shaft in one plane": (
        [put("gear.pinion-1.plane", 1), put("gear.wheel-2.plane", 1)],
        "gear.pinion-2",
        "its tip circle overlaps that of wheel-1",
    ),
    "no stage": ([put("gear", {}), put("stage", []), put("shaft", [])], "stage", "missing"),
    "a stage of unknown gears": (
        [put("stage.0.gears.1", "wheel1")],
        "stage.0.gears.1",
        'no such gear; did you mean "wheel-1"',
    ),
    "a stage of one gear": ([put("stage.0.gears", ["wheel-1"])], "stage.0.gears", "fewer than 2 values"),
    "a stage of a gear with itself": (
        [put("stage.0.gears", ["wheel-1", "wheel-1"])],
        "stage.0.gears",
        "names wheel-1 twice",
    ),
    "a stage of gears that turn together": (
        [put("stage.+", {"gears": ["wheel-1", "pinion-2"], **STAGE})],
        "stage.2",
        "turn together and cannot mesh",
    ),
    "an idler with two shapes of teeth": (
        [
            put("gear.third", GEAR),
            put("stage.+", {"gears": ["wheel-2", "third"], "module": "4 mm", "pressure_angle": "25 deg"}),
            put("load", [{"at": "third", "torque": "10 N*m"}]),
        ],
        "gear.wheel-2",
        "its 57 teeth differ by",
    ),
    "an output that is none": ([drop("operating.output")], "operating.output", "missing; name a gear"),
    "no input": ([drop("operating.input")], "operating.input", "missing; name a gear"),
    "no speed": ([drop("operating.input_speed")], "operating.input_speed", "missing: the speed"),
    "no load": ([drop("operating.output_torque")], "operating.output_torque", "missing: the load"),
    "two loads": ([put("operating.power", "30 kW")], "operating.power", "gives the load, as output_torque"),
    "two speeds": ([put("operating.output_speed", "30 rpm")], "operating.output_speed", "gives the speed"),
    "an output at the input": ([put("operating.output", "pinion-1")], "operating.output", "is the input too"),
    "the train driven backwards": (
        [put("operating.output_torque", "-10 N*m")],
        "stage.0",
        "must be greater than zero: without backlash",
    ),
    "a stage without load": (
        [
            put("gear.third", GEAR),
            put("stage.+", {"gears": ["wheel-2", "third"], **STAGE}),
        ],
        "stage.2",
        "= 0 N*m: must be greater than zero",
    ),
    "a motor of a prescribed speed": (
        [put("operating.drive_inertia", "1 kg*m**2")],
        "operating.drive_inertia",
        "a prescribed rotation needs no motor",
    ),
    "two parts of one name": ([put("shaft.0.name", "wheel-1")], "shaft.0.name", "names two parts"),
    "the housing as a body": ([put("shaft.0.name", "ground")], "shaft.0.name", "has a meaning of its own"),
    "three gears on a compliant shaft": (
        [
            put("shaft.0.gears", ["wheel-1", "pinion-2", "wheel-2"]),
            put("shaft.0.stiffness", "1e5 N*m/rad"),
        ],
        "shaft.0.gears",
        "a compliant shaft has two gears",
    ),
    "a rigid shaft with damping": (
        [put("shaft.0.damping_ratio", 0.1)],
        "shaft.0.damping_ratio",
        "rigid shaft",
    ),
    "a mesh written twice": (
        [put("stage.+", {"name": "third", "gears": ["wheel-2", "pinion-2"], **STAGE, "azimuth": "-30 deg"})],
        "stage.2",
        "its gears mesh in stage.1 already",
    ),
    "two meshes of one name": (
        [put("stage.0.name", "one"), put("stage.1.name", "one")],
        "stage.1.name",
        "names two meshes, that of stage.0 too",
    ),
    "damage of teeth that cannot be made": (
        [
            put("gear.pinion-2.bore_diameter", "100 mm"),
            put("damage", [{"gear": "pinion-2", "tooth": 2, "kind": "crack", "depth": "2 mm"}]),
        ],
        "gear.pinion-2.bore_radius",
        "the bore reaches the root circle",
    ),
    "a gear on two rigid shafts": (
        [put("shaft.+", {"name": "other", "gears": ["wheel-1", "wheel-2"]})],
        "shaft.1.gears",
        "turns with the shaft middle already",
    ),
    "a compliant shaft within a rigid one": (
        [put("shaft.+", {"name": "o", "gears": ["wheel-1", "pinion-2"], "stiffness": "1e5 N*m/rad"})],
        "shaft.1.stiffness",
        "turn together with the rigid shaft middle",
    ),
    "a compliant shaft as the output": (
        [put("shaft.0.stiffness", "1e5 N*m/rad"), put("operating.output", "middle")],
        "operating.output",
        "has a body at either end; name one that it carries: wheel-1, pinion-2",
    ),
    "a link without stiffness": ([put("link", [{"ends": ["wheel-1", "wheel-2"]}])], "link.0", "neither"),
    "a link of one body": (
        [put("link", [{"ends": ["wheel-1", "pinion-2"], "stiffness": "1 N*m/rad"}])],
        "link.0.ends",
        "are one body, the shaft middle",
    ),
    "a link that holds a rotation": (
        [put("link", [{"ends": ["wheel-1", "ground"], "stiffness": "1 N*m/rad"}])],
        "link.0.stiffness",
        "is not held in rotation",
    ),
    "a link of bodies of unequal speed": (
        [put("link", [{"ends": ["wheel-1", "wheel-2"], "stiffness": "1 N*m/rad"}])],
        "stage.1",
        "closes a loop in which middle and wheel-2 turn the same way",
    ),
    "a bearing of nothing": (
        [
            put(
                "bearings",
                {"wheel": {"stiffness_x": "1e9 N/m", "stiffness_y": "1e9 N/m", "damping_ratio": 0.1}},
            )
        ],
        "bearings.wheel",
        "no such gear, shaft or body",
    ),
    "a bearing without stiffness": (
        [put("bearings", {"default": {"stiffness_x": "1e9 N/m", "damping_ratio": 0.1}})],
        "bearings.default.stiffness_y",
        "missing",
    ),
    "an unknown key of a gear": (
        [put("gear.wheel-1.teath", 3)],
        "gear.wheel-1.teath",
        'unknown key; did you mean "teeth"',
    ),
    "an unknown key of a stage": (
        [put("stage.1.modul", "3 mm")],
        "stage.1.modul",
        'unknown key; did you mean "module"',
    ),
    "an unknown table": ([put("stages", [])], "stages", 'unknown key; did you mean "stage"'),
    "an unknown key of a bearing": (
        [put("bearings", {"default": {"stiffness": "1e9 N/m"}})],
        "bearings.default.stiffness",
        'unknown key; did you mean "stiffness_',
    ),
    "teeth that cannot be made": (
        [put("gear.pinion-2.profile_shift", 1.4)],
        "gear.pinion-2.profile_shift",
        "the tip is pointed",
    ),
    "teeth of a stage that cannot mesh": (
        [put("stage.0.centre_distance", "100 mm")],
        "stage.0.centre_distance",
        "",
    ),
    "a gear without material": ([drop("material")], "material", "missing"),
    "flanks without roughness": ([drop("mean_roughness")], "mean_roughness", "missing"),
    "an unknown material": (
        [put("gear.wheel-1.material", "steal")],
        "gear.wheel-1.material",
        "no such",
    ),
    "an unknown family": ([put("stage.0.family", "involut")], "stage.0.family", 'did you mean "involute"'),
    "a drive beside stages": ([put("drive", "spur-25-51")], "gear", "contradicts drive"),
    "stages beside a bare model": ([put("mesh", [BARE_MESH])], "gear", "a bare model"),
    "a bare mesh without stiffness": ([bare(stiffness=None)], "mesh.0.stiffness", "missing; add stiffness"),
    "a bare mesh of unknown bodies": (
        [bare(bodies=["a", "c"])],
        "mesh.0.bodies.1",
        "no such body",
    ),
    "a bare mesh without teeth": ([bare(teeth=None)], "mesh.0.teeth", "missing"),
}


@pytest.mark.parametrize("name", REFUSED)
def test_refused(name: str, tmp_path: Path):
    changes, key, rule = REFUSED[name]
    data = deepcopy(REDUCER)
    for change in changes:
        change(data)
    path = tmp_path / "train.toml"
    path.write_text(tomli_w.dumps(data), encoding="utf-8")
    with pytest.raises(InputErrors) as caught:
        train_case(path)
    (line,) = str(caught.value).splitlines()
    assert line.startswith(f"{path}: {key}")
    assert rule in line
    (error,) = caught.value.errors
    assert error.key == key
    assert error.remedy


def test_a_bare_model_is_taken(tmp_path: Path):
    data = deepcopy(REDUCER)
    bare()(data)
    path = tmp_path / "train.toml"
    path.write_text(tomli_w.dumps(data), encoding="utf-8")
    assert len(train_case(path).meshes) == 1
