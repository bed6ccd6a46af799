"""How far a long work is, on stderr: a bar on a terminal, a line now and then in a log."""
import sys

BAR_WIDTH, LOG_LINES = 40, 4


def with_progress(items, count, stream=None):
    """Hands on the items, and shows how many of `count` are done. The bar ends with the items, or with an exception."""
    stream = stream or sys.stderr
    is_terminal = stream.isatty()
    done = 0
    try:
        for done, item in enumerate(items, 1):
            yield item
            if is_terminal:
                filled = min(BAR_WIDTH, BAR_WIDTH * done // max(count, 1))
                stream.write(f"\r[{'#' * filled}{' ' * (BAR_WIDTH - filled)}] frame {done} of {count}")
                stream.flush()
            elif done % max(1, -(-count // LOG_LINES)) == 0:
                print(f"frame {done} of {count}", file=stream, flush=True)
    finally:
        if is_terminal and done:
            stream.write("\n")
