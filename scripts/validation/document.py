"""The text of docs/validation.md."""
from markdown_lines import paragraph, table

from validation.comparisons import agreement_rows, bending_rows, formulation_rows, prism_rows, recovery_rows
from validation.refinement import SMOOTHED, STUDIES, smoothing_rows


def document(studies):
    lines = ["# Validation of the simulator", "",
             *paragraph("Written by `make validation`. It compares the [simulator](pipeline/simulation.md) with known "
                        "solutions. Every figure comes from a run of `rosrun softbody_sim simulate`. Meshes are "
                        "boxes made by `scripts/validate`, or published meshes. Tets are linear; a cell of a box is a cuboid of "
                        "six tets."),
             "", "## Refinement against known solutions", "",
             *paragraph("Solver FEM, corotated elasticity, static. Ratio: result over reference. Order: order of "
                        "convergence of the error between two rows. nu: Poisson's ratio."),
             "", "![error over refinement](images/validation.svg)", ""]
    for name, (_, _, text) in STUDIES.items():
        lines.append(f"- {name}: {text}")
    rows = [(name, n, tets, f"{ratio:.4f}", "" if order is None else f"{order:.2f}")
            for study in studies.values() for name, n, tets, ratio, order in study]
    lines += ["", *table(["problem", "cells across", "tets", "ratio", "order"], rows)]
    lines += ["The cantilever converges to the solution of Timoshenko. At this slenderness shear adds 0.6 %.", ""]
    lines += ["## Smoothed strains", "",
              *paragraph("The same problems and ratios with few cells across; the column heads give their number. "
                         "Solver PD. The share is that of the energy whose strains are averaged around the vertices: "
                         "`--strain-smoothing`, in the graph 0.7 by default. A ratio above 1 is too soft."), "",
              *table(["share", *(f"{name} {n}" for name, n in SMOOTHED)], smoothing_rows())]
    prisms = prism_rows()
    if prisms:
        lines += ["## Published beam meshes", "",
                  *paragraph("Beams clamped at one end, under a small gravity, Poisson's ratio 0. The reference is "
                             "the deflection by bending and shear, with area and second moment of the mesh itself. "
                             "The first beam has one cell through its thickness and three across. The last is "
                             "short."), "",
                  *table(["mesh", "tets", "length / radius of gyration", "ratio"], prisms)]
    return "\n".join([*lines, *energy_sections(), *agreement_section()])


def energy_sections():
    """Comparisons of the elastic energies and solvers with each other and with another formulation."""
    return ["## Another corotational formulation", "",
            *paragraph("A beam of 160 x 30 x 30 mm, 288 tets, bends under its own weight. In the last two cases the "
                       "displacements are large. The reference adds forces R K (R^T x - X) per tet, like SOFA's "
                       "TetrahedronFEMForceField with polar decomposition. It is in "
                       "`scripts/validation/corotational_reference.py`, and shares no code with the simulator."), "",
            *table(["E [Pa]", "Poisson", "solver", "tip moves by x, z [mm]", "distance / move"], formulation_rows()),
            "## Bending at Poisson 0.45", "",
            *paragraph("The end of a bar of 200 x 100 x 30 mm, E = 20 kPa, is pulled by 0.35 N. Linear tets lock if "
                       "the material is almost incompressible. Corotated elasticity preserves volume only "
                       "to first order."), "",
            *table(["solver", "deflection [mm]", "volume change [%]"],
                   [(name, f"{deflection:.1f}", f"{change:+.2f}") for name, deflection, change in bending_rows()]),
            "## Recovery", "",
            *paragraph("A free sponge (300 tets) starts flat, mirrored through a point, or with random vertices. It "
                       "is simulated for 150 steps of 1/30 s. First, last: elastic energy after the first and the "
                       "last step. Distance: largest distance from the rest shape."), "",
            *table(["solver", "start", "first [J]", "last [J]", "distance [mm]"],
                   [(name, start, f"{first:.2e}", f"{last:.1e}", f"{distance:.1e}")
                    for name, start, first, last, distance in recovery_rows()])]


def agreement_section():
    rows = agreement_rows()
    if not rows:
        return ["## PD and FEM at rest", "", "Skipped: ../shared/data/meshes/tet is missing.", ""]
    return ["## PD and FEM at rest", "",
            *paragraph("Static equilibria with the same corotated energy. The lowest quarter is held; gravity is "
                       "0.005 E / (rho H). Distances are in units of the diagonal."), "",
            *table(["mesh", "vertices", "largest move", "PD from FEM"],
                   [(name, count, f"{moved:.4f}", f"{apart:.1e}") for name, count, moved, apart in rows])]
