"""A .prm file as nested lists of [key, value] and [name, list]; enough of the language for files that are right."""

from mechanism import render


def parse(text):
    stack = [[]]
    for line in text.replace("\\\n", " ").splitlines():
        line = line.partition("#")[0].strip()
        if line.startswith("subsection "):
            inner = []
            stack[-1].append([line.removeprefix("subsection ").strip(), inner])
            stack.append(inner)
        elif line == "end" and len(stack) > 1:
            stack.pop()
        elif line.startswith("set "):
            key, _, value = line.removeprefix("set ").partition("=")
            stack[-1].append([key.strip(), value.strip()])
    return stack[0]


def leaves(tree, path=()):
    """Paths of all items, subsections before what is in them."""
    for key, value in tree:
        yield (*path, key)
        if isinstance(value, list):
            yield from leaves(value, (*path, key))


def without(tree, path):
    return [[key, without(value, path[1:]) if key == path[0] and len(path) > 1 else value]
            for key, value in tree if not (key == path[0] and len(path) == 1)]


def changed(tree, path, new):
    """With an entry set; what is missing on the way is made."""
    key, *rest = path
    copy = [list(item) for item in tree]
    item = next((item for item in copy if item[0] == key), None)
    if item is None:
        copy.append(item := [key, []])
    item[1] = changed(item[1] if isinstance(item[1], list) else [], rest, new) if rest else new
    return copy


def get(tree, path):
    for key in path:
        tree = next((value for name, value in tree if name == key), None)
        if tree is None:
            return None
    return tree


__all__ = ["parse", "render", "leaves", "without", "changed", "get"]
