"""What the simulator does with the settings of the node, against theory."""
from markdown_lines import paragraph, table

from validation.held_specimens import beam_rows, specimen_rows, weight_rows
from validation.moving_blocks import drop_rows, incline_rows, push_rows, roll_rows


def node_sections():
    lines = ["## With the settings of the node", "",
             *paragraph("These runs use `--node-defaults`: every setting is that of the node `simulator` without "
                        "parameters, at 30 steps per second. References with other settings stand beside them. The "
                        "block has 80 x 80 x 40 mm and 192 tets. Distances of theory are those of implicit Euler "
                        "under a constant acceleration.")]
    return "\n".join([*lines, "", *moving_sections(), *held_sections()]).rstrip().split("\n")


def moving_sections():
    return ["### Slope", "",
            *paragraph("The block slides down a slope for a second; the ratio is its way, divided by theory (mu: "
                       "coefficient of friction). At 0.9 times the slope of friction it sticks. Then the creep is "
                       "the way of its base in the second second, when it has come to rest."), "",
            *table(["E [Pa]", "density", "mu 0, slope 0.2", "mu 0.3, slope 0.6", "mu 1, slope 1.5", "creep, mu 0.3 [mm]",
                    "creep, mu 1 [mm]"], incline_rows()),
            "### Push, drag and pull", "",
            *paragraph("A box pushes the block over a table at 30 mm/s, or its upper rear edge is dragged. The ratio "
                       "is the mean force, divided by mu times the force on the table. In the last column a force of "
                       "1.5 times friction pulls it: way in a second, divided by theory."), "",
            *table(["E [Pa]", "density", "mu", "push", "drag", "pull"], push_rows()),
            "### Drop", "",
            *paragraph("The block falls 100 mm onto a table. It rests when no vertex is faster than 1 mm/s any more. "
                       "The depth is that of the deepest vertex in the table. The force is that on the table at the "
                       "end, divided by the weight."), "",
            *table(["E [Pa]", "density", "rests after [s]", "largest depth [mm]", "depth at rest [mm]",
                    "force / weight"], drop_rows()),
            "### Roll", "",
            *paragraph("A ball and a cylinder of 100 mm diameter roll down a slope for a second. The ratio is the "
                       "way, divided by that of a rigid ball or cylinder. The bodies are polyhedra, so they roll "
                       "unevenly. The columns are steps per second. On the steeper slope the ball turns by more than "
                       "a radian per step at the end, with 30 steps per second."), "",
            *table(["body", "slope", "30", "120"], roll_rows())]


def held_sections():
    return ["### Beams up to a Poisson's ratio of 0.49", "",
            *paragraph("A beam of 100 x 30 x 30 mm bends under a small weight. The values are the deflection of its "
                       "end, divided by the reference of the section [Nearly incompressible "
                       "material](#nearly-incompressible-material), for three Poisson's ratios."), "",
            *table(["settings", "cells across", "0.2", "0.45", "0.49"], beam_rows()),
            "### Weight on the pins", "",
            *paragraph("A sponge is held at one end. The values are the force on its pins at rest, divided by its "
                       "weight, or what the program says."), "",
            *table(["E [Pa]", "as the node", "pd, 20000 iterations", "fem"], weight_rows()),
            "### Stretched, twisted and two-material specimens", "",
            *paragraph("One end of a bar of 200 x 20 x 20 mm is held, the other moves or turns (`--move`, `--turn`). "
                       "The values are the force or torque on the moved end, divided by theory: E A / l, springs in "
                       "a row and side by side, Saint-Venant's G J / l. The stiffer material (`--material`) has 10 "
                       "times the E of the other. The sandwich of 400 x 20 x 40 mm has stiff layers of 10 mm; its "
                       "deflection is divided by that of the transformed section with the shear of its core."), "",
            *table(["specimen", "as the node", "fem"], specimen_rows())]
