"""How deep a tree is, found without recursion."""

from __future__ import annotations

from dataclasses import fields, is_dataclass

from nsode.expr import Expr
from nsode.source import Span


def beyond(tree: object, limit: int) -> Span | None:
    """Return the place of an expression nested deeper than ``limit``; None without one."""
    stack = [(tree, 0)]
    while stack:
        node, depth = stack.pop()
        if isinstance(node, Expr):
            depth += 1
            if depth > limit:
                return node.span
        if isinstance(node, tuple):
            stack.extend((item, depth) for item in node)
        elif is_dataclass(node):
            stack.extend((getattr(node, f.name), depth) for f in fields(node) if f.name != "span")
    return None
