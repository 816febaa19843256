"""The gears of a gearbox as a measurement is set beside them."""

from tribodyn.errors import InputError
from tribodyn.gears.measured.mounted_gear import MeshingFlank, MountedGear, other_flank
from tribodyn.geometry.families import family
from tribodyn.mesh.teeth.fields import CARRYING
from tribodyn.studies.motion.assembly import assemblies
from tribodyn.studies.motion.case import Gearbox


def mounted_gears(case: Gearbox) -> dict[str, MountedGear]:
    """Gears by name; InputError where they are no involutes, or cannot be made."""
    pairs = assemblies(case)
    found: dict[str, MountedGear] = {}
    for gear in case.gears:
        flanks: dict[int, MeshingFlank] = {}
        for mesh, side in gear.meshes:
            flanks.setdefault(CARRYING[side], MeshingFlank(pairs[mesh], side, 1))
        carrying = tuple(sorted(flanks))
        first, side = gear.meshes[0]
        flanks.setdefault(other_flank(carrying[0]), MeshingFlank(pairs[first], side, -1))
        pair = case.meshes[first].pair
        if not family(pair.family).involute:
            rule = "measured flanks are read and written of involutes alone"
            raise InputError(f"{gear.key}: family", pair.family, rule, "name a pair of involutes")
        own = pair.teeth[0 if side == "pinion" else 1]
        edition = pair.quality.edition if pair.quality is not None else 2013
        sense = case.bodies[gear.body].sense
        found[gear.name] = MountedGear(gear.name, gear.key, sense, flanks, carrying, own, edition)
        found.setdefault(gear.key.rpartition(".")[2], found[gear.name])  # of planets, which are alike
    return found
