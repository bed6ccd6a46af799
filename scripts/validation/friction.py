"""A block on an incline."""
import math

from validation.simulate_tool import box, simulate


def friction_rows():
    mesh, _ = box("block", (4, 4, 2), lambda x, y, z: (0.08 * x, 0.08 * y, 0.04 * z))

    def moved(solver, friction, slope):
        angle = math.atan(slope)
        row = simulate(mesh, "--solver", solver, "--young", 1e6, "--density", 1000, "--damping", 0, "--gravity",
                       9.81 * math.sin(angle), 0, -9.81 * math.cos(angle), "--ground", 0, "--friction", friction, "--steps", 60,
                       "--time-step", 1 / 60, "--probe", "z<1")[-1]
        return row["probe_x_m"]

    for solver in ("pd", "fem"):
        for friction in (0.2, 0.5, 1.0):
            low, high = 0.5 * friction, 1.5 * friction
            while high - low > 1e-3 * friction:
                middle = 0.5 * (low + high)
                low, high = (low, middle) if moved(solver, friction, middle) > 1e-3 else (middle, high)
            angle, reference = math.atan(high), math.atan(friction)
            yield (solver, friction, f"{math.degrees(angle):.2f}", f"{angle / reference:.4f}",
                   f"{1e3 * moved(solver, friction, 0.98 * friction):.3f}")
