"""An involute pair of 20° by its printed data: its path of contact, and what an efficiency study gives."""

import math
from collections.abc import Mapping
from typing import Any, NamedTuple

from tribodyn.geometry.drive import SIDES
from tribodyn.standards.contact_path import ContactPath, transverse_angle
from tribodyn.studies.efficiency.run import quantities_of
from tribodyn.studies.protocol.load import load_data

_NORMAL = math.radians(20.0)


class PrintedPair(NamedTuple):
    """Lengths in mm, angles in degrees, Ra in µm; of a ring teeth, tip radius and axes are negative."""

    module: float
    teeth: tuple[float, float]
    shifts: tuple[float, float]
    axes: float
    tips: tuple[float, float]
    width: float
    roughness: float
    helix: float = 0.0

    def path(self) -> ContactPath:
        """Path of contact."""
        beta = math.radians(self.helix)
        angle = transverse_angle(_NORMAL, beta)
        transverse = self.module / math.cos(beta)
        bases = [count * transverse * math.cos(angle) / 2.0 for count in self.teeth]
        return ContactPath(
            self.teeth,
            (bases[0] * 1e-3, bases[1] * 1e-3),
            (self.tips[0] * 1e-3, self.tips[1] * 1e-3),
            math.acos(sum(bases) / self.axes),
            math.asin(math.sin(beta) * math.cos(_NORMAL)),
            self.width * math.tan(beta) / (math.pi * transverse),
        )

    def study(
        self, lubricant: Mapping[str, Any], temperature: float, torque: float, speed: float
    ) -> dict[str, Any]:
        """Quantities of an efficiency study at a pinion torque, N m, and speed, 1/min; oil's temperature, °C.

        Loads are those of elastic teeth, the law is the nearest to the contact solved at this duty.
        """
        sides: dict[str, dict[str, Any]] = {
            side: {
                "teeth": int(abs(count)),
                "face_width": f"{self.width} mm",
                "profile_shift": shift,
                "tip_diameter": f"{2.0 * abs(tip)} mm",
                "thickness_allowance": f"{-0.01 * self.module} mm",
            }
            for side, count, shift, tip in zip(SIDES, self.teeth, self.shifts, self.tips, strict=True)
        }
        for side, count, tip in zip(SIDES, self.teeth, self.tips, strict=True):
            bore = {"bore_radius": f"{0.35 * tip} mm"}
            ring = {"internal": True, "outer_diameter": f"{-2.4 * tip} mm", "cutter_teeth": 30}
            sides[side] |= bore if count > 0.0 else ring
        scenario = {
            "title": "printed pair",
            "kind": "efficiency",
            "drive": {
                "family": "involute",
                "module": f"{self.module} mm",
                "pressure_angle": "20 deg",
                "helix_angle": f"{self.helix} deg",
                "centre_distance": f"{abs(self.axes)} mm",
                "mean_roughness": f"{self.roughness} um",
                "material": {"like": "18CrNiMo7-6"},
                **sides,
            },
            "lubricant": dict(lubricant),
            "operating": {
                "gear_torque": f"{torque * abs(self.teeth[1]) / self.teeth[0]} N*m",
                "pinion_speed": f"{speed} rpm",
                "oil_temperature": f"{temperature} degC",
            },
            "friction": {"law": "auto"},
        }
        return quantities_of(load_data(scenario, "printed-pair").case)


def own_loss(found: Mapping[str, Any], unit: str, scale: float = 1.0) -> str:
    """Say what an efficiency study gives for a printed loss."""
    return (
        "with elastic teeth and the law nearest to the solved contact "
        f"({found['friction_law']}) {scale * found['power_friction_mean']:.3g} {unit}"
    )
