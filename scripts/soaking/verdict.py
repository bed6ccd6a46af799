"""The figures of a soak and their limits."""
import collections
import statistics

Row = collections.namedtuple("Row", "figure measured limit unit passed")

LIFE_S = 240.0  # a process that lived shorter says nothing about its memory
APART_S = 5.0


def row(figure, measured, limit, unit=""):
    return Row(figure, measured, limit, unit, limit is None or (measured is not None and measured <= limit))


def memory_growth(editors):
    """The largest growth of a process with a whole body, from the second to the last quarter of its life [%], and its name. None
    if none lived long enough."""
    growths = []
    for (name, _), samples in [item for editor in editors for item in editor.memory.items()]:
        quarter = len(samples) // 4
        if not quarter or samples[-1][0] - samples[0][0] < LIFE_S:
            continue
        early, late = (statistics.median(size for _, size in part)
                       for part in (samples[quarter:2 * quarter], samples[-quarter:]))
        growths.append((100.0 * (late - early) / early, name))
    return max(growths, default=(None, "no process lived long enough"))


def rows(options, graph, sides, begin, end, calm, editors, killer):
    growth, node = memory_growth(editors)
    judged = not options.crashes_only
    table = [row("nodes that ended by themselves, or did not end when asked", len(graph.faults), 0),
             row("kills", killer.done, None),
             row(f"memory growth with a whole body, over {LIFE_S / 60:.0f} minutes or more ({node})", growth,
                 5.0 if judged and growth is not None else None, "%")]
    for side, editor in zip(sides, editors):
        name = side.namespace
        missing, due = side.unanswered(begin, end - 2.0)
        first, last = side.latency(begin, begin + calm), side.latency(end - calm, end)
        table += [row(f"{name}: frames away from kills", due, None),
                  row(f"{name}: of these without a state", len(missing), 0 if judged else None)]
        for limit, (slowest, victim) in side.slowest_recoveries(end - 5.0):
            table.append(row(f"{name}: longest time from a kill to a new state ({victim})", slowest, limit if judged else 60.0, "s"))
        table += [
            row(f"{name}: longest time with different revisions of volume and surface", side.longest_apart, APART_S, "s"),
            row(f"{name}: latency in the calm at the end / at the beginning", last / first if first and last else None,
                1.2 if judged else None)]
        table += [row(f"{name}: {what}", count, None) for what, count in sorted(editor.counts.items())]
    return table


def show(table, graph, measured):
    begin, end = measured[:2]
    print(f"\n{(end - begin) / 60:.1f} minutes")
    for entry in table:
        value = "none" if entry.measured is None else f"{entry.measured:.6g} {entry.unit}"
        limit = "" if entry.limit is None else f"at most {entry.limit:g} {entry.unit}"
        word = "" if entry.limit is None else "passed" if entry.passed else "FAILED"
        print(f"  {entry.figure:80} {value:>14}  {limit:16} {word}")
    for fault in graph.faults:
        print(f"  {fault}")
    failed = [entry.figure for entry in table if not entry.passed]
    print("soak: passed" if not failed else f"soak: FAILED: {'; '.join(failed)}")
