"""Beams and membranes at Poisson's ratios up to 0.495."""

from validation.mixed_reference import deflection, end_load
from validation.simulate_tool import box, simulate

RATIOS = (0.3, 0.45, 0.49, 0.495)
SMOOTHINGS = {"0, 0": (0, 0), "0.7, 0.7": (0.7, 0.7), "0.7, 1": (0.7, 1)}
YOUNG, DENSITY, GRAVITY = 263824.0, 1070.0, 0.0981  # a silicone; small, for linear theory


def beam(x, y, z):
    return 0.1 * x, 0.03 * y, 0.03 * z


def membrane(s, t, u):
    return 48.0 * s, 44.0 * s + t * (44.0 - 28.0 * s), 10.0 * u


def beam_move(mesh, poisson, options):
    return simulate(mesh, "--static", "--young", YOUNG, "--density", DENSITY, "--poisson", poisson, "--gravity", 0, 0,
                    -GRAVITY, "--pin", "x<1e-9", "--probe", "x>0.0999999", "--tolerance", 1e-6, *options)[-1]["probe_z_m"]


def membrane_move(mesh, poisson, options):
    force = 100.0  # far above the rounding of the forces, small against the shape
    row = simulate(mesh, "--static", "--young", 1e6, "--poisson", poisson, "--pin", "x<1e-9", "--load", "x>47.99999", 0,
                   force, 0, "--probe", "x>47.99999", *options)[-1]
    return row["probe_y_m"] / force


def references(poisson):
    weight = lambda vertices, volumes: volumes[:, None] * [0.0, 0.0, -DENSITY * GRAVITY]
    push = lambda vertices, volumes: end_load(vertices, 1.0, 1)
    return (deflection((13, 4, 4), beam, YOUNG, poisson, weight, 2), deflection((8, 8, 2), membrane, 1e6, poisson, push, 1))


def incompressible_rows():
    meshes = [(name, n, box(f"{label}_{n}", cells, place)[0], move, which)
              for name, label, n, cells, place, move, which in (
                  ("beam", "silicone", 6, (20, 6, 6), beam, beam_move, 0),
                  ("Cook's membrane", "thick_cook", 16, (16, 16, 4), membrane, membrane_move, 1),
                  ("Cook's membrane", "thick_cook", 24, (24, 24, 6), membrane, membrane_move, 1))]
    exact = {}
    for poisson in RATIOS:
        exact[poisson] = references(poisson)
    rows = []
    for (name, n, mesh, move, which), solver in ((m, s) for m in meshes for s in ("fem", "pd")):
        for shares, (strain, volume) in SMOOTHINGS.items():
            options = ("--solver", solver, "--strain-smoothing", strain, "--volume-smoothing", volume)
            rows.append((name, n, solver, shares, *(f"{move(mesh, poisson, options) / exact[poisson][which]:.3f}"
                                                     for poisson in RATIOS)))
    return rows
