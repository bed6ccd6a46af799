"""The text of docs/validation.md."""
from markdown_lines import paragraph, table

from validation.as_the_node import node_sections
from validation.comparisons import agreement_rows, bending_rows, formulation_rows, prism_rows, recovery_rows
from validation.friction import friction_rows
from validation.incompressible import RATIOS, incompressible_rows
from validation.refinement import SMOOTHED, STUDIES, smoothing_rows


def document(studies):
    lines = ["# Validation of the simulator", "",
             *paragraph("Written by `make validation`, which compares the [simulator](pipeline/simulation.md) with "
                        "known solutions. Every measured value comes from a run of `rosrun softbody_sim simulate`. "
                        "The meshes are boxes made by `scripts/validate`, or published meshes. The tets (tetrahedra) "
                        "are linear. A cell of a box is a cuboid of six tets."),
             "", *node_sections(),
             "", "## Refinement against known solutions", "",
             *paragraph("The solver is FEM, static, with corotated elasticity and without smoothing. The list gives the place or quantity "
                        "that is compared, and the reference. The ratio is the result divided by the reference. The "
                        "order is the order of convergence of the error between two rows. nu is Poisson's ratio."),
             "", "![error over refinement](images/validation.svg)", ""]
    for name, (_, _, text) in STUDIES.items():
        lines.append(f"- {name}: {text}")
    rows = [(name, n, tets, f"{ratio:.4f}", "" if order is None else f"{order:.2f}")
            for study in studies.values() for name, n, tets, ratio, order in study]
    lines += ["", *table(["problem", "cells across", "tets", "ratio", "order"], rows)]
    lines += ["The cantilever converges to Timoshenko's solution, which includes shear. For this beam, shear adds 0.6 %.", ""]
    return "\n".join([*lines, *smoothing_sections(), *energy_sections(), *agreement_section()])


def smoothing_sections():
    """What averaging strains around the vertices changes."""
    lines = ["## Smoothed strains", "",
             *paragraph("The same problems and ratios, with few cells across and with the solver PD (projective "
                        "dynamics). The number in a column head is the number of cells. The share is the part of "
                        "the elastic energy whose strains are averaged around the vertices (`--strain-smoothing` "
                        "and `--volume-smoothing`). A ratio above 1 means that the result is too soft."), "",
             *table(["share", *(f"{name} {n}" for name, n in SMOOTHED)], smoothing_rows())]
    lines += ["## Nearly incompressible material", "",
              *paragraph("The beam has 100 x 30 x 30 mm and bends under a small weight. Cook's membrane is 10 thick. The "
                         "values are deflections of the free end, divided by the reference "
                         "`scripts/validation/mixed_reference.py`. This is another program, with hexahedra that have a "
                         "pressure of their own. \"Smoothing\" gives the two shares, of strain and of volume. The "
                         "last columns are Poisson's ratios. Where volume is not smoothed completely, the tets lock. Without "
                         "the option, the share of volume follows from Poisson's ratio."), "",
              *table(["problem", "cells across", "solver", "smoothing", *map(str, RATIOS)], incompressible_rows())]
    prisms = prism_rows()
    if prisms:
        lines += ["## Published beam meshes", "",
                  *paragraph("The beams are clamped at one end, with a small gravity and Poisson's ratio 0. The "
                             "reference is the deflection by bending and shear, with the area and the second moment "
                             "of area of the mesh itself. The first beam has one cell through its thickness and "
                             "three across its width. The last beam is short."), "",
                  *table(["mesh", "tets", "length / radius of gyration", "ratio"], prisms)]
    return lines


def energy_sections():
    """Comparisons of the elastic energies and solvers with each other and with another formulation."""
    return ["## Another corotational formulation", "",
            *paragraph("A beam of 160 x 30 x 30 mm with 288 tets bends under its own weight. With the two smaller "
                       "values of E the displacements are large. The reference is "
                       "`scripts/validation/corotational_reference.py`, which shares no code with the simulator. It "
                       "adds the forces R K (R^T x - X) of each tet, like SOFA's TetrahedronFEMForceField with polar "
                       "decomposition. The last column is the distance between the two tips, "
                       "divided by the move of the reference's tip."), "",
            *table(["E [Pa]", "Poisson", "solver", "tip moves by x, z [mm]", "distance / move"], formulation_rows()),
            "## Bending at Poisson 0.45", "",
            *paragraph("The end of a bar of 200 x 100 x 30 mm with E = 20 kPa is pulled sideways by 0.35 N. Strains "
                       "are not smoothed. Corotated elasticity preserves volume only to first order."), "",
            *table(["solver", "deflection [mm]", "volume change [%]"],
                   [(name, f"{deflection:.1f}", f"{change:+.2f}") for name, deflection, change in bending_rows()]),
            "## Friction", "",
            *paragraph("A block of 80 x 80 x 40 mm lies on an incline. It slides if it moves by more than 1 mm in one "
                       "second. Bisection finds the angle at which it starts. The reference is the arc tangent of the "
                       "coefficient of friction. The last column is the largest move in a second at 98 % of the "
                       "reference's slope, where the block should stick."), "",
            *table(["solver", "coefficient", "angle [degrees]", "angle / reference", "creep [mm]"], friction_rows()),
            "## Recovery", "",
            *paragraph("A free sponge (300 tets) starts flat, mirrored through a point, or with random vertices. It "
                       "is simulated for 150 steps of 1/30 s. The columns \"first\" and \"last\" give the elastic "
                       "energy after the first and the last step. The distance is the largest distance of a vertex "
                       "from the rest shape."), "",
            *table(["solver", "start", "first [J]", "last [J]", "distance [mm]"],
                   [(name, start, f"{first:.2e}", f"{last:.1e}", f"{distance:.1e}")
                    for name, start, first, last, distance in recovery_rows()])]


def agreement_section():
    rows = agreement_rows()
    if not rows:
        return ["## PD and FEM at rest", "", "Skipped: ../shared/data/meshes/tet is missing.", ""]
    return ["## PD and FEM at rest", "",
            *paragraph("PD and FEM compute the static equilibrium with the same corotated energy. The lowest quarter "
                       "of each mesh is held. Gravity is 0.005 E / (rho H), where H is the height of the mesh. "
                       "Distances are in units of the diagonal of the mesh."), "",
            *table(["mesh", "vertices", "largest move", "distance of PD from FEM"],
                   [(name, count, f"{moved:.4f}", f"{apart:.1e}") for name, count, moved, apart in rows])]
