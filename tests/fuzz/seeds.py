#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Writes the corpora of meshes and models that fuzzing starts from, in the bytes of mesh.c, model.c
and number.c:  tests/fuzz/seeds.py"""
import math
import pathlib
import struct

CORPUS = pathlib.Path(__file__).parent / "corpus"
NORMALS, UVS, CUT, OWN_CLIP, MIRRORED = 1, 2, 4, 8, 16
SPECIAL = {"0": 0, "-0": 1, "nan": 2, "inf": 3, "-inf": 4, "max": 5, "min": 7, "denormal": 9}
IDENTITY = [1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0]
PERSPECTIVE = [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, -2, -1, 0, 0, -3, 0]


def number(value):
    if isinstance(value, str):
        return bytes([SPECIAL[value]])
    step = value * 16 + 0x80
    if step == int(step) and 0x20 <= step < 0xF0:
        return bytes([int(step)])
    return b"\xff" + struct.pack("<f", value)


def numbers(values):
    return b"".join(number(value) for value in values)


def flat(points):
    return [value for point in points for value in point]


CUBE = [(x, y, z) for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)]
CUBE_SIDES = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
CUBE_FACES = [t for a, b, c, d in CUBE_SIDES for t in ((a, b, c), (a, c, d))]
TETRAHEDRON = [(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)]
TETRAHEDRON_FACES = [(0, 2, 1), (0, 1, 3), (0, 3, 2), (1, 2, 3)]
GRID = [(x / 4 - 1.5, 0, z / 4 - 1.5) for x in range(11) for z in range(11)]
GRID_FACES = [t for x in range(10) for z in range(10)
              for i in [11 * x + z] for t in ((i, i + 1, i + 12), (i, i + 12, i + 11))]
FAN = [(0, 0, 0), (0, 2, 0)] + [(math.cos(i), 1, math.sin(i)) for i in range(6)]
FAN_FACES = [(0, 1, 2 + i) for i in range(6)]
SLIVER = [(0, 0, 0), (6, 0, 0), (3, 1e-6, 0), (3, -1e-6, 1e-7)]

# name: points, triangles, what differs from a spot above
MESHES = {
    "cube": (CUBE, CUBE_FACES, {}),
    "cube-directional": (CUBE, CUBE_FACES, {"type": 1}),
    "cube-lit-from-inside": (CUBE, CUBE_FACES, {"position": [0, 0, 0], "target": [0, 1, 0]}),
    "cube-lit-in-a-plane": (CUBE, CUBE_FACES, {"position": [4, 1, 0]}),
    "cube-lit-at-a-corner": (CUBE, CUBE_FACES, {"position": [1, 1, 1]}),
    "cube-smooth": (CUBE, CUBE_FACES, {"normals": flat(CUBE[:7]) + ["nan", 0, 0],
                                       "uvs": [0.5, "inf"] * 8}),
    "cube-own-clip": (CUBE, CUBE_FACES, {"clip": PERSPECTIVE + [0, 0, 0, 1]}),
    "cube-flat": (CUBE, CUBE_FACES, {"transform": [1, 0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0]}),
    "cube-mirrored": (CUBE, CUBE_FACES, {"flags": MIRRORED, "law": 0,
                                         "transform": [-1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0]}),
    "tetrahedron": (TETRAHEDRON, TETRAHEDRON_FACES, {"law": 2}),
    "duplicates": (TETRAHEDRON, TETRAHEDRON_FACES * 3 + [(0, 1, 2), (1, 1, 2)], {}),
    "grid": (GRID, GRID_FACES, {"target": [0.5, 0, 0]}),
    "fan": (FAN, FAN_FACES, {"position": [4, 4, 0]}),
    "sliver": (SLIVER, TETRAHEDRON_FACES, {}),
    "one-point": ([(1, 1, 1)] * 3, [(0, 1, 2)], {}),
    "huge": ([("max", 0, 0), ("-0", "max", 0), (0, 0, "max")], [(0, 1, 2)], {}),
    "denormal": ([("denormal", 0, 0), ("-0", "min", 0), (0, 0, "denormal")], [(0, 1, 2)], {}),
    "not-finite": ([(0, 0, 0), (1, 0, 0), (0, "nan", 0)], [(0, 1, 2)], {}),
    "out-of-range": (TETRAHEDRON, [(0, 1, 4)], {}),
    "cut": (TETRAHEDRON, TETRAHEDRON_FACES, {"flags": CUT}),
    "empty": ([], [], {}),
}


def mesh_seed(points, triangles, other):
    flags = other.get("flags", 0)
    flags |= (NORMALS if "normals" in other else 0) | (UVS if "uvs" in other else 0)
    flags |= OWN_CLIP if "clip" in other else 0
    data = bytes([flags, other.get("type", 0)])
    data += numbers(other.get("position", [0.5, 5, 1]) + other.get("target", [0, 0, 0]))
    data += numbers([0.25, 2])  # radius, and 76 degrees
    data += numbers(other.get("transform", IDENTITY))
    data += bytes([other.get("law", 1)]) + numbers([0.25, 1.25, 0]) + numbers(other.get("clip", []))
    data += bytes([len(points), len(triangles)]) + numbers(flat(points))
    data += numbers(other.get("normals", []) + other.get("uvs", []))
    return data + bytes(flat(triangles)) + bytes(flags & CUT)


def model_mesh(points, triangles):
    head = bytes([0]) + b"ab" + bytes([len(points), len(triangles)])
    return head + numbers(flat(points)) + bytes(flat(triangles))


def model_object(mesh, transform=IDENTITY):
    return bytes([0]) + b"c\n" + bytes([mesh]) + numbers([1, 0.5, 0.25] + transform)


def model_light(flags, position, direction, fade):
    return bytes([flags]) + b"li" + numbers([1] + position + direction + fade)


CAMERA = bytes([1]) + numbers([3, 3, 3, -0.5, -0.5, -0.5, 0, 1, 0, 0]) + bytes([99])
ONE = model_mesh(CUBE, CUBE_FACES)
TWO = ONE + model_mesh(TETRAHEDRON, TETRAHEDRON_FACES)
SPOT = model_light(4, [0, 5, 0], [0, 4, 0], [1, 0, 0])

# counts of meshes, objects and lights less the 1, 1 and 0 that there are at least
MODELS = {
    "cube": bytes([0, 0, 0]) + ONE + model_object(0),
    "two": bytes([1, 2, 0]) + TWO + model_object(0) + model_object(1) + model_object(1),
    "camera": bytes([0, 0, 0]) + ONE + model_object(0) + CAMERA,
    "lights": bytes([0, 0, 2]) + ONE + model_object(0) + SPOT +
              model_light(5, [0, 0, 0], [1, 2, 0], [0, 0, 0]) + CAMERA,
    "point-light": bytes([0, 0, 1]) + ONE + model_object(0) +
                   model_light(0, [0, 3, 0], [0, 0, 0], [0, 0, 1]),
    "light-in-the-middle": bytes([0, 0, 1]) + ONE + model_object(0) +
                           model_light(4, [0, 0, 0], [0, 1, 0], [0, 0, 1]),
    "light-far-away": bytes([0, 0, 1]) + ONE + model_object(0) +
                      model_light(4, [1e19, 1e19, 1e19], [-1, -1, -1], [0, 0, 1]),
    "light-at-the-end": bytes([0, 0, 1]) + ONE + model_object(0) +
                        model_light(0, ["max", "max", "max"], [0, 0, 0], [0, 0, 1]),
    "light-parallel-far-away": bytes([0, 0, 1]) + ONE + model_object(0) +
                               model_light(5, ["max", 0, 0], [-1, 0, 0], [1, 0, 0]),
    "camera-far-away": bytes([0, 0, 0]) + ONE + model_object(0) + bytes([1]) +
                       numbers([1e30, 1e30, 1e30, 0, 0, 0, 0, 1, 0, 0]) + bytes([99]),
    "light-nowhere": bytes([0, 0, 1]) + ONE + model_object(0) +
                     model_light(4, ["nan", 0, 0], [0, "inf", 0], [0, 0, 0]),
    "huge": bytes([0, 0, 0]) + ONE + model_object(0, [1e15, 0, 0, 0, 1e15, 0, 0, 0, 1e15, 0, 0, 0]),
    "not-finite": bytes([0, 0, 0]) + ONE + model_object(0, ["nan"] * 12),
}


def main():
    for name, mesh in MESHES.items():
        (CORPUS / "mesh" / name).write_bytes(mesh_seed(*mesh))
    for name, model in MODELS.items():
        (CORPUS / "model" / name).write_bytes(model)


if __name__ == "__main__":
    main()
