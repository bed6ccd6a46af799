"""Markdown for documents that scripts write, as lists of lines."""
import textwrap


def paragraph(words, width=120):
    return textwrap.wrap(words, width, break_long_words=False, break_on_hyphens=False)


def table(columns, rows):
    lines = [columns, ["---"] * len(columns), *rows]
    return ["| " + " | ".join(map(str, cells)) + " |" for cells in lines] + [""]
