"""How deep a tree is, found without recursion."""

from __future__ import annotations

from dataclasses import fields, is_dataclass
from typing import NamedTuple

from nsode.expr import Call, Expr
from nsode.source import NOWHERE, Span


class Deep(NamedTuple):
    """Where a tree passes a limit, whether inside a product, and how deep it is in all."""

    place: Span
    in_product: bool
    deepest: int


def beyond(tree: object, limit: int) -> Deep | None:
    """Return where a tree is deeper than ``limit``; None where it is not."""
    found = Deep(NOWHERE, False, 0)
    stack: list[tuple[object, int, bool]] = [(tree, 0, False)]
    while stack:
        node, depth, in_product = stack.pop()
        if isinstance(node, Expr):
            depth += 1
            if depth > limit >= found.deepest:
                found = Deep(node.span, in_product, depth)
            found = found._replace(deepest=max(found.deepest, depth))
            in_product = isinstance(node, Call) and node.function in {"*", "/"}
        if isinstance(node, tuple):
            stack.extend((item, depth, in_product) for item in node)
        elif is_dataclass(node):
            below = (getattr(node, f.name) for f in fields(node) if f.name != "span")
            stack.extend((item, depth, in_product) for item in below)
    return found if found.deepest > limit else None
