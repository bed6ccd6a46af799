"""Comparisons on single meshes: between solvers, with beam theory and with another formulation."""
import itertools
import math
import sys

import numpy as np
from scipy.spatial.transform import Rotation

from pages import ROOT
from validation.corotational_reference import beam_tip
from validation.simulate_tool import OUTPUT, SOLVERS, box, read, run_tool, second_moment, settled, static

MESHES = ROOT / "../shared/data/meshes/tet"


def agreement_rows():
    """Static equilibria of PD and FEM with the same corotated energy, on published meshes."""
    rows = []
    for path in sorted(path for path in MESHES.glob("*/*") if path.suffix in (".ele", ".msh", ".vtu", ".veg")):
        probe = OUTPUT / "rest.vtu"
        run = run_tool(path, "--steps", 1, "--output", probe)
        if run.returncode != 0:
            print(run.stderr, end="", file=sys.stderr)
            continue  # no tets
        rest, _ = read(probe)
        low, high = rest.min(axis=0), rest.max(axis=0)
        limit = low[2] + 0.25 * (high[2] - low[2])
        if (rest[:, 2] <= limit).sum() < 3:
            continue  # it can turn about what holds it, so the equilibrium is not unique
        gravity = 0.005 * 2e4 / (30.0 * (high[2] - low[2]))
        arguments = ["--static", "--poisson", 0.3, "--gravity", 0, 0, -gravity, "--pin", f"z<={limit!r}"]
        pd, fem = (settled(path, *arguments, *SOLVERS[solver])[0] for solver in ("PD", "FEM corotated"))
        size = np.linalg.norm(high - low)
        moved, apart = (np.linalg.norm(fem - x, axis=1).max() / size for x in (rest, pd))
        rows.append((f"{path.parent.name}/{path.name}", len(rest), f"{moved:.4f}", f"{apart:.1e}"))
    return rows or [("skipped: ../shared/data/meshes/tet is missing", *"---")]


def prism_rows():
    """Published beam meshes, clamped at one end, under a small gravity, against bending and shear."""
    for name, along, down in (("vega/beam3_tet.veg", 1, 0), ("sofa/truthcylinder1.msh", 1, 0), ("sofa/cylinder.msh", 2, 0)):
        path = MESHES / name
        if not path.exists():
            continue
        result = OUTPUT / "prism.vtu"
        held = static(path, "--pin", "all", "--output", result)
        rest, tets = read(result)
        low, high = rest.min(axis=0), rest.max(axis=0)
        length = high[along] - low[along]
        area = held["volume_m3"] / length
        inertia = second_moment(rest, tets, down) / length
        young, density = 1e6, 1000.0
        bending, shear = length**4 / (8.0 * young * inertia / area), length**2 / (2.0 * 0.9 * 0.5 * young)
        gravity = 1e-3 * length / (density * (bending + shear))
        axis, end = "xyz"[along], high[along] - 1e-6 * length
        row = static(path, "--young", young, "--poisson", 0, "--density", density, "--gravity",
                     *(-gravity * np.eye(3)[down]), "--pin", f"{axis}<{float(low[along] + 1e-6 * length)!r}", "--probe",
                     f"{axis}>{float(end)!r}", "--tolerance", 1e-6, *SOLVERS["FEM corotated"])
        yield (name, len(tets), f"{length * math.sqrt(area / inertia):.1f}",
               f"{-row['probe_' + 'xyz'[down] + '_m'] / (1e-3 * length):.4f}")


def formulation_rows():
    mesh, rest = box("beam", (12, 2, 2), lambda x, y, z: (0.16 * x, 0.03 * y, 0.03 * z))
    tets = np.loadtxt(mesh.with_suffix(".ele"), skiprows=1, dtype=int)[:, 1:]
    for young, poisson, density in ((1e6, 0.3, 1000.0), (2e4, 0.3, 200.0), (3e3, 0.45, 200.0)):
        other = beam_tip(rest, tets, young, poisson, density, 9.81)
        for solver in ("PD", "FEM corotated"):
            row = static(mesh, "--young", young, "--poisson", poisson, "--density", density, "--gravity", 0, 0, -9.81,
                         "--pin", "x<1e-9", "--probe", "x>0.159999", "--tolerance", 1e-6, *SOLVERS[solver])
            tip = np.array([row[f"probe_{axis}_m"] for axis in "xyz"])
            yield (f"{young:g}", poisson, solver, f"{1e3 * tip[0]:.4f}, {1e3 * tip[2]:.4f}",
                   f"{np.linalg.norm(tip - other) / np.linalg.norm(other):.0e}")


def bending_rows():
    mesh, _ = box("bar", (20, 10, 3), lambda x, y, z: (0.2 * x, 0.1 * y, 0.03 * z))
    for name, options in SOLVERS.items():
        row = static(mesh, "--poisson", 0.45, "--pin", "x<1e-9", "--load", "x>0.199999", 0, 0, -0.35, "--probe",
                     "x>0.199999", "--tolerance", 1e-6, *options)
        change = 100.0 * (row["volume_m3"] / (0.2 * 0.1 * 0.03) - 1.0)
        yield (name, f"{-1e3 * row['probe_z_m']:.1f}", f"{change:+.2f}")


def recovery_rows():
    mesh, rest = box("sponge", (10, 5, 1), lambda x, y, z: (0.2 * x, 0.1 * y, 0.03 * z))
    for (name, options), start in itertools.product(SOLVERS.items(), ("flat", "inside_out", "random")):
        shape, table = settled(mesh, "--start", start, "--steps", 150, "--damping", 0.3, *options)
        a, b = (places - places.mean(axis=0) for places in (rest, shape))
        rotation, _ = Rotation.align_vectors(b, a)
        distance = np.linalg.norm(b - rotation.apply(a), axis=1).max()
        first, last = (table[k]["elastic_energy_j"] for k in (0, -1))
        yield (name, start, f"{first:.2e}", f"{last:.1e}", f"{1e3 * distance:.1e}")
