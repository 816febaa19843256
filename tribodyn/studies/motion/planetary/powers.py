"""Powers in a train with planetary sets by Willis, with the losses that its meshes have in slow rotation."""

from collections.abc import Sequence
from typing import Any

from tribodyn.cases.results import TextTable
from tribodyn.gears.tabulated import quasi_static_loss
from tribodyn.studies.motion.assembly import PreparedGearbox
from tribodyn.studies.motion.case import Gearbox
from tribodyn.studies.motion.drivetrain.mesh_groups import alike_of, together
from tribodyn.train.planetary import CARRIER
from tribodyn.train.power_flow import LossyMesh, PowerFlow, power_flow
from tribodyn.train.structure import TURN
from tribodyn.train.willis import Equation, of_coupling, of_speed

#: Share of the power in by which a branch must exceed it to circulate.
_ROUNDING = 1e-6
#: What is said of a train that no torque of its input turns.
LOCKS = (
    "the losses of its meshes lock the train: in slow rotation no torque of the input turns the loads, "
    "let power enter at another member"
)


def flow_of(prepared: PreparedGearbox) -> PowerFlow | None:
    """Power flow at the nominal duty; None: no torque of the input turns the loads."""
    case, speeds = prepared.case, speeds_of(prepared.case)
    return power_flow(_meshes(prepared), rows_of(case), speeds, loads_of(case, speeds))


def loads_of(case: Gearbox, speeds: Sequence[float]) -> dict[int, float]:
    """The constant loads by body, N m, counter-clockwise."""
    loads: dict[int, float] = {}
    for load in case.loads:
        along = 1.0 if speeds[load.body] > 0.0 else -1.0
        loads[load.body] = loads.get(load.body, 0.0) - along * load.torque
    return loads


def rows_of(case: Gearbox) -> list[Equation]:
    """Couplings, the source and what is held, as `power_flow` takes them; clutches are closed."""
    joined = [link.ends for link in case.links if link.stiffness[TURN] > 0.0]
    joined += [clutch.ends for clutch in case.clutches]
    rows = [of_coupling(one, two) for one, two in joined if two >= 0]
    return [*rows, of_speed(case.source.body), *(of_speed(link.ends[0]) for link in case.links if link.holds)]


def speeds_of(case: Gearbox) -> list[float]:
    """Nominal speeds of the case's bodies, counter-clockwise, rad/s."""
    reference = case.source.speed / float(case.bodies[case.source.body].ratio)
    return [float(body.ratio) * body.sense * reference for body in case.bodies]


def _meshes(prepared: PreparedGearbox) -> list[LossyMesh]:
    case, shares, meshes = prepared.case, dict[tuple[int, float, float], float](), []
    for mesh, pair, tabulated in zip(case.meshes, prepared.warm_pairs, prepared.tables, strict=True):
        duty, ratio = pair.operating, float(tabulated.cycle.speed_ratio)
        key = id(tabulated), duty.pinion_speed, duty.gear_torque
        if key not in shares:
            lost, given = quasi_static_loss(tabulated)(pair), duty.gear_torque * ratio * duty.pinion_speed
            entering = given + lost if given > 0.0 else -given
            shares[key] = lost / entering if given else 0.0
        one, two = (case.gears[gear].teeth for gear in mesh.gears)
        meshes.append(LossyMesh(mesh.driver, mesh.driven, (one, two), mesh.carrier, shares[key]))
    return meshes


def power_data(prepared: PreparedGearbox, flow: PowerFlow | None) -> dict[str, Any]:
    """For programs: powers (W) of every mesh; torques (N m, counter-clockwise) and powers into every set.

    Nothing of a train without power.
    """
    case, speeds = prepared.case, speeds_of(prepared.case)
    if flow is None or not flow.put_in:
        return {}
    meshes = {
        mesh.name: {"rolling_power": abs(rolling), "loss": loss}
        for mesh, rolling, loss in zip(case.meshes, flow.rolling, flow.loss, strict=True)
    }
    members = {}
    for gearset in case.sets:
        carrier = gearset.members[CARRIER]
        torques = dict.fromkeys(gearset.members.values(), 0.0)
        for mesh, on in zip(case.meshes, flow.on, strict=True):
            if mesh.carrier == carrier:
                for body, torque in zip((mesh.driver, mesh.driven, carrier), on, strict=True):
                    torques[body] = torques.get(body, 0.0) - torque
        members[gearset.name] = {
            name: {"torque": torques[body] + 0.0, "power": torques[body] * speeds[body] + 0.0}
            for name, body in gearset.members.items()
        }
    totals = {"put_in": flow.put_in, "taken_out": flow.taken_out, "efficiency": flow.efficiency}
    return {"power_flow": {**totals, "meshes": meshes, "members": members}}


def power_table(prepared: PreparedGearbox, powers: dict[str, Any]) -> tuple[list[TextTable], list[str]]:
    """Powers in a table, and whether some goes round in a circle; nothing where `power_data` has nothing."""
    if not powers:
        return [], []
    of, rows, circling = powers["power_flow"], [], []
    put_in, names = of["put_in"], dict[str, list[str]]()
    rows += [("in", "", f"{put_in:.5g}", "100", ""), ("out", "", *_cells(of["taken_out"], put_in), "")]
    for mesh, alike in zip(prepared.case.meshes, alike_of(prepared.case), strict=True):
        names.setdefault(alike or mesh.name, []).append(mesh.name)
    for each in names.values():
        power, loss = (sum(of["meshes"][name][key] for name in each) for key in ("rolling_power", "loss"))
        rows.append((f"rolls in {together(each)}", "", *_cells(power, put_in), f"{loss:.4g}"))
        if power > put_in * (1.0 + _ROUNDING):
            circling.append((power, f"the rolling power of {together(each)}"))
    for name, members in of["members"].items():
        for member, values in members.items():
            torque, power = values["torque"], values["power"]
            where = f"into {name} at the {member.replace('_', ' ')}"
            rows.append((where, f"{torque:.5g}", *_cells(power, put_in), ""))
            if abs(power) > put_in * (1.0 + _ROUNDING):
                circling.append((abs(power), f"the power at the {member} of {name}"))
    title = f"Power flow by Willis, with losses in slow rotation: efficiency {100.0 * of['efficiency']:.3f} %"
    remarks = [
        f"Power circulates: {what} is {power / put_in:.3g} times the power in." for power, what in circling
    ]
    return [
        TextTable(title, ("where", "torque (N m)", "power (W)", "of the power in (%)", "loss (W)"), rows)
    ], remarks


def _cells(power: float, put_in: float) -> tuple[str, str]:
    return f"{power:.5g}", f"{100.0 * power / put_in:.4g}"
