"""Gears, shafts and trains in space as glTF 2.0 in one binary file (Khronos, glTF 2.0; ISO/IEC 12113).

A header of 12 bytes, then the chunks JSON and BIN, each with its length and name in front, little-endian and
filled up to four bytes. A node for every part, by its name; equal parts share a mesh. Metres, y upwards, z
along the shafts: the axes of a train as they are. What turns says so in its `extras`, for viewers that ask.
"""

import json
import math
import struct
from collections.abc import Mapping
from typing import Any

import numpy as np

from tribodyn import __version__
from tribodyn.drawing.shapes import GearShape, PlacedPart
from tribodyn.drawing.surface import Surface, one_tooth, surface_of
from tribodyn.exchange.cad.chosen import CHOICES, chosen_parts, listed, tolerance_of
from tribodyn.exchange.format import SCENARIO, ExchangeFormat, Exported, Written
from tribodyn.numerics.shapes import Array

#: Distance of triangles from the exact surfaces unless it is set, m.
_TOLERANCE = 5e-6
_MAGIC, _VERSION, _JSON, _BIN = b"glTF", 2, b"JSON", b"BIN\0"
_ARRAY_BUFFER, _ELEMENT_ARRAY_BUFFER = 34962, 34963
_FLOAT, _UNSIGNED_INT = 5126, 5125
#: Colours of parts as drawings have them, linear.
_COLORS = {
    "pinion": (0.19, 0.46, 0.73),
    "gear": (0.81, 0.4, 0.19),
    "ring": (0.39, 0.43, 0.49),
    "shaft": (0.6, 0.62, 0.65),
    "bearing": (0.36, 0.5, 0.2),
}


def write(exported: Exported, name: str, choices: Mapping[str, Any]) -> Written:
    """The parts of a scenario."""
    tolerance = tolerance_of(choices, _TOLERANCE)
    parts = chosen_parts(exported, choices, tolerance)
    content, triangles = binary(parts, exported.path.stem)
    remarks = listed(parts), f"{triangles} triangles within {1e6 * tolerance:g} um of the exact surfaces"
    return Written({".glb": content}, remarks=remarks)


def binary(parts: list[PlacedPart], title: str, *, by_tooth: bool = False) -> tuple[bytes, int]:
    """A file of parts, and the number of its triangles; `by_tooth`: a gear is one tooth, used many times."""
    data: dict[str, list[Any]] = {name: [] for name in ("bufferViews", "accessors", "meshes")}
    blocks, fills, meshes, nodes, count = list[bytes](), list[str](), dict[tuple[int, str], int](), [], 0

    def accessor(values: Array, kind: str, target: int) -> int:
        component = _UNSIGNED_INT if kind == "SCALAR" else _FLOAT
        view = {"buffer": 0, "byteOffset": sum(map(len, blocks)), "byteLength": values.nbytes}
        data["bufferViews"].append(view | {"target": target})
        blocks.append(values.tobytes())
        read = {"bufferView": len(blocks) - 1, "componentType": component, "count": len(values), "type": kind}
        rows = values.reshape(len(values), -1)
        limits = {"min": rows.min(axis=0).tolist(), "max": rows.max(axis=0).tolist()}
        data["accessors"].append(read | limits)
        return len(blocks) - 1

    def mesh_of(part: PlacedPart, surface: Surface) -> int:
        triangles = accessor(surface.triangle.astype("<u4").ravel(), "SCALAR", _ELEMENT_ARRAY_BUFFER)
        attributes = {
            which: accessor(values.astype("<f4"), "VEC3", _ARRAY_BUFFER)
            for which, values in (("POSITION", surface.point), ("NORMAL", surface.normal))
        }
        if part.fill not in fills:
            fills.append(part.fill)
        primitive = {"attributes": attributes, "indices": triangles, "material": fills.index(part.fill)}
        data["meshes"].append({"name": part.name, "primitives": [primitive]})
        return len(data["meshes"]) - 1

    teeth = list[dict[str, Any]]()
    for part in parts:
        shape, key = part.shape, (id(part.shape), part.fill)
        gear = shape if isinstance(shape, GearShape) else None
        if key not in meshes:
            meshes[key] = mesh_of(part, one_tooth(gear) if by_tooth and gear else surface_of(shape))
        node: dict[str, Any] = {"name": part.name, "translation": [*map(float, part.centre)]}
        node |= _turned(part.angle)
        node["extras"] = {"turns": part.turns, "orbits": part.orbits, "axis": [*map(float, part.axis)]}
        if gear:
            node["extras"]["teeth"] = gear.teeth
        repeated = gear.teeth if by_tooth and gear else 1
        if by_tooth and gear:
            node["children"] = [len(parts) + len(teeth) + tooth for tooth in range(repeated)]
            teeth += [_turned(2.0 * np.pi * k / repeated) | {"mesh": meshes[key]} for k in range(repeated)]
        else:
            node["mesh"] = meshes[key]
        primitive = data["meshes"][meshes[key]]["primitives"][0]
        count += repeated * data["accessors"][primitive["indices"]]["count"] // 3
        nodes.append(node)
    asset = {"version": "2.0", "generator": f"written by tribodyn {__version__}"}
    materials = [
        {
            "name": fill,
            "pbrMetallicRoughness": {
                "baseColorFactor": [*_COLORS[fill], 1.0],
                "metallicFactor": 0.3,
                "roughnessFactor": 0.5,
            },
        }
        for fill in fills
    ]
    whole = {
        "asset": asset,
        "scene": 0,
        "scenes": [{"name": title, "nodes": list(range(len(nodes)))}],
        "nodes": nodes + teeth,
        "materials": materials,
        **data,
        "buffers": [{"byteLength": sum(map(len, blocks))}],
    }
    text = json.dumps(whole, ensure_ascii=False, separators=(",", ":")).encode()
    chunks = _chunk(_JSON, text, b" ") + _chunk(_BIN, b"".join(blocks), b"\0")
    return struct.pack("<4sII", _MAGIC, _VERSION, 12 + len(chunks)) + chunks, count


def _turned(angle: float) -> dict[str, Any]:
    """A rotation about z, rad."""
    return {"rotation": [0.0, 0.0, round(math.sin(angle / 2.0), 15), round(math.cos(angle / 2.0), 15)]}


def _chunk(name: bytes, content: bytes, fill: bytes) -> bytes:
    content += fill * (-len(content) % 4)
    return struct.pack("<I4s", len(content), name) + content


FORMAT = ExchangeFormat(
    "gltf",
    "gears, shafts and trains in space, triangles for viewers and printers (glTF 2.0, binary)",
    (".glb",),
    (SCENARIO,),
    write=write,
    choices=CHOICES,
)
