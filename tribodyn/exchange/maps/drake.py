"""A gearbox as Drake has one: a URDF with a joint's damping and friction, gear ratio and rotor inertia.

The joint is the output. Drake, "Parsing Models for Multibody Simulation": drake:gear_ratio and
drake:rotor_inertia, whose product rotor inertia × gear ratio² is reflected to the joint.
"""

import xml.etree.ElementTree as ET
from collections.abc import Mapping

from tribodyn.exchange.format import MAP, ExchangeFormat, Exported, Written
from tribodyn.exchange.heading import heading, without_double_hyphens
from tribodyn.exchange.maps.chosen import inertia
from tribodyn.exchange.maps.friction import FRICTION_CHOICES, JointFriction, fitted_friction

_NAMESPACE = "http://drake.mit.edu"


def write(exported: Exported, name: str, choices: Mapping[str, float]) -> Written:
    """A robot of one joint, to be copied from; its numbers are read back and compared."""
    losses, friction = exported.losses, fitted_friction(exported, choices)
    robot = ET.Element("robot", {"name": name, "xmlns:drake": _NAMESPACE})
    ET.SubElement(robot, "link", name="housing")
    inertial = ET.SubElement(ET.SubElement(robot, "link", name="load"), "inertial")
    ET.SubElement(inertial, "mass", value="1e-6")
    small = {
        axis: "1e-12" if axis[1] == axis[2] else "0" for axis in ("ixx", "ixy", "ixz", "iyy", "iyz", "izz")
    }
    ET.SubElement(inertial, "inertia", small)
    joint = ET.SubElement(robot, "joint", name="output", type="continuous")
    for tag, values in (
        ("parent", {"link": "housing"}),
        ("child", {"link": "load"}),
        ("axis", {"xyz": "0 0 1"}),
        ("dynamics", {"damping": f"{friction.viscous:.9g}", "friction": f"{friction.coulomb:.9g}"}),
    ):
        ET.SubElement(joint, tag, values)
    transmission = ET.SubElement(robot, "transmission")
    ET.SubElement(transmission, "type").text = "transmission_interface/SimpleTransmission"
    interface = ET.SubElement(ET.SubElement(transmission, "joint", name="output"), "hardwareInterface")
    interface.text = "EffortJointInterface"
    actuator = ET.SubElement(transmission, "actuator", name="input")
    ET.SubElement(actuator, "drake:gear_ratio", value=f"{1 / losses.ratio:.9g}")
    ET.SubElement(actuator, "drake:rotor_inertia", value=f"{inertia(exported):.9g}")
    ET.indent(robot)
    text = ET.tostring(robot, encoding="unicode")
    dynamics = next(ET.fromstring(text).iter("dynamics")).attrib
    found = JointFriction(float(dynamics["friction"]), float(dynamics["damping"]), friction.remarks)
    deviations = found.deviations(exported, choices)
    remarks = (
        *friction.remarks,
        "Drake takes damping and the reflected inertia; friction of URDF only where its version does",
        "stiffness, backlash and transmission error are not in it",
    )
    comment = without_double_hyphens(heading(exported, "", deviations, remarks))
    return Written({".urdf": f"<!--\n{comment}-->\n{text}\n"}, deviations, remarks)


FORMAT = ExchangeFormat(
    "drake",
    "URDF for Drake: damping, friction, gear ratio and reflected inertia, fitted to the losses",
    (".urdf",),
    takes=(MAP,),
    write=write,
    choices=FRICTION_CHOICES,
)
