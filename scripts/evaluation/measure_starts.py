"""How tracking starts among other things: on 20 layouts of each cluttered scene of the virtual camera, with a rough pose.

The same body without the other things, at the same place and with the same rough pose, gives the error to compare with.
Writes docs/starts.md; recordings and results go to evaluation/. Run by `make starts`.

Usage, in scripts/: python3 -m evaluation.measure_starts [SCENE...]
With scenes: only these are measured, and nothing is written
"""
import concurrent.futures
import os
import sys
import time

from evaluation import starts_tables
from evaluation.runs import OUTPUT, ROOT, ToolFailed
from evaluation.starts import ALONE, NO_POSE, SCENES, SEEDS, alone_run, free_run, scene_run
from replace_file import replace_file

JOBS = 2


def perform(work):
    """The results of all pieces of work, in their order."""
    start = time.monotonic()
    with concurrent.futures.ThreadPoolExecutor(JOBS) as pool:
        futures = [pool.submit(function, *arguments) for function, *arguments in work]
        try:
            for done, _ in enumerate(concurrent.futures.as_completed(futures), 1):
                if done % 20 == 0:
                    print(f"[{done}/{len(futures)}, {time.monotonic() - start:.0f} s]", file=sys.stderr, flush=True)
            return [future.result() for future in futures]
        except ToolFailed:
            pool.shutdown(cancel_futures=True)
            raise


def main():
    scenes = sys.argv[1:] or SCENES
    for scene in scenes:
        if scene not in SCENES:
            print(f"starts: there is no scene {scene}; known are {', '.join(SCENES)}", file=sys.stderr)
            return 2
    # One thread per process, because two processes run side by side.
    os.environ.update({"OPENBLAS_NUM_THREADS": "1", "OMP_NUM_THREADS": "1", "OPENCV_FOR_THREADS_NUM": "1"})
    OUTPUT.mkdir(exist_ok=True)
    try:
        # What the scenes are compared with comes first; most of them share it.
        alone = sorted({ALONE[scene] for scene in scenes})
        perform([(alone_run, scene, seed) for scene in alone for seed in SEEDS])
        starts = perform([(scene_run, scene, seed) for scene in scenes for seed in SEEDS])
        free = perform([(free_run, scene, seed) for scene in NO_POSE if "clutter" in scenes for seed in SEEDS])
    except ToolFailed as error:
        print(f"starts: {error}", file=sys.stderr)
        return 1
    text = starts_tables.document(ROOT, starts, free)
    print(text, end="")
    if scenes == SCENES:
        replace_file(ROOT / "docs/starts.md", text)
    return 0


if __name__ == "__main__":
    sys.exit(main())
