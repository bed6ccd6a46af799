"""Held specimens: beams, stretched and twisted bars and bars of two materials, with the settings of the node first."""
import math

from validation.incompressible import beam, beam_move, beam_reference
from validation.simulate_tool import NODE, SOLVERS, box, settle, static

REFERENCE = [*SOLVERS["FEM corotated"][:2], "--tolerance", 1e-6]
LENGTH, SIDE = 0.2, 0.02


def beam_rows():
    """Deflection of a held beam under its weight at three Poisson's ratios, divided by that of another program."""
    expected = {poisson: beam_reference(poisson) for poisson in (0.2, 0.45, 0.49)}
    for name, n, options in (("as the node, static", 3, ["--static", *NODE]), ("as the node, static", 6, ["--static", *NODE]),
                             ("as the node, after 3 s", 3, [*NODE, "--steps", 90]), ("pd, 20000 iterations", 6,
                             ["--static", "--solver", "pd"]), ("fem", 6, ["--static", *REFERENCE])):
        mesh, _ = box(f"beam_{n}", (10 * n // 3, n, n), beam)
        yield (name, n, *(f"{beam_move(mesh, poisson, options) / reference:.3f}"
                          for poisson, reference in expected.items()))


def weight_rows():
    """The weight that the pins of a held sponge carry, for every stiffness."""
    mesh, _ = box("sponge", (10, 5, 1), lambda x, y, z: (0.2 * x, 0.1 * y, 0.03 * z))
    weight = 30.0 * 0.2 * 0.1 * 0.03 * 9.81
    for exponent in range(3, 12):
        found = (settle(mesh, "--young", 10.0**exponent, "--gravity", 0, 0, -9.81, "--pin", "x<1e-9", *options)
                 for options in (NODE, ["--solver", "pd"], ["--solver", "fem"]))
        yield (f"1e{exponent}", *(f"{-row['pins_z_n'] / weight:.5f}" if row else "not converged" for row in found))


def specimen_rows():
    """Prescribed motion of one end; force or torque by theory."""
    area, end, young = SIDE**2, f"x>{LENGTH - 1e-9}", 1e5
    place = lambda x, y, z: (LENGTH * x, SIDE * (y - 0.5), SIDE * (z - 0.5))
    (thin, _), (fine, _) = box("bar", (20, 2, 2), place), box("fine_bar", (80, 8, 8), place)
    halves = ("--poisson", 0, "--material", f"x>{LENGTH / 2}", 10 * young, 0, 30)
    series = area / (LENGTH / 2 / young + LENGTH / 2 / (10 * young))
    layers = ("--poisson", 0, "--material", "z>0", 10 * young, 0, 30)
    pull, stiffness = ("--move", end, 0.01, 0, 0), young * area / LENGTH
    cases = (("stretched by 5 %", thin, ("--poisson", 0, *pull), "n", 0.01 * stiffness),
             ("compressed by 5 %", thin, ("--poisson", 0, "--move", end, -0.01, 0, 0), "n", -0.01 * stiffness),
             ("two halves, stretched by 5 %", thin, (*halves, *pull), "n", 0.01 * series),
             ("two layers, stretched by 5 %", thin, (*layers, *pull), "n", 0.01 * 5.5 * stiffness),
             ("twisted by 10 degrees", fine, ("--poisson", 0.3, "--turn", end, 1, 0, 0, 10), "nm",
              math.radians(10) * 0.1406 * young / 2.6 * SIDE**4 / LENGTH))
    for name, mesh, options, unit, expected in cases:
        ends = (static(mesh, "--pin", "x<1e-9", "--young", young, *options, *solver) for solver in (NODE, REFERENCE))
        yield (name, *(f"{-end[f'region_2_x_{unit}'] / expected:.4f}" for end in ends))
    # A core between two stiff faces, bent by a force: the transformed section, with the shear of the core.
    length, width, height, face, young, stiff, force = 0.4, 0.02, 0.04, 0.01, 1e5, 1e6, 1e-3
    mesh, _ = box("sandwich", (32, 2, 8), lambda x, y, z: (length * x, width * y, height * z))
    core = height - 2 * face
    bending = width / 12 * (stiff * (height**3 - core**3) + young * core**3)
    shear = 0.5 * young * width * (height - face)**2 / core
    expected = force * (length**3 / (3 * bending) + length / shear)
    bent = (static(mesh, "--young", young, "--poisson", 0, "--material", f"z<{face}", stiff, 0, 30, "--material",
                   f"z>{height - face}", stiff, 0, 30, "--pin", "x<1e-9", "--load", f"x>{length - 1e-9}", 0, 0, force,
                   "--probe", f"x>{length - 1e-9}", *solver) for solver in (NODE, REFERENCE))
    yield ("sandwich, bent", *(f"{row['probe_z_m'] / expected:.4f}" for row in bent))
