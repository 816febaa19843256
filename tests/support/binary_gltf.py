"""A strict reader of glTF 2.0 in one binary file, from the specification; closed surfaces of triangles."""

import json
import struct
from collections import Counter
from pathlib import Path
from typing import NamedTuple

import numpy as np

_COMPONENTS = {5125: np.dtype("<u4"), 5126: np.dtype("<f4")}
_NUMBERS = {"SCALAR": 1, "VEC3": 3}


class Node(NamedTuple):
    """A part as the file has it."""

    mesh: int
    points: np.ndarray  # (n, 3), in its own frame
    normals: np.ndarray
    triangles: np.ndarray  # (m, 3)
    centre: np.ndarray
    angle: float  # about z

    @property
    def placed(self) -> np.ndarray:
        """Its points in the axes of the whole."""
        c, s = np.cos(self.angle), np.sin(self.angle)
        return self.points @ np.array([[c, s, 0.0], [-s, c, 0.0], [0.0, 0.0, 1.0]]) + self.centre


def read(path: Path) -> dict[str, Node]:
    """The parts of a file by their names; everything that the specification demands of it holds."""
    content = path.read_bytes()
    magic, version, length = struct.unpack_from("<4sII", content)
    assert (magic, version, length) == (b"glTF", 2, len(content))
    size, name = struct.unpack_from("<I4s", content, 12)
    assert name == b"JSON"
    assert size % 4 == 0
    whole = json.loads(content[20 : 20 + size])
    data_size, data_name = struct.unpack_from("<I4s", content, 20 + size)
    data = content[28 + size :]
    assert (data_name, data_size) == (b"BIN\0", len(data))
    assert whole["asset"]["version"] == "2.0"
    assert whole["buffers"] == [{"byteLength": len(data)}]

    def values(number: int) -> np.ndarray:
        accessor = whole["accessors"][number]
        view = whole["bufferViews"][accessor["bufferView"]]
        kind = _COMPONENTS[accessor["componentType"]]
        count = accessor["count"] * _NUMBERS[accessor["type"]]
        assert view["byteLength"] == count * kind.itemsize
        assert view["byteOffset"] % 4 == 0
        found = np.frombuffer(data, kind, count, view["byteOffset"]).reshape(accessor["count"], -1)
        assert found.min(axis=0).tolist() == accessor["min"]
        assert found.max(axis=0).tolist() == accessor["max"]
        return found

    nodes = {}
    for number in whole["scenes"][whole["scene"]]["nodes"]:
        node = whole["nodes"][number]
        (primitive,) = whole["meshes"][node["mesh"]]["primitives"]
        assert primitive["material"] < len(whole["materials"])
        points, normals = (values(primitive["attributes"][name]) for name in ("POSITION", "NORMAL"))
        triangles = values(primitive["indices"]).reshape(-1, 3)
        assert triangles.max() < len(points) == len(normals)
        assert np.allclose(np.linalg.norm(normals, axis=1), 1.0, atol=1e-6)
        x, y, sine, cosine = node["rotation"]
        assert x == y == 0.0
        angle = 2.0 * np.arctan2(sine, cosine)
        nodes[node["name"]] = Node(
            node["mesh"], points, normals, triangles, np.array(node["translation"]), angle
        )
    assert len(nodes) == len(whole["nodes"])
    return nodes


def volume_within(points: np.ndarray, triangles: np.ndarray) -> float:
    """Volume of a closed surface; every edge must be in two triangles, in opposite directions."""
    _, same = np.unique(points, axis=0, return_inverse=True)
    corners = same.ravel()[triangles]
    edges = np.concatenate([corners[:, [0, 1]], corners[:, [1, 2]], corners[:, [2, 0]]])
    directed = Counter((edges[:, 0] * len(points) + edges[:, 1]).tolist())
    assert set(directed.values()) == {1}
    assert directed.keys() == set((edges[:, 1] * len(points) + edges[:, 0]).tolist())
    one, two, three = np.moveaxis(points.astype(float)[triangles], 1, 0)
    return float(np.einsum("ni,ni->", one, np.cross(two, three)) / 6.0)
