"""docs/latency.md, from the rows of measure_latency.py."""
import datetime

from evaluation.document import commit, processor
from evaluation.figures import number
from live.streams import SURFACE
from markdown_lines import paragraph, table

NODES = ["camera_ingest", "feature_tracker", "simulator", "surface", "transport"]
LATENCIES = ["median", "p95", "p99", "worst"]


def body(row):
    return "doll" if row["scene"].startswith("doll_") else "sponge"


def kind(row):
    return [body(row), "bag" if row["bag"] else "camera", "nodelets" if row["nodelets"] else "nodes", row["size"], row["rate_hz"]]


def latency_cells(row):
    figures = row["figures"]
    if figures is None:
        return ["-", "failed", *["-"] * (1 + len(LATENCIES))]
    mesh = figures["streams"][SURFACE]
    latency = mesh.get("latency_ms") or {}
    answered = f"{mesh.get('answered', 0)} of {mesh['due']}" + (", failed" if row["complaint"] else "")
    return [number(figures["frames"] / figures["seconds"], 1), answered,
            *[number(latency.get(name), 1) for name in LATENCIES], number(figures["load"], 1)]


def cpu_cells(row):
    figures = row["figures"]
    if figures is None:
        return ["-"] * (len(NODES) + 2)
    cpu = figures["cpu"]
    return [*[number(cpu["nodes_ms"].get(name, 0.0), 1) for name in NODES], number(cpu["graph_ms"], 1),
            "-" if row["bag"] else number(cpu["camera_ms"], 1)]


def failures(rows):
    failed = [row for row in rows if row["complaint"]]
    if not failed:
        return []
    return ["## Failed", "", *paragraph("`scripts/measure_live` complains about these rows:"), "",
            *[f"- {', '.join(map(str, kind(row)))} Hz: {row['complaint']}" for row in failed], ""]


def document(root, rows):
    columns = ["body", "images from", "as", "px", "Hz"]
    lines = ["# Latency", "",
             f"Written by `make latency` on {datetime.date.today()} at commit {commit(root)}, on {processor()}.", "",
             *paragraph("`scripts/measure_live` runs the live graph of scenes bend and doll_bend, each row for some seconds after "
                        "the first mesh ([definitions](metrics.md#the-live-graph)). The camera works on the same machine. A bag is "
                        "recorded at 30 Hz, and played at twice its speed for 60 Hz."), "",
             "## From image to mesh", "",
             *paragraph("In ms, from the moment when the image is published to the moment when another process receives the mesh. "
                        "Images: how many a second came; a slow camera sends fewer than Hz. Answered: images with a mesh. "
                        "Load: load average of the machine, with the graph itself. `-`: not measured."), "",
             *table([*columns, "images/s", "answered", *LATENCIES, "load"], [[*kind(row), *latency_cells(row)] for row in rows]),
             "## CPU time", "",
             *paragraph("In ms per image: the callbacks of each node, the transport of messages, and the whole graph without the "
                        "camera or the player of the bag."), "",
             *table([*columns, *NODES, "graph", "camera"], [[*kind(row), *cpu_cells(row)] for row in rows]),
             *failures(rows)]
    return "\n".join(lines).rstrip() + "\n"
