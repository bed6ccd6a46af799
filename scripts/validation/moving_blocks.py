"""Free bodies in contact, with the settings of the node: slopes, pushes, drops and rolling."""
import itertools
import math

import numpy as np

from validation.simulate_tool import NODE, box, simulate

GRAVITY, FRAME, SECOND = 9.81, 1.0 / 30.0, 30
SIZE = np.array([0.08, 0.08, 0.04])
BASE, LEFT = "z<1e-9", "x<1e-9"


def block():
    return box("block", (4, 4, 2), lambda x, y, z: SIZE * (x, y, z))[0]


def slope(value):
    """The option for gravity on a slope that falls along x."""
    angle = math.atan(value)
    return "--gravity", GRAVITY * math.sin(angle), 0, -GRAVITY * math.cos(angle)


def distance(acceleration, steps=SECOND, step_s=FRAME):
    """The way of implicit Euler under a constant acceleration, from rest."""
    return acceleration * step_s**2 * steps * (steps + 1) / 2.0


def slide(mesh, young, density, friction, tilt, steps=SECOND):
    return simulate(mesh, *NODE, "--young", young, "--density", density, "--damping", 0, *slope(tilt), "--ground", 0,
                    "--friction", friction, "--steps", steps, "--probe", BASE)


def incline_rows():
    """Distance in a second where the block slides, and creep in a second where it sticks."""
    mesh = block()
    for young, density in itertools.product((5e3, 1e5, 5e6), (30, 300, 1000)):
        ratios, creeps = [], []
        for friction, tilt in ((0.0, 0.2), (0.3, 0.6), (1.0, 1.5)):
            angle = math.atan(tilt)
            expected = distance(GRAVITY * (math.sin(angle) - friction * math.cos(angle)))
            ratios.append(slide(mesh, young, density, friction, tilt)[-1]["probe_x_m"] / expected)
        for friction in (0.3, 1.0):
            table = slide(mesh, young, density, friction, 0.9 * friction, 2 * SECOND)
            creeps.append(1e3 * (table[-1]["probe_x_m"] - table[SECOND - 1]["probe_x_m"]))
        yield (f"{young:g}", density, *(f"{ratio:.3f}" for ratio in ratios), *(f"{creep:.3f}" for creep in creeps))


def push_rows():
    """Forces of friction, relative to the coefficient of friction."""
    mesh = block()
    ratio = lambda force, weight: force / weight if weight else math.nan
    for young, density, friction in itertools.product((5e3, 1e5, 1e6), (30, 300), (0.3, 0.8)):
        weight = density * SIZE.prod() * GRAVITY
        common = (*NODE, "--young", young, "--density", density, "--damping", 0, "--gravity", 0, 0, -GRAVITY, "--ground", 0,
                  "--friction", friction, "--steps", 2 * SECOND, "--probe", "all")
        pushed = simulate(mesh, *common, "--pusher", -0.012, 0.04, 0.015, 0.02, 0.12, 0.02, 0.06, 0, 0)[SECOND:]
        dragged = simulate(mesh, *common, "--move", f"{LEFT} & z>0.039", -0.06, 0, 0)[SECOND:]
        loaded = simulate(mesh, *common, "--load", "all", 1.5 * friction * weight, 0, 0)[SECOND - 1]
        force = sum(-row["pusher_1_x_n"] for row in pushed) / len(pushed) / weight
        drag = sum(ratio(-row["region_1_x_n"], row["ground_z_n"]) for row in dragged) / len(dragged)
        yield (f"{young:g}", density, friction, f"{force / friction:.3f}", f"{drag / friction:.3f}",
               f"{loaded['probe_x_m'] / distance(0.5 * friction * GRAVITY):.3f}")


def drop_rows():
    """A block that falls 100 mm onto a table."""
    mesh = block()
    for young, density in itertools.product((500.0, 5e3, 1e5, 1e6), (30, 300)):
        table = simulate(mesh, *NODE, "--young", young, "--density", density, "--gravity", 0, 0, -GRAVITY, "--ground", -0.1,
                         "--friction", 0.5, "--steps", 3 * SECOND)
        moving = [row["time_s"] for row in table if row["speed_m_s"] > 1e-3]
        rest = f"{moving[-1]:.2f}" if moving[-1] < table[-1]["time_s"] else "never"
        weight = density * SIZE.prod() * GRAVITY
        yield (f"{young:g}", density, rest, *(f"{1e3 * depth:.3f}" for depth in
                                               (max(row["depth_m"] for row in table), table[-1]["depth_m"])),
               f"{-table[-1]['ground_z_n'] / weight:.3f}")


def ball(x, y, z):
    """Maps a cube onto a ball."""
    a, b, c = 2.0 * np.array([x, y, z]) - 1.0
    return 0.05 * np.array([a * math.sqrt(1.0 - (b * b + c * c) / 2.0 + b * b * c * c / 3.0),
                            b * math.sqrt(1.0 - (c * c + a * a) / 2.0 + c * c * a * a / 3.0),
                            c * math.sqrt(1.0 - (a * a + b * b) / 2.0 + a * a * b * b / 3.0)])


def cylinder(x, y, z):
    a, c = 2.0 * x - 1.0, 2.0 * z - 1.0
    return 0.05 * np.array([a * math.sqrt(1.0 - c * c / 2.0), 2.0 * y, c * math.sqrt(1.0 - a * a / 2.0)])


def roll_rows():
    """Round bodies on a slope: the moment of inertia takes its part of the acceleration."""
    for (name, shape, cells, inertia), tilt in itertools.product(
            (("ball", ball, (10, 10, 10), 0.4), ("cylinder", cylinder, (16, 1, 16), 0.5)), (0.1, 0.3)):
        mesh, rest = box(name, cells, shape)
        acceleration = GRAVITY * math.sin(math.atan(tilt)) / (1.0 + inertia)
        ratios = []
        for rate in (30, 120):
            way = simulate(mesh, *NODE, "--young", 1e5, "--density", 300, "--damping", 0, *slope(tilt), "--ground",
                           rest[:, 2].min(), "--friction", 0.8, "--steps", rate, "--time-step", 1 / rate, "--probe",
                           "all")[-1]["probe_x_m"]
            ratios.append(f"{way / distance(acceleration, rate, 1 / rate):.3f}")
        yield (name, tilt, *ratios)


def friction_rows():
    """The slope at which a block begins to slide."""
    mesh = block()

    def moved(solver, friction, tilt):
        return simulate(mesh, "--solver", solver, "--young", 1e6, "--density", 1000, "--damping", 0, *slope(tilt),
                        "--ground", 0, "--friction", friction, "--steps", 60, "--time-step", 1 / 60, "--probe",
                        "z<1")[-1]["probe_x_m"]

    for solver in ("pd", "fem"):
        for friction in (0.2, 0.5, 1.0):
            low, high = 0.5 * friction, 1.5 * friction
            while high - low > 1e-3 * friction:
                middle = 0.5 * (low + high)
                low, high = (low, middle) if moved(solver, friction, middle) > 1e-3 else (middle, high)
            angle, reference = math.atan(high), math.atan(friction)
            yield (solver, friction, f"{math.degrees(angle):.2f}", f"{angle / reference:.4f}",
                   f"{1e3 * moved(solver, friction, 0.98 * friction):.3f}")
