#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Writes the corpora of meshes and models that fuzzing starts from, in the bytes of mesh.c, model.c,
model_rig.c and number.c:  tests/fuzz/seeds.py"""
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


def track(times, values):
    return bytes([len(times) - 1]) + numbers(times) + numbers(flat(values))


def channel(node, times, positions=((0, 0, 0),), rotations=((0, 0, 0, 1),), scales=((1, 1, 1),)):
    tracks = b"".join(track(times[:len(values)], values) for values in (positions, rotations, scales))
    return bytes([node]) + tracks


def target(positions, normals=()):
    return bytes([1 if normals else 0]) + numbers(positions) + numbers(normals)


def shape(weights, targets, bones, vertices):
    """bones: node and offset; vertices: of each, its bones."""
    data = bytes([len(weights)]) + numbers(weights) + b"".join(targets) + bytes([len(bones)])
    data += b"".join(bytes([node]) + numbers(offset) for node, offset in bones)
    return data + b"".join(bytes([len(taken)] + taken) for taken in vertices)


def clip(duration, channels, blends=()):
    blended = b"".join(bytes([1]) + blend for blend in blends)
    return numbers([duration]) + bytes([len(channels)]) + b"".join(channels) + blended


def rig(parents, object_nodes, shapes, clips, lights=(), camera=0):
    """parents: of all nodes but the first; object_nodes: less 1; shapes: by object."""
    data = bytes([1, len(parents) - 1]) + numbers(IDENTITY)
    data += b"".join(bytes([parent]) + numbers(IDENTITY) for parent in parents)
    data += bytes(object_nodes) + bytes([sum(1 << i for i in shapes)])
    data += b"".join(shapes[i] for i in sorted(shapes)) + bytes([len(clips)]) + b"".join(clips)
    return data + bytes(lights) + bytes([camera])


NO_CAMERA = bytes([0])
SECOND = [0, 0.5, 1]
WALK = channel(1, SECOND, [(0, 0, 0), (1, 0, 0), (1, 2, 0)])
TURN = channel(2, SECOND, rotations=[(0, 0, 0, 1), (0, 1, 0, 0), (0, 0, 0, -1)])
GROW = channel(1, SECOND, scales=[(1, 1, 1), (0, 0, 0), (-2, 2, 2)])
SWELL = target([value / 2 for value in flat(CUBE)])
BENT = shape([], [], [(1, IDENTITY), (2, [1, 0, 0, 0, 1, 0, 0, 0, 1, 0, -1, 0])],
             [[0], [0, 1], [1], [], [0, 1, 1], [1], [1], [0]])

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
    "walk": bytes([0, 0, 0]) + ONE + model_object(0) + NO_CAMERA +
            rig([0, 1], [0], {}, [clip(1, [WALK])]),
    "turn-with-camera": bytes([0, 0, 1]) + ONE + model_object(0) + SPOT + CAMERA +
                        rig([0, 1], [1], {}, [clip(1, [TURN, GROW]), clip(0, [])], [2], 2),
    "skin": bytes([0, 0, 0]) + ONE + model_object(0) + NO_CAMERA +
            rig([0, 1], [0], {0: BENT}, [clip(2, [WALK, TURN])]),
    "morph": bytes([0, 0, 0]) + ONE + model_object(0) + NO_CAMERA +
             rig([0], [0], {0: shape([0.25, 0], [SWELL, target(["nan"] * 24)], [], [])},
                 [clip(1, [], [track(SECOND, [(0, 0), (1, 0), (0, 1)])])]),
    "morph-on-bones": bytes([0, 2, 0]) + ONE + model_object(0) * 3 + NO_CAMERA +
                      rig([0, 1], [0, 1, 1],
                          {0: shape([0.5], [SWELL], [(2, IDENTITY)], [[0]] * 8), 2: BENT},
                          [clip(1, [TURN], [track([0, 1], [(0,), (-3,)])])]),
    "bones-far-away": bytes([0, 0, 0]) + ONE + model_object(0) + NO_CAMERA +
                      rig([0, 1], [0], {0: BENT}, [clip(1, [
                          channel(2, SECOND, [(0, 0, 0), (1e19, 0, 0), ("max", "max", 0)])])]),
    "times-at-the-end": bytes([0, 0, 0]) + ONE + model_object(0) + NO_CAMERA +
                        rig([0, 1], [0], {}, [clip("denormal", [
                            channel(1, [-3, "denormal", "max"], [(0, 0, 0), (1, 0, 0), (2, 0, 0)])
                        ])]),
}


def main():
    for name, mesh in MESHES.items():
        (CORPUS / "mesh" / name).write_bytes(mesh_seed(*mesh))
    for name, model in MODELS.items():
        (CORPUS / "model" / name).write_bytes(model)


if __name__ == "__main__":
    main()
