"""Corotational elasticity in another formulation than the simulator's, that of SOFA's TetrahedronFEMForceField with the polar
decomposition: per tet f = R K (R^T x - X), K the 12 x 12 matrix of linear elasticity."""
import numpy as np


def corotational_forces(rest, tets, young, poisson):
    """@return a function of positions: forces, and the stiffness with R frozen."""
    shear = young / (2.0 * (1.0 + poisson))
    material = np.diag([2.0 * shear] * 3 + [shear] * 3)
    material[:3, :3] += young * poisson / ((1.0 + poisson) * (1.0 - 2.0 * poisson))
    corners = rest[tets]
    edges = np.swapaxes(corners[:, 1:] - corners[:, :1], 1, 2)
    inverse = np.linalg.inv(edges)
    slopes = np.concatenate([-inverse.sum(axis=1, keepdims=True), inverse], axis=1)
    strain = np.zeros((len(tets), 6, 12))
    for a in range(4):
        for row, (i, j) in enumerate(((0, 0), (1, 1), (2, 2), (0, 1), (1, 2), (2, 0))):
            strain[:, row, 3 * a + i] = slopes[:, a, j]
            strain[:, row, 3 * a + j] = slopes[:, a, i]
    stiffness = np.einsum("t,tji,jk,tkl->til", np.linalg.det(edges) / 6.0, strain, material, strain)
    places = (3 * tets[:, :, None] + np.arange(3)).reshape(-1, 12)

    def at(x):
        gradients = np.swapaxes(x[tets][:, 1:] - x[tets][:, :1], 1, 2) @ inverse
        u, _, v = np.linalg.svd(gradients)
        u[:, :, 2] *= np.sign(np.linalg.det(u @ v))[:, None]
        turns = np.zeros((len(tets), 12, 12))
        for a in range(4):
            turns[:, 3 * a:3 * a + 3, 3 * a:3 * a + 3] = u @ v
        local = np.einsum("tji,tj->ti", turns, x[tets].reshape(-1, 12)) - corners.reshape(-1, 12)
        forces, matrix = np.zeros(x.size), np.zeros((x.size, x.size))
        np.add.at(forces, places, -np.einsum("tij,tj->ti", turns @ stiffness, local))
        np.add.at(matrix, (places[:, :, None], places[:, None, :]), turns @ stiffness @ np.swapaxes(turns, 1, 2))
        return forces, matrix

    return at


def beam_tip(rest, tets, young, poisson, density, gravity):
    """Where the end of a beam along x comes to rest: modified Newton with damped steps."""
    masses = np.zeros(len(rest))
    volumes = np.linalg.det(rest[tets[:, 1:]] - rest[tets[:, :1]]) / 6.0
    np.add.at(masses, tets, np.repeat(0.25 * density * volumes[:, None], 4, axis=1))
    loads = np.outer(masses, [0.0, 0.0, -gravity]).ravel()
    free = np.repeat(rest[:, 0] > 1e-9, 3)
    forces_at = corotational_forces(rest, tets, young, poisson)
    x = rest.copy()
    forces, matrix = forces_at(x)
    for _ in range(500):
        residual = np.linalg.norm((forces + loads)[free])
        if residual < 1e-9 * np.linalg.norm(loads):
            break
        move = np.zeros(x.size)
        move[free] = np.linalg.solve(matrix[np.ix_(free, free)], (forces + loads)[free])
        for step in 0.5 ** np.arange(7):
            trial = x + step * move.reshape(-1, 3)
            forces, matrix = forces_at(trial)
            if np.linalg.norm((forces + loads)[free]) < residual:
                break
        x = trial
    return (x - rest)[rest[:, 0] > rest[:, 0].max() - 1e-9].mean(axis=0)
