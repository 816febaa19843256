"""Records over time of the studies of gear pairs."""

from tribodyn.dynamics.recorded import DOF_SCALE, PAIR, SAMPLES
from tribodyn.geometry.sheet.outlines import GEOMETRY
from tribodyn.mesh.cycle import MESH_CYCLE
from tribodyn.record.schema import TIME, Layout

LAYOUT = Layout(
    TIME, SAMPLES, {"pair": PAIR, "dof": DOF_SCALE}, groups={"mesh_cycle": MESH_CYCLE, "geometry": GEOMETRY}
)
