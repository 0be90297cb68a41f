"""How deep a tree is, found without recursion."""

from __future__ import annotations

from dataclasses import fields, is_dataclass
from typing import Any

from nsode.expr import Expr
from nsode.source import Span


def beyond(tree: Any, limit: int) -> Span | None:
    """Return the place of an expression nested deeper than ``limit``; None without one."""
    stack: list[tuple[Any, int]] = [(tree, 0)]
    while stack:
        node, depth = stack.pop()
        if isinstance(node, tuple):
            stack.extend((item, depth) for item in node)
        elif is_dataclass(node):
            depth += isinstance(node, Expr)
            if depth > limit:
                return node.span  # type: ignore[attr-defined, no-any-return]
            stack.extend((getattr(node, f.name), depth) for f in fields(node) if f.name != "span")
    return None
