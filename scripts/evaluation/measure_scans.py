"""How right models from recordings are: records walks round three bodies, scans them, and compares with the true meshes.

Then scans recordings with faults: each must give a right model, or no model and a reason. At last it tracks scenes with
scanned models and with the true mesh. Writes docs/scans.md; recordings (some 900 MB each), models and results go to
evaluation/scans. Each recording is removed after its last use. Run by `make scans`.

Usage, in scripts/: python3 -m evaluation.measure_scans [--keep] [--page] [ROW...]
With rows: only these are measured, and nothing is written
  --keep   keeps the recordings; a later run uses them again
  --page   measures nothing, and writes docs/scans.md from the results that evaluation/scans has
"""
import sys
import time

from evaluation import scan_tracking, scans_tables
from evaluation.runs import ROOT, ToolFailed
from evaluation.scans import faulty_rows, good_rows, make_bodies, measure, measured
from replace_file import replace_file


def lines_of(row, result):
    if row in scan_tracking.scenes():
        rows = scans_tables.tracking_rows(row, result)
    else:
        rows = [(scans_tables.faulty_row if row in faulty_rows() else scans_tables.good_row)(row, result)]
    return "\n".join(" | ".join(cells) for cells in rows)


def perform(rows, keep):
    make_bodies()
    start = time.monotonic()
    for done, row in enumerate(rows, 1):
        result = (scan_tracking.measure if row in scan_tracking.scenes() else measure)(row)
        print(f"[{done}/{len(rows)}, {time.monotonic() - start:.0f} s] {lines_of(row, result)}", file=sys.stderr, flush=True)
        later = {recording for other in rows[done:] for recording in other.recordings}
        for recording in {*row.recordings} - later:
            if not keep:
                recording.path.unlink(missing_ok=True)


def main():
    options = [word for word in sys.argv[1:] if word.startswith("--")]
    known = {row.name: row for row in [*good_rows(), *faulty_rows(), *scan_tracking.scenes()]}
    names = [word for word in sys.argv[1:] if word not in options]
    for word in [*(set(options) - {"--keep", "--page"}), *(set(names) - known.keys())]:
        print(f"scans: there is no row {word}; known are {', '.join(known)}", file=sys.stderr)
        return 2
    try:
        if "--page" not in options:
            perform([known[name] for name in names or known], "--keep" in options)
    except ToolFailed as error:
        print(f"scans: {error}", file=sys.stderr)
        return 1
    if not names:
        rows = map(measured, (good_rows(), faulty_rows(), scan_tracking.scenes()))
        replace_file(ROOT / "docs/scans.md", scans_tables.document(*rows))
    return 0


if __name__ == "__main__":
    sys.exit(main())
