"""How tracking starts among other things: on 20 layouts of each cluttered scene, with a rough pose.

The same body without the other things, at the same place and with the same rough pose, gives the error to compare with.
Writes docs/measured/starts.md; recordings and results go to evaluation/. Run by `make starts`.

Usage, in scripts/: python3 -m evaluation.starts [SCENE...]
With scenes: only these are measured, and nothing is written
"""
import math
import random
import shutil
import statistics
import sys

from evaluation import bags
from evaluation.figures import frames_of, get
from evaluation.poses import near
from evaluation.runs import object_of, recorded, track, with_pose
from pages import number, publish
from tools import OUTPUT, ToolFailed, chosen, evaluate, perform, use_one_thread

SEEDS = range(1, 21)
TEXTURE, DURATION_S = "weak", "1"
# The scenes, and which of them gives the body without the other things: it is at rest, so most have the same images.
ALONE = {"twin": "twin", "neighbour": "twin", "stack": "twin", "clutter": "twin", "held": "held"}
NO_POSE = ("clutter", "doll_clutter")
ROUGH_M, ROUGH_RAD = 0.012, math.radians(10.0)  # largest error of a rough pose
START_S, WRONG_MM, MOST_RATIO = 0.5, 15.0, 1.2
PARTS = ("all", "visible")


def layout(name, scene, seed, *more):
    return recorded(name, scene, "--texture", TEXTURE, "--seed", seed, "--duration", DURATION_S, *more)


def tracked(name, bag, scene, seed):
    """The result from a rough pose."""
    pose = near(bags.pose(bag), random.Random(seed), ROUGH_M, ROUGH_RAD)
    return track(name, bag, with_pose(object_of(scene), name, pose), "--allow-outside")


def alone_run(scene, seed):
    """Keeps the result of the body alone, for all scenes that are compared with it."""
    name = f"starts_alone_{scene}_{seed}"
    with layout(name, scene, seed, "--no-hands") as bag:
        tracked(name, bag, scene, seed)


def scene_run(scene, seed):
    """(report, report of the body alone on the same truth: also with the same seen vertices)."""
    name = f"starts_{scene}_{seed}"
    with layout(name, scene, seed) as bag:
        result = tracked(name, bag, scene, seed)
        alone = OUTPUT / f"starts_alone_{ALONE[scene]}_{seed}_result.bag"
        reports = evaluate(result, "--truth", bag), evaluate(alone, "--truth", bag)
    result.unlink()
    return reports


def free_run(scene, seed):
    """The report of a body with a picture that is searched in the whole image; an empty report: not found."""
    name = f"starts_free_{scene}_{seed}"
    pictured, report = OUTPUT / name, {}
    with layout(name, scene, seed, "--object", pictured) as bag:
        try:
            result = track(name, bag, pictured)
            report = evaluate(result, "--truth", bag)
            result.unlink()
        except ToolFailed as error:
            if "the body was not found" not in str(error):
                raise
    shutil.rmtree(pictured)
    return report


def tracking_frames(report):
    return [frame for frame in frames_of(report) if frame.state == "tracking"]


def started(report):
    return any(frame.time <= START_S for frame in tracking_frames(report)[:1])


def elsewhere(report):
    return sum(frame.mean is not None and frame.mean > WRONG_MM for frame in tracking_frames(report))


def mean_mm(report, part):
    return get(report, f"vertex_error.{part}.mean_mm")


def ratio(report, alone, part):
    mean, usual = mean_mm(report, part), mean_mm(alone, part)
    return None if mean is None or not usual else mean / usual


def median_of(values, with_largest=False):
    """The median of what was measured, and the largest in parentheses."""
    known = [value for value in values if value is not None]
    if not known:
        return "-"
    return number(statistics.median(known)) + (f" ({number(max(known))})" if with_largest else "")


def start_row(scene, pairs):
    return [f"`{scene}`", f"{sum(started(report) for report, _ in pairs)} of {len(pairs)}",
            *(median_of((ratio(*pair, part) for pair in pairs), True) for part in PARTS),
            *(" / ".join(median_of(mean_mm(report, part) for report in reports) for reports in zip(*pairs))
              for part in PARTS),
            sum(started(pair[0]) and (ratio(*pair, "all") or math.inf) <= MOST_RATIO for pair in pairs),
            sum(elsewhere(report) for report, _ in pairs)]


def outcome(report):
    if not tracking_frames(report):
        return "not found"
    return "wrong" if elsewhere(report) else "right"


def free_row(scene, reports):
    outcomes = [*map(outcome, reports)]
    return [f"`{scene}`", *(outcomes.count(which) for which in ("right", "not found", "wrong"))]


def by_scene(function, scenes):
    """(scene, the results of a function of scene and seed)."""
    results = iter(perform([(f"{scene}, seed {seed}", function, scene, seed) for scene in scenes for seed in SEEDS]))
    return [(scene, [next(results) for _ in SEEDS]) for scene in scenes]


def main():
    scenes = chosen(ALONE, sys.argv[1:])
    use_one_thread()
    OUTPUT.mkdir(exist_ok=True)
    # What the scenes are compared with comes first; most of them share it.
    by_scene(alone_run, sorted({ALONE[scene] for scene in scenes}))
    starts, free = by_scene(scene_run, scenes), by_scene(free_run, NO_POSE if "clutter" in scenes else ())
    publish("measured/starts.md", "starts", {"With a rough pose": [start_row(*found) for found in starts],
                                             "Without a pose": [free_row(*found) for found in free]},
            complete=scenes == list(ALONE))


if __name__ == "__main__":
    main()
