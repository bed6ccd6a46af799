"""The log sentences that the documentation quotes, and those that the sources hold."""
import glob
import re

_QUOTED = re.compile(r"<!-- log -->\n *```text\n(.*?)\n *```", re.DOTALL)
_LITERALS = re.compile(r'"(?:[^"\\\n]|\\.)*"(?:\s*"(?:[^"\\\n]|\\.)*")*')
_LITERAL = re.compile(r'"((?:[^"\\\n]|\\.)*)"')


def quoted(page):
    """Every line of a page's blocks that follow the comment `log`. Three dots stand for what varies."""
    return [line.strip() for block in _QUOTED.findall(page) for line in block.splitlines()]


def literals(root):
    """All string literals of the C++ sources, neighbours joined as the compiler joins them, one a line."""
    texts = []
    for pattern in ("*.cpp", "*.h"):
        for path in glob.glob(f"{root}/src/*/**/{pattern}", recursive=True):
            if "/test/" not in path:
                with open(path, encoding="utf-8") as file:
                    texts += ["".join(_LITERAL.findall(group)) for group in _LITERALS.findall(file.read())]
    return "\n".join(texts)


def missing(sentence, sources):
    """The parts of a quoted sentence that no literal holds."""
    return [part.strip() for part in sentence.split("...") if len(part.strip()) > 3 and part.strip() not in sources]
