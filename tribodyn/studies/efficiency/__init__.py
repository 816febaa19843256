"""Efficiency of a mesh over whole mesh cycles, by energy: input, output and friction work.

Three ways, for any family of teeth: from the record of a dynamic run (`dynamic`), quasi-static along the path
of contact with any friction law and load sharing (`along_path`), and by the torque ratio of a single pair
with unit contact ratio (`torque_ratio`). `loss_factor` has Höhn's formula and the integral behind it;
`given_coefficient` is differentiable in the drive.
"""

from tribodyn.studies.efficiency.given_coefficient import friction_loss, mean_efficiency

__all__ = ["friction_loss", "mean_efficiency"]
