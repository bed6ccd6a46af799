"""Linear elasticity with hexahedra of 27 nodes and, in each, a linear pressure (Q2/P1). This element does not lock, and it
shares no code with the simulator."""
import itertools

import numpy as np
import scipy.sparse
import scipy.sparse.linalg

POINTS, WEIGHTS = np.sqrt(0.6) * np.array([-1.0, 0.0, 1.0]), np.array([5.0, 8.0, 5.0]) / 9.0
STRAINS = ((0, 0, 0), (1, 1, 1), (2, 2, 2), (3, 0, 1), (3, 1, 0), (4, 1, 2), (4, 2, 1), (5, 0, 2), (5, 2, 0))


def shape_functions(point):
    """The 27 values, and the derivatives in the three directions."""
    values = [np.array([s * (s - 1.0) / 2.0, 1.0 - s * s, s * (s + 1.0) / 2.0]) for s in point]
    slopes = [np.array([s - 0.5, -2.0 * s, s + 0.5]) for s in point]
    product = lambda a, b, c: np.einsum("a,b,c->abc", a, b, c).ravel()
    return product(*values), np.stack([product(*(slopes[k] if k == axis else values[k] for k in range(3)))
                                       for axis in range(3)])


def grid(cells, place):
    """@return vertices, the 27 nodes of each cell."""
    shape = [2 * n + 1 for n in cells]
    cube = np.stack(np.meshgrid(*[np.linspace(0.0, 1.0, n) for n in shape], indexing="ij"), axis=-1).reshape(-1, 3)
    local = np.array(list(itertools.product(range(3), repeat=3)))
    corners = np.array(list(itertools.product(*map(range, cells))))
    nodes = np.ravel_multi_index(np.moveaxis(2 * corners[:, None] + local, -1, 0), shape)
    return np.array([place(*point) for point in cube]), nodes


def assemble(vertices, nodes, young, poisson):
    """@return the stiffness, and the volume of each node."""
    shear, bulk = young / (2.0 * (1.0 + poisson)), young * poisson / ((1.0 + poisson) * (1.0 - 2.0 * poisson))
    material = shear * np.diag([2.0, 2.0, 2.0, 1.0, 1.0, 1.0])
    count = len(nodes)
    blocks, mass = np.zeros((count, 81, 81)), np.zeros((count, 4, 4))
    divergence, volumes = np.zeros((count, 4, 81)), np.zeros(len(vertices))
    for index in itertools.product(range(3), repeat=3):
        point = [POINTS[k] for k in index]
        values, slopes = shape_functions(point)
        jacobians = np.einsum("ra,maj->mrj", slopes, vertices[nodes])
        weights = np.prod([WEIGHTS[k] for k in index]) * np.linalg.det(jacobians)
        gradients = np.einsum("mjr,ra->mja", np.linalg.inv(jacobians), slopes)
        strain = np.zeros((count, 6, 27, 3))
        for row, component, axis in STRAINS:
            strain[:, row, :, component] = gradients[:, axis]
        strain = strain.reshape(count, 6, 81)
        pressure = np.array([1.0, *point])
        blocks += np.einsum("m,mra,rs,msb->mab", weights, strain, material, strain, optimize=True)
        divergence += weights[:, None, None] * pressure[None, :, None] * strain[:, :3].sum(axis=1)[:, None]
        mass += weights[:, None, None] * np.outer(pressure, pressure)
        np.add.at(volumes, nodes, weights[:, None] * values)
    blocks += bulk * np.einsum("mpa,mpq,mqb->mab", divergence, np.linalg.inv(mass), divergence, optimize=True)
    places = (3 * nodes[:, :, None] + np.arange(3)).reshape(count, 81)
    size = 3 * len(vertices)
    entries = np.repeat(places, 81, axis=1).ravel(), np.tile(places, (1, 81)).ravel()
    return scipy.sparse.csc_matrix((blocks.ravel(), entries), shape=(size, size)), volumes


def deflection(cells, place, young, poisson, loads_of, axis):
    """Mean displacement of the end x = largest along an axis. The end x = 0 is held.
    @param loads_of(vertices, volumes) the forces."""
    vertices, nodes = grid(cells, place)
    stiffness, volumes = assemble(vertices, nodes, young, poisson)
    free = np.flatnonzero(np.repeat(vertices[:, 0] > 1e-9, 3))
    moves = np.zeros(vertices.size)
    moves[free] = scipy.sparse.linalg.spsolve(stiffness[free][:, free], loads_of(vertices, volumes).ravel()[free],
                                              permc_spec="MMD_AT_PLUS_A")
    end = vertices[:, 0] > vertices[:, 0].max() - 1e-9
    return moves.reshape(-1, 3)[end, axis].mean()


def end_load(vertices, force, axis):
    """A traction on the plane end of a grid of cells, by Simpson's rule in both directions."""
    loads = np.zeros_like(vertices)
    end = np.flatnonzero(vertices[:, 0] > vertices[:, 0].max() - 1e-9)
    shares = np.ones(len(end))
    for across in (1, 2):
        places, index = np.unique(np.round(vertices[end, across], 9), return_inverse=True)
        rule = np.where(np.arange(len(places)) % 2 == 1, 4.0, 2.0)
        rule[[0, -1]] = 1.0
        shares *= rule[index]
    loads[end, axis] = force * shares / shares.sum()
    return loads
