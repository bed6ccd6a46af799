"""Which states of a bag are exported."""
from softbody.export.errors import ExportError


def select(states, begin_s=0.0, end_s=float("inf"), step=1):
    """(seconds since the first state of the bag, state) of every `step`-th state between two times.

    @throw ExportError if there is none, or if stamps jump back.
    """
    first = last = None
    count = 0
    for state in states:
        first = state.stamp if first is None else first
        time = (state.stamp - first).to_sec()
        if last is not None and time <= last:
            raise ExportError(f"the stamps jump back from {last:.3f} s to {time:.3f} s, as in a bag that was played in a "
                              f"loop; --to {last!r} exports what is before")
        if time > end_s:
            break
        last = time
        if time >= begin_s:
            if count % step == 0:
                yield time, state
            count += 1
        if time >= end_s:
            break
    if count == 0:
        raise ExportError(_nothing(last, begin_s, end_s))


def _nothing(last, begin_s, end_s):
    if last is None:
        return "no state has its topology in the bag; make it again with replay"
    until = "" if end_s == float("inf") else f" and before {end_s:g} s"
    return f"no state is {begin_s:g} s or more after the first{until}; the last one that was read is at {last:.3f} s"
