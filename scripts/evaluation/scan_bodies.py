"""Bodies that `make scans` scans and that are not shipped, as OBJ files in metres."""
import itertools
import re

import numpy

# A toy on four legs, as rods with round ends: both ends and the radius [mm]. x along its length, z up.
LEG = 6.5
RODS = [((-34, 0, 62), (34, 0, 62), 17), ((34, 0, 66), (58, 0, 92), 9), ((58, 0, 92), (78, 0, 90), 11),
        ((-40, 0, 68), (-66, 0, 78), LEG),
        *(((36 * x, 12 * y, 58), (42 * x, 17 * y, LEG), LEG) for x, y in itertools.product((-1, 1), (-1, 1)))]
STEP, BLEND, BORDER = 1.5, 2.5, 6.3  # of the grid, roundness between two rods, space around [mm]


def distances(places):
    """Signed distance of places (..., 3) to the toy [mm]: the smooth minimum over its rods."""
    shares = 0.0
    for begin, end, radius in RODS:
        begin, way = numpy.array(begin, float), numpy.subtract(end, begin)
        along = numpy.clip((places - begin) @ way / (way @ way), 0.0, 1.0)
        distance = numpy.linalg.norm(places - begin - along[..., None] * way, axis=-1) - radius
        shares = shares + numpy.exp(-numpy.minimum(distance, 100.0) / BLEND)
    return -BLEND * numpy.log(shares)


def crossings(values, axis):
    """Grid edges along an axis whose ends lie on two sides of the surface: index of the lower end, share of the way."""
    low, high = numpy.moveaxis(values, axis, 0)[:-1], numpy.moveaxis(values, axis, 0)[1:]
    places = numpy.argwhere(numpy.moveaxis((low < 0.0) != (high < 0.0), 0, axis))
    ends = places + numpy.eye(3, dtype=int)[axis]
    at_low, at_high = values[tuple(places.T)], values[tuple(ends.T)]
    return places, at_low / (at_low - at_high), at_low < 0.0


def surface_nets(values):
    """Closed surface where the values are zero (Gibson 1998): a vertex in each crossed cell, a quad for each crossed edge."""
    sums, counts, quads = numpy.zeros((*values.shape, 3)), numpy.zeros(values.shape, int), []
    for axis in range(3):
        places, shares, inside = crossings(values, axis)
        points = places + shares[:, None] * numpy.eye(3)[axis]
        u, v = numpy.eye(3, dtype=int)[(axis + 1) % 3], numpy.eye(3, dtype=int)[(axis + 2) % 3]
        cells = [places - u - v, places - v, places, places - u]
        for cell in cells:
            numpy.add.at(sums, tuple(cell.T), points)
            numpy.add.at(counts, tuple(cell.T), 1)
        corners = numpy.stack([numpy.ravel_multi_index(cell.T, values.shape) for cell in cells], axis=1)
        quads.append(numpy.where(inside[:, None], corners, corners[:, ::-1]))
    used = counts.ravel() > 0
    numbers = numpy.cumsum(used) - 1
    vertices = sums.reshape(-1, 3)[used] / counts.ravel()[used, None]
    quads = numbers[numpy.concatenate(quads)]
    return vertices, numpy.concatenate([quads[:, [0, 1, 2]], quads[:, [0, 2, 3]]])


def write_toy(path):
    """A toy on legs of 13 mm, 165 mm long."""
    ends = numpy.array([end for begin, end, _ in RODS] + [begin for begin, _, _ in RODS], float)
    low, high = ends.min(axis=0) - 17.0 - BORDER, ends.max(axis=0) + 17.0 + BORDER
    axes = [numpy.arange(a, b, STEP) for a, b in zip(low, high)]
    vertices, triangles = surface_nets(distances(numpy.stack(numpy.meshgrid(*axes, indexing="ij"), axis=-1)))
    lines = [*("v {:.6f} {:.6f} {:.6f}".format(*vertex) for vertex in 1e-3 * (low + STEP * vertices)),
             *("f {} {} {}".format(*(triangle + 1)) for triangle in triangles)]
    path.write_text("\n".join(lines) + "\n")


def write_scaled(mesh, factor, path):
    """A larger copy of an OBJ, without its material."""
    def scaled(found):
        return " ".join(["v", *(f"{factor * float(word):.6f}" for word in found[1].split()[:3])])

    text = re.sub(r"^(?:mtllib|usemtl).*\n", "", mesh.read_text(), flags=re.MULTILINE)
    path.write_text(re.sub(r"^v (.*)$", scaled, text, flags=re.MULTILINE))
