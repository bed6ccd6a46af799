"""Convergence to known solutions as the mesh gets finer."""
import math

import numpy as np

from validation.simulate_tool import OUTPUT, SOLVERS, box, settled, static


# Each refinement study: cells across -> (tets, result / reference).

def cantilever(n, *solver):
    length, height, young, deflection = 1.0, 0.1, 1e6, 1e-3
    mesh, _ = box(f"cantilever_{n}", (10 * n, n, n), lambda x, y, z: (length * x, height * y, height * z))
    force = deflection * 3.0 * young * height**4 / 12.0 / length**3
    row = static(mesh, "--young", young, "--poisson", 0, "--pin", "x<1e-9", "--load", "x>0.999999", 0, 0, -force,
                 "--probe", "x>0.999999", "--tolerance", 1e-6, *solver)
    return 60 * n**3, -row["probe_z_m"] / deflection


def sag(n, *solver):
    length, young, density, gravity = 1.0, 1e6, 1000.0, 0.1
    mesh, _ = box(f"sag_{n}", (n, n, 4 * n), lambda x, y, z: (0.2 * x, 0.2 * y, length * z))
    row = static(mesh, "--young", young, "--poisson", 0, "--density", density, "--gravity", 0, 0, -gravity, "--pin",
                 "z>0.999999", "--probe", "z<1e-9", "--tolerance", 1e-6, *solver)
    return 24 * n**3, -row["probe_z_m"] / (density * gravity * length**2 / (2.0 * young))


def cook(n, *solver):
    young, force = 1e6, 100.0  # far above the rounding of the forces, small against the shape
    mesh, _ = box(f"cook_{n}", (n, n, 1), lambda s, t, u: (48.0 * s, 44.0 * s + t * (44.0 - 28.0 * s), u))
    row = static(mesh, "--young", young, "--poisson", 1.0 / 3.0, "--pin", "x<1e-9", "--load", "x>47.99999", 0, force, 0,
                 "--probe", "x>47.99999 & y>51.99999 & y<52.00001", *solver)
    return 6 * n**2, row["probe_y_m"] / (23.96 * force / young)


def twist(n, *solver):
    side, young, poisson, torque = 0.1, 1e6, 0.3, 1e-3
    mesh, rest = box(f"twist_{n}", (10 * n, n, n), lambda x, y, z: (x, side * (y - 0.5), side * (z - 0.5)))
    end = np.flatnonzero(rest[:, 0] > 1.0 - 1e-9)
    around = np.stack([np.zeros(len(end)), -rest[end, 2], rest[end, 1]], axis=1)
    around *= torque / (np.cross(rest[end], around)[:, 0].sum())
    loads = OUTPUT / f"twist_{n}.csv"
    loads.write_text("".join(f"{v},{x!r},{y!r},{z!r}\n" for v, (x, y, z) in zip(end.tolist(), around.tolist())))
    move = settled(mesh, "--static", "--young", young, "--poisson", poisson, "--pin", "x<1e-9", "--loads", loads,
                   "--tolerance", 1e-6, *solver)[0] - rest

    def angle(x):
        at = np.abs(rest[:, 0] - x) < 1e-9
        y, z, dy, dz = rest[at, 1], rest[at, 2], move[at, 1], move[at, 2]
        return (y * dz - z * dy).sum() / (y**2 + z**2).sum()

    shear = young / (2.0 * (1.0 + poisson))
    return 60 * n**3, (angle(0.7) - angle(0.3)) / 0.4 / (torque / (0.1406 * shear * side**4))


STUDIES = {"cantilever": (cantilever, (1, 2, 4, 8, 12)), "Cook's membrane": (cook, (4, 8, 16, 32, 64)),
           "twist": (twist, (2, 4, 8, 12)), "sag": (sag, (1, 2, 4))}
SMOOTHED = [("cantilever", 1), ("cantilever", 2), ("cantilever", 4), ("Cook's membrane", 4), ("Cook's membrane", 8),
            ("Cook's membrane", 16), ("twist", 2), ("twist", 4)]


def refinement_rows():
    """(problem, cells across, tets, result / reference, order of convergence of the error between two rows)."""
    for name, (function, sizes) in STUDIES.items():
        previous = None
        for n in sizes:
            tets, ratio = function(n, *SOLVERS["FEM corotated"])
            error = abs(ratio - 1.0)
            order = math.log(previous[1] / error) / math.log(n / previous[0]) if previous and error > 1e-5 else None
            yield (name, n, tets, f"{ratio:.4f}", "" if order is None else f"{order:.2f}")
            previous = (n, error)


def smoothing_rows():
    """Coarse meshes by shares of smoothed strains."""
    for share in (0, 0.5, 0.6, 0.7, 0.8, 0.9):
        solver = ("--solver", "pd", "--strain-smoothing", share, "--volume-smoothing", share)
        yield (share, *(f"{STUDIES[name][0](n, *solver)[1]:.3f}" for name, n in SMOOTHED))
