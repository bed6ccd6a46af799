"""Beams and membranes at Poisson's ratios up to 0.495."""
import itertools

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
    return simulate(mesh, "--young", YOUNG, "--density", DENSITY, "--poisson", poisson, "--gravity", 0, 0, -GRAVITY,
                    "--pin", "x<1e-9", "--probe", "x>0.0999999", *options)[-1]["probe_z_m"]


def membrane_move(mesh, poisson, options):
    force = 100.0  # far above the rounding of the forces, small against the shape
    row = simulate(mesh, "--young", 1e6, "--poisson", poisson, "--pin", "x<1e-9", "--load", "x>47.99999", 0, force, 0,
                   "--probe", "x>47.99999", *options)[-1]
    return row["probe_y_m"] / force


def beam_reference(poisson):
    weight = lambda vertices, volumes: volumes[:, None] * [0.0, 0.0, -DENSITY * GRAVITY]
    return deflection((13, 4, 4), beam, YOUNG, poisson, weight, 2)


def membrane_reference(poisson):
    return deflection((8, 8, 2), membrane, 1e6, poisson, lambda vertices, _: end_load(vertices, 1.0, 1), 1)


def incompressible_rows():
    exact = {move: [reference(poisson) for poisson in RATIOS]
             for move, reference in ((beam_move, beam_reference), (membrane_move, membrane_reference))}
    for name, label, n, cells, place, move, more in (
            ("beam", "silicone", 6, (20, 6, 6), beam, beam_move, ("--tolerance", 1e-6)),
            ("Cook's membrane", "thick_cook", 16, (16, 16, 4), membrane, membrane_move, ()),
            ("Cook's membrane", "thick_cook", 24, (24, 24, 6), membrane, membrane_move, ())):
        mesh, _ = box(f"{label}_{n}", cells, place)
        for solver, (shares, (strain, volume)) in itertools.product(("fem", "pd"), SMOOTHINGS.items()):
            options = ("--static", *more, "--solver", solver, "--strain-smoothing", strain, "--volume-smoothing",
                       volume)
            yield (name, n, solver, shares, *(f"{move(mesh, poisson, options) / reference:.3f}"
                                               for poisson, reference in zip(RATIOS, exact[move])))
