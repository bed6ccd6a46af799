"""The goals, and whether they are reached."""
import math

from evaluation.figures import (DEPTH_HOLES, FEW_FEATURES, MOVING, NOISE_FREE, WRONG_MATCH_SEEDS, fault_times, get,
                                moving_times, number, worst, wrong_matches)
from evaluation.world_goals import world_goals
from markdown_lines import table


def goals(reports):
    """(figure, goal, unit, value): reached if the value is at most, or for a goal with >= at least, the goal."""
    def scene(name, *keys):
        return get(reports.get(("scene", name)), *keys)

    def of(kind, *keys):
        return worst(get(reports.get((kind, name)), "vertex_error", *keys) for name in NOISE_FREE)

    def fault(name):
        return worst(fault_times(reports, scene_name, name) for scene_name in WRONG_MATCH_SEEDS)

    def absence(name, *keys):
        found = scene(name, "absences")
        return get(found[0], *keys) if found else None

    def recovery(name):
        """Seconds; infinite: never."""
        if absence(name, "end_s") is None:
            return None
        seconds = absence(name, "recovery_s")
        return math.inf if seconds is None else seconds

    def toy(kind, *keys):
        return get(reports.get((kind, "toys")), "depth_residual", "all", *keys)

    def toy_within(kind):
        """Over all frames: a frame without a surface counts as 0 %."""
        share, frames = toy(kind, "within_10mm"), get(reports.get((kind, "toys")), "frames")
        return None if share is None else 100.0 * share * frames["answered"] / frames["expected"]

    pieces = [piece["mean_mm"] for piece in scene("cut", "vertex_error", "pieces") or []]
    sponge, faulty = ", ".join(NOISE_FREE), ", ".join(WRONG_MATCH_SEEDS)
    seeds = ", ".join(f"{name} ({len(drawn)} seeds)" for name, drawn in WRONG_MATCH_SEEDS.items())
    return [
        (f"mean error of visible vertices, worst of {sponge}; no noise", "<= 0.5", "mm",
         of("noise off", "visible", "mean_mm")),
        ("the same, with noise", "<= 1.0", "mm", of("scene", "visible", "mean_mm")),
        ("mean error of hidden vertices, worst of the same", "<= 2.0", "mm", of("scene", "hidden", "mean_mm")),
        *((f"{name}: error of all vertices, p95", "<= 3.0", "mm", scene(name, "vertex_error", "all", "p95_mm"))
          for name in NOISE_FREE),
        ("bend for 60 s: mean error of the last 5 s over that of the first 5 s", "<= 1.1", "times",
         get(reports.get(("long", "bend")), "vertex_error", "drift_ratio")),
        ("still: jitter, RMS", "<= 0.2", "mm", scene("still", "jitter", "per_vertex", "rms_mm")),
        ("occlude: mean error of the hidden part", "<= 4.0", "mm", absence("occlude", "covered", "mean_mm")),
        ("occlude: time until the error is at most 1.2 times that without the hand", "<= 0.3", "s",
         recovery("occlude")),
        ("leave: time until the error is at most 1.2 times that before", "<= 1.0", "s", recovery("leave")),
        ("shake: frames with a mean error of at most 10 mm", ">= 100", "%", followed(reports.get(("scene", "shake")))),
        (f"{DEPTH_HOLES}: error divided by that without, worst of {faulty}", "<= 1.2", "times", fault(DEPTH_HOLES)),
        (f"20 % wrong matches: the same, worst of {seeds}", "<= 1.2", "times",
         worst(fault_times(reports, name, wrong_matches(seed))
               for name, drawn in WRONG_MATCH_SEEDS.items() for seed in drawn)),
        (f"{FEW_FEATURES}: the same, worst of {faulty}", "<= 1.2", "times", fault(FEW_FEATURES)),
        (f"moving camera: error over that of a fixed camera, worst of {', '.join(MOVING)}", "<= 1.2", "times",
         worst(moving_times(reports).get(name) for name in MOVING)),
        ("cut: largest distance between the cut surface and the true one", "<= 2.0", "mm",
         worst(scene("cut", "cut_surface", way, "max_mm") for way in ("distance", "missed"))),
        ("cut: angle between the cut surface and the true one", "<= 2.0", "deg",
         scene("cut", "cut_surface", "tilt_deg")),
        ("cut: mean error of the worse piece", "<= 2.5", "mm", worst(pieces)),
        ("recorded toy: depth residual, median", "<= 4.0", "mm", toy("toys", "residual", "median_mm")),
        ("recorded toy: measured pixels within 10 mm", ">= 90", "%", toy_within("toys")),
        ("recorded toy without a rough pose: the same", ">= 90", "%", toy_within("no pose")),
    ]


def followed(report):
    """Share of all frames with a small error [%]; an unanswered frame counts as lost."""
    means = get(report, "vertex_error", "frame_mean_mm")
    return None if means is None else 100.0 * sum(mean <= 10.0 for mean in means) / report["frames"]["expected"]


def verdict(goal, unit, value):
    """The cells goal, measured and reached."""
    relation, limit = goal.split()
    reached = value is not None and (value <= float(limit) if relation == "<=" else value >= float(limit))
    measured = "never" if value == math.inf else number(value)
    return [f"{goal} {unit}", measured, "-" if value is None else "yes" if reached else "no"]


def goal_table(reports):
    rows = [[figure, *verdict(goal, unit, value)]
            for figure, goal, unit, value in [*goals(reports), *world_goals(reports)]]
    return table(["figure", "goal", "measured", "reached"], rows)
