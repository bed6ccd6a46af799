"""Held specimens: beams, stretched and twisted bars and bars of two materials, with the settings of the node first."""
import math

from validation.incompressible import DENSITY, GRAVITY, YOUNG, beam
from validation.mixed_reference import deflection
from validation.simulate_tool import NODE, SOLVERS, box, settle, simulate

REFERENCE = [*SOLVERS["FEM corotated"][:2], "--tolerance", 1e-6]
LENGTH, SIDE = 0.2, 0.02


def beam_rows():
    """Deflection of a held beam under its weight at three Poisson's ratios, divided by that of another program."""
    weight = lambda vertices, volumes: volumes[:, None] * [0.0, 0.0, -DENSITY * GRAVITY]
    expected = {poisson: deflection((13, 4, 4), beam, YOUNG, poisson, weight, 2) for poisson in (0.2, 0.45, 0.49)}
    rows = []
    for name, n, options in (("as the node, static", 3, ["--static", *NODE]), ("as the node, static", 6, ["--static", *NODE]),
                             ("as the node, after 3 s", 3, [*NODE, "--steps", 90]), ("pd, 20000 iterations", 6,
                             ["--static", "--solver", "pd"]), ("fem", 6, ["--static", *REFERENCE])):
        mesh, _ = box(f"beam_{n}", (10 * n // 3, n, n), beam)
        ratios = []
        for poisson, reference in expected.items():
            move = simulate(mesh, "--young", YOUNG, "--density", DENSITY, "--poisson", poisson, "--gravity", 0, 0, -GRAVITY,
                            "--pin", "x<1e-9", "--probe", "x>0.0999999", *options)[-1]["probe_z_m"]
            ratios.append(f"{move / reference:.3f}")
        rows.append((name, n, *ratios))
    return rows


def weight_rows():
    """The weight that the pins of a held sponge carry, for every stiffness."""
    mesh, _ = box("sponge", (10, 5, 1), lambda x, y, z: (0.2 * x, 0.1 * y, 0.03 * z))
    weight = 30.0 * 0.2 * 0.1 * 0.03 * 9.81
    rows = []
    for exponent in range(3, 12):
        carried = []
        for options in (NODE, ["--solver", "pd"], ["--solver", "fem"]):
            row = settle(mesh, "--young", 10.0**exponent, "--gravity", 0, 0, -9.81, "--pin", "x<1e-9", *options)
            carried.append("not converged" if row is None else f"{-row['pins_z_n'] / weight:.5f}")
        rows.append((f"1e{exponent}", *carried))
    return rows


def bar(name, cells):
    return box(name, cells, lambda x, y, z: (LENGTH * x, SIDE * (y - 0.5), SIDE * (z - 0.5)))[0]


def end_force(mesh, *options):
    row = simulate(mesh, "--static", "--pin", "x<1e-9", *options)[-1]
    return -row["region_2_x_n"], -row["region_2_x_nm"]


def specimen_rows():
    """Prescribed motion of one end; force or torque by theory."""
    area, end, young = SIDE**2, f"x>{LENGTH - 1e-9}", 1e5
    rows = []
    thin, fine = bar("bar", (20, 2, 2)), bar("fine_bar", (80, 8, 8))
    halves = ("--poisson", 0, "--material", f"x>{LENGTH / 2}", 10 * young, 0, 30)
    series = area / (LENGTH / 2 / young + LENGTH / 2 / (10 * young))
    layers = ("--poisson", 0, "--material", "z>0", 10 * young, 0, 30)
    cases = (("stretched by 5 %", thin, ("--poisson", 0, "--move", end, 0.01, 0, 0), 0, 0.01 * young * area / LENGTH),
             ("compressed by 5 %", thin, ("--poisson", 0, "--move", end, -0.01, 0, 0), 0, -0.01 * young * area / LENGTH),
             ("two halves, stretched by 5 %", thin, (*halves, "--move", end, 0.01, 0, 0), 0, 0.01 * series),
             ("two layers, stretched by 5 %", thin, (*layers, "--move", end, 0.01, 0, 0), 0, 0.01 * 5.5 * young * area / LENGTH),
             ("twisted by 10 degrees", fine, ("--poisson", 0.3, "--turn", end, 1, 0, 0, 10), 1,
              math.radians(10) * 0.1406 * young / 2.6 * SIDE**4 / LENGTH))
    for name, mesh, options, which, expected in cases:
        ratios = []
        for solver in (NODE, REFERENCE):
            ratios.append(f"{end_force(mesh, '--young', young, *options, *solver)[which] / expected:.4f}")
        rows.append((name, *ratios))
    return [*rows, sandwich_row()]


def sandwich_row():
    """A core between two stiff faces, bent by a force: the transformed section, with the shear of the core."""
    length, width, height, face, young, stiff, force = 0.4, 0.02, 0.04, 0.01, 1e5, 1e6, 1e-3
    mesh, _ = box("sandwich", (32, 2, 8), lambda x, y, z: (length * x, width * y, height * z))
    core = height - 2 * face
    bending = width / 12 * (stiff * (height**3 - core**3) + young * core**3)
    shear = 0.5 * young * width * (height - face)**2 / core
    expected = force * (length**3 / (3 * bending) + length / shear)
    ratios = []
    for solver in (NODE, REFERENCE):
        row = simulate(mesh, "--static", "--young", young, "--poisson", 0, "--material", f"z<{face}", stiff, 0, 30, "--material",
                       f"z>{height - face}", stiff, 0, 30, "--pin", "x<1e-9", "--load", f"x>{length - 1e-9}", 0, 0, force,
                       "--probe", f"x>{length - 1e-9}", *solver)[-1]
        ratios.append(f"{row['probe_z_m'] / expected:.4f}")
    return ("sandwich, bent", *ratios)
