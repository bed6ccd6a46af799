"""Measured tables in pages. A page has its words and the heads of its tables; scripts write the rows, and where they
come from."""
import datetime
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import textwrap

ROOT = pathlib.Path(__file__).resolve().parent.parent


def number(value, digits=2):
    return "-" if value is None else f"{value:.{digits}f}"


def percent(value, digits=1):
    return "-" if value is None else f"{100.0 * value:.{digits}f}"


def row_of(cells):
    return f"| {' | '.join(str(cell).replace('|', '/') for cell in cells)} |\n"


def commit():
    """The commit, with "-dirty" if other files than documents were changed since."""
    def git(*arguments):
        return subprocess.run(["git", "-C", ROOT, *arguments], stdout=subprocess.PIPE, text=True, check=False).stdout

    changed = git("status", "--porcelain", "--untracked-files=no", "--", ".", ":!docs", ":!README.md")
    return (git("describe", "--always").strip() or "unknown") + ("-dirty" if changed else "")


def processor():
    with open("/proc/cpuinfo", encoding="utf-8") as file:
        found = re.search(r"^model name\s*: (.*)$", file.read(), re.MULTILINE)
    return f"{found[1] if found else 'unknown processor'}, {os.cpu_count()} cores"


def origin(target):
    return f"`make {target}` on {datetime.date.today()} at commit {commit()}"


def replace_file(path, text):
    """Writes a new file in the same folder and renames it. If that fails, an earlier file stays and nothing is left."""
    handle, temporary = tempfile.mkstemp(prefix=f"{path.stem}.part-", suffix=path.suffix, dir=path.parent)
    try:
        with open(handle, "w", encoding="utf-8") as file:
            file.write(text)
        os.chmod(temporary, 0o644)
        os.rename(temporary, path)
    except BaseException:
        os.unlink(temporary)
        raise


def with_rows(text, heading, rows):
    """A page with other rows in the first table below a heading."""
    found = re.search(rf"^#+ {re.escape(heading)}\n(?:(?!#).*\n)*?(\|.*\n)\|[-| ]+\n((?:\|.*\n)*)", text, re.MULTILINE)
    if not found:
        raise ValueError(f"the page has no table below the heading '{heading}'")
    columns = found[1].count("|") - 1
    for row in rows:
        if len(row) != columns:
            raise ValueError(f"'{heading}': a row has {len(row)} cells, the table has {columns} columns: {row}")
    return text[:found.start(2)] + "".join(map(row_of, rows)) + text[found.end(2):]


def publish(name, target, tables, words="", complete=True):
    """Prints the rows of tables by their headings. If all was measured, they go into a page of docs/, and where they
    come from, with more words, into its paragraph on that."""
    tables = {heading: list(rows) for heading, rows in tables.items()}
    for heading, rows in tables.items():
        if rows:
            print(f"\n{heading}\n\n{''.join(map(row_of, rows))}", end="")
    if not complete:
        print(f"{target}: not all was measured; docs/{name} is unchanged", file=sys.stderr)
        return
    page = ROOT / "docs" / name
    text = page.read_text(encoding="utf-8")
    for heading, rows in tables.items():
        text = with_rows(text, heading, rows)
    lines = textwrap.wrap(f"Written by {origin(target)}{words}.", 120, break_long_words=False, break_on_hyphens=False)
    text, count = re.subn(rf"^.*\bby `make {target}`(?:.+\n)*", "\n".join(lines) + "\n", text, 1, re.MULTILINE)
    if not count:
        raise ValueError(f"docs/{name} has no paragraph with: Written by `make {target}`")
    replace_file(page, text)


def fill(page, name, words, columns, rows):
    """Replaces what is between the marks `NAME begin` and `NAME end` in a page by words and a table."""
    text = page.read_text(encoding="utf-8")
    begin, end = (re.search(f"<!-- {name} {mark}.*?-->", text) for mark in ("begin", "end"))
    if not begin or not end:
        raise ValueError(f"{page} needs the marks <!-- {name} begin --> and <!-- {name} end -->")
    table = "".join(map(row_of, [columns, ["---"] * len(columns), *rows]))
    replace_file(page, f"{text[:begin.end()]}\n{words}\n\n{table}{text[end.start():]}")
