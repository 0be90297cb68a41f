"""Index ranges and subscripts: integers known when the model is compiled."""

from __future__ import annotations

from nsode.diagnostics import Diagnostic, Label, ModelError, refuse, suggest
from nsode.expr import Call, Expr, Index, IndexRange, Name, Number
from nsode.inclusion.symbols import Scope, check_free
from nsode.limits import Limits, either
from nsode.source import Span
from nsode.syntax.ast import Group, RangeSyntax

#: Whole numbers beyond this are not exact as doubles.
INTEGER_LIMIT = 2**53
_OTHER_INDEX = "name the index differently, for example `k`"


def index(expr: Expr, scope: Scope) -> Index:
    """Return ``i + constant`` or a constant from a subscript as written.

    Raises
    ------
    ModelError
        NS109 for anything else.
    """
    found = _affine(expr, scope)
    if found is None or abs(found[1]) > INTEGER_LIMIT:
        raise refuse(
            "NS109",
            "a subscript is an index, a whole number, or `index + number`",
            expr.span,
            "cannot be decided when the model is compiled",
            help="write for example `x[i]`, `x[i+1]`, `x[n-1]` or `x[3]`",
        )
    return Index(found[0], found[1], span=expr.span)


def integer(expr: Expr, scope: Scope, what: str) -> int:
    """Return a whole number written with constants.

    Raises
    ------
    ModelError
        NS111 if it is none.
    """
    found = _affine(expr, scope)
    if found is None or found[0] is not None:
        raise refuse(
            "NS111",
            f"{what} must be a whole number that is known when the model is compiled",
            expr.span,
            _why_not(expr, scope),
            help="use whole numbers and names declared as `constant n = 10`",
        )
    if abs(found[1]) > INTEGER_LIMIT:
        raise refuse("NS111", f"{what} is too large for a whole number", expr.span, "beyond 2^53")
    return found[1]


def _why_not(expr: Expr, scope: Scope) -> str:
    match expr:
        case Number(value):
            return f"this is {value:g}"
        case Name(id) if id in scope.indices:
            return "this is an index"
        case Name(id):
            return f"`{id}` is a {scope.symbols.find(id, expr.span).kind}"
    return ""


def index_range(syntax: RangeSyntax | None, scope: Scope) -> IndexRange | None:
    """Return the range that ``i in 1..n`` stands for.

    Raises
    ------
    ModelError
        NS103 or NS102 for the name of the index, NS111 for its ends, NS014 if too long.
    """
    if syntax is None:
        return None
    variable = syntax.variable
    check_free(variable.text, variable.span)
    if variable.text in scope.indices:
        message = f"the index `{variable.text}` stands inside another of that name"
        raise refuse("NS102", message, variable.span, "names an index again", help=_OTHER_INDEX)
    if variable.text in scope.symbols.declared:
        message = f"the index `{variable.text}` has the name of something else"
        taken = scope.symbols.declared[variable.text]
        labels = (Label(variable.span, "an index here"), Label(taken, "declared here"))
        raise ModelError([Diagnostic("NS102", message, labels, help=_OTHER_INDEX)])
    first = integer(syntax.first, scope, "the start of a range")
    last = integer(syntax.last, scope, "the end of a range")
    found = IndexRange(variable.text, first, last)
    _check_size(last - first + 1, syntax.span, scope.symbols.limits)
    return found


def _check_size(count: int, span: Span, limits: Limits) -> None:
    if count > limits.elements:
        raise refuse(
            "NS014",
            f"{count:,} elements are more than the limit of {limits.elements:,}",
            span,
            help=either("shorten the range", limits.raised("elements", count)),
        )


def _affine(expr: Expr, scope: Scope) -> tuple[str | None, int] | None:
    match expr:
        case Group(inner):
            return _affine(inner, scope)
        case Number(value) if value == int(value):
            return None, int(value)
        case Name(id):
            return _named(id, expr.span, scope)
        case Call("neg", (inner,)):
            found = _affine(inner, scope)
            return (None, -found[1]) if found is not None and found[0] is None else None
        case Call("*", (left, right)):
            a, b = _affine(left, scope), _affine(right, scope)
            if a is None or b is None or a[0] is not None or b[0] is not None:
                return None
            return None, a[1] * b[1]
        case Call("+", terms):
            return _sum([_affine(term, scope) for term in terms])
    return None


def _named(id: str, span: Span, scope: Scope) -> tuple[str | None, int] | None:
    if id in scope.indices:
        return id, 0
    if id not in scope.symbols.declared:
        near = suggest(id, [*scope.indices, *scope.symbols.declared])
        way_out = near or f"an index is named by `for {id} in 1..n:` or `sum({id} in 1..n: ...)`"
        raise refuse("NS101", f"`{id}` is not defined", span, "nothing has this name", help=way_out)
    symbol = scope.symbols.find(id, span)
    match symbol.value:
        case Number(value):
            return None, int(value)
    return None


def _sum(terms: list[tuple[str | None, int] | None]) -> tuple[str | None, int] | None:
    variable: str | None = None
    offset = 0
    for term in terms:
        if term is None or (term[0] is not None and variable is not None):
            return None
        variable = term[0] if term[0] is not None else variable
        offset += term[1]
    return variable, offset
