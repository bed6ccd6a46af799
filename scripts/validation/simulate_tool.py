"""Runs `rosrun softbody_sim simulate`, and makes the boxes that it simulates."""
import csv
import io
import itertools
import subprocess
import sys

import numpy as np

from pages import ROOT
from tools import DEVEL

OUTPUT = ROOT / "validation"
PLAIN = ["--strain-smoothing", "0", "--volume-smoothing", "0"]
SOLVERS = {"PD": ["--solver", "pd", *PLAIN], "FEM corotated": ["--solver", "fem", *PLAIN],
           "FEM neo-Hookean": ["--solver", "fem", "--elasticity", "neo_hookean", *PLAIN]}
NODE = ["--node-defaults"]


def run_tool(mesh, *arguments):
    print(f"== {mesh.name} {' '.join(map(str, arguments))[:100]}", file=sys.stderr)
    command = [DEVEL / "env.sh", DEVEL / "lib/softbody_sim/simulate", mesh, *arguments]
    return subprocess.run(list(map(str, command)), capture_output=True, text=True, check=False)


def rows_of(text):
    """The rows of a table of the tool, as maps of numbers."""
    return [{key: float(value) for key, value in row.items()} for row in csv.DictReader(io.StringIO(text))]


def simulate(mesh, *arguments):
    """The rows of one run of the tool."""
    run = run_tool(mesh, *arguments)
    if run.returncode != 0:
        sys.exit(f"validate: {' '.join(run.args)} ended with {run.returncode}: {run.stderr}")
    return rows_of(run.stdout)


def settle(mesh, *arguments):
    """The row of a static run, or None if the tool says that it has not converged."""
    run = run_tool(mesh, "--static", *arguments)
    rows = rows_of(run.stdout)
    if run.returncode == 0:
        return rows[-1]
    if rows and not rows[-1]["converged"]:
        return None
    sys.exit(f"validate: a static run ended with {run.returncode}: {run.stderr}")


def static(mesh, *arguments):
    """The row of a static run that converges."""
    return simulate(mesh, "--static", *arguments)[-1]


def settled(mesh, *arguments):
    """The vertices at the end of a run, and its rows."""
    result = OUTPUT / "result.vtu"
    rows = simulate(mesh, *arguments, "--output", result)
    return read(result)[0], rows


def box(name, cells, place):
    """A grid of cells of six tets each as TetGen files; `place` maps the unit cube. @return the path, vertices."""
    shape = [n + 1 for n in cells]
    grid = np.stack(np.meshgrid(*[np.linspace(0.0, 1.0, n) for n in shape], indexing="ij"), axis=-1).reshape(-1, 3)
    vertices = np.array([place(*p) for p in grid])
    paths = [np.cumsum([np.zeros(3, int), *np.eye(3, dtype=int)[list(order)]], axis=0)
             for order in itertools.permutations(range(3))]
    corners = np.array(list(itertools.product(*map(range, cells))))[:, None, None]
    tets = np.ravel_multi_index(np.moveaxis(corners + paths, -1, 0), shape).reshape(-1, 4)
    inverted = np.linalg.det(vertices[tets[:, 1:]] - vertices[tets[:, :1]]) < 0.0
    tets[inverted] = tets[inverted][:, [0, 1, 3, 2]]
    path = OUTPUT / f"{name}.node"
    path.write_text(f"{len(vertices)} 3 0 0\n" + "".join(f"{i} {x!r} {y!r} {z!r}\n" for i, (x, y, z) in
                                                          enumerate(vertices.tolist())))
    path.with_suffix(".ele").write_text(f"{len(tets)} 4 0\n" + "".join(
        f"{i} {' '.join(map(str, tet))}\n" for i, tet in enumerate(tets)))
    return path, vertices


def read(vtu):
    """The vertices and tets of a VTU that the tool has written."""
    text = vtu.read_text()
    points, corners = (text[text.index(mark):].split(">", 1)[1].split("<", 1)[0].split()
                       for mark in ('NumberOfComponents="3"', 'Name="connectivity"'))
    return np.array(points, float).reshape(-1, 3), np.array(corners, int).reshape(-1, 4)


def second_moment(vertices, tets, axis):
    """The integral of squared distance from the centroid along an axis, exactly, over tets."""
    x, volumes = vertices[tets][:, :, axis], np.linalg.det(vertices[tets[:, 1:]] - vertices[tets[:, :1]]) / 6.0
    x = x - (volumes @ x.mean(axis=1)) / volumes.sum()
    return (volumes * ((x**2).sum(axis=1) + x.sum(axis=1)**2)).sum() / 20.0
