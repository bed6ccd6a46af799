"""The examples of the documentation: fenced blocks of a Markdown page, with the comment that marks them."""
import dataclasses
import re

MARKERS = ("run", "live", "background", "fails", "bad")
_FENCE = re.compile(r"^```(\w*)\s*$")
_MARKER = re.compile(r"^<!-- example: ([a-z]+) -->$")


@dataclasses.dataclass
class Example:
    language: str  # "bash" or "yaml"
    marker: str    # one of MARKERS
    line: int      # of the opening fence, from 1
    text: str


def examples(page):
    """All bash and yaml blocks of a page's text, in order. Raises ValueError for a marker without a block."""
    result, marker, block = [], None, None
    for number, line in enumerate(page.splitlines(), 1):
        fence, comment = _FENCE.match(line), _MARKER.match(line)
        if block is not None:
            if fence and not fence.group(1):
                if block.language in ("bash", "yaml"):
                    result.append(block)
                block = None
            else:
                block.text += line + "\n"
        elif comment:
            if comment.group(1) not in MARKERS:
                raise ValueError(f"line {number}: unknown marker '{comment.group(1)}'; known: {', '.join(MARKERS)}")
            marker = comment.group(1)
        elif fence:
            block, marker = Example(fence.group(1), marker or "run", number, ""), None
        elif line.strip() and marker:
            raise ValueError(f"line {number}: the marker '{marker}' has no block after it")
    if block is not None:
        raise ValueError(f"line {block.line}: the block has no end")
    return result
