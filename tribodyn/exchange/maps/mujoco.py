"""A gearbox as MuJoCo has one: a joint with armature, damping and frictionloss, and a motor with a gear.

The joint is the output. MuJoCo Documentation, XML Reference: joint/armature, inertia that is added to the
joint; joint/damping; joint/frictionloss, dry friction; general/gear, by which the motor's torque is scaled.
"""

import xml.etree.ElementTree as ET
from collections.abc import Mapping

from tribodyn.exchange.format import MAP, ExchangeFormat, Exported, Written
from tribodyn.exchange.heading import heading, without_double_hyphens
from tribodyn.exchange.maps.chosen import inertia
from tribodyn.exchange.maps.friction import FRICTION_CHOICES, JointFriction, fitted_friction


def write(exported: Exported, name: str, choices: Mapping[str, float]) -> Written:
    """A model of one joint, to be included or copied from; its numbers are read back and compared."""
    losses, friction = exported.losses, fitted_friction(exported, choices)
    model = ET.Element("mujoco", model=name)
    body = ET.SubElement(ET.SubElement(model, "worldbody"), "body", name="output")
    # the least that MuJoCo takes; what turns is the joint's armature
    ET.SubElement(body, "inertial", pos="0 0 0", mass="1e-6", diaginertia="1e-12 1e-12 1e-12")
    ET.SubElement(
        body,
        "joint",
        name="output",
        type="hinge",
        axis="0 0 1",
        armature=f"{inertia(exported) / losses.ratio**2:.9g}",
        damping=f"{friction.viscous:.9g}",
        frictionloss=f"{friction.coulomb:.9g}",
    )
    actuator = ET.SubElement(model, "actuator")
    ET.SubElement(actuator, "motor", name="input", joint="output", gear=f"{1 / losses.ratio:.9g}")
    ET.indent(model)
    text = ET.tostring(model, encoding="unicode")
    joint = next(ET.fromstring(text).iter("joint")).attrib
    found = JointFriction(float(joint["frictionloss"]), float(joint["damping"]), friction.remarks)
    deviations = found.deviations(exported, choices)
    remarks = (*friction.remarks, "stiffness, backlash and transmission error are not in it")
    comment = without_double_hyphens(heading(exported, "", deviations, remarks))
    return Written({".xml": f"<!--\n{comment}-->\n{text}\n"}, deviations, remarks)


FORMAT = ExchangeFormat(
    "mujoco",
    "MuJoCo's joint and motor: gear, armature, damping, frictionloss, fitted to the losses",
    (".xml",),
    takes=(MAP,),
    write=write,
    choices=FRICTION_CHOICES,
)
