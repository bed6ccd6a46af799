"""Markdown for documents that scripts write, as lists of lines."""
import textwrap


def paragraph(words):
    return textwrap.wrap(words, 120, break_long_words=False, break_on_hyphens=False)


def table(columns, rows):
    lines = [columns, ["---"] * len(columns), *rows]
    return ["| " + " | ".join(map(str, cells)) + " |" for cells in lines] + [""]
