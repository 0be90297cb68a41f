"""One hint for each slip that people make in a statement; the first that knows it speaks."""

from __future__ import annotations

from collections.abc import Callable

from nsode.diagnostics import suggest
from nsode.syntax.misfit import OPERATORS, Misfit
from nsode.syntax.tokens import Token
from nsode.syntax.words import FUNCTION_NAMES, KEYWORDS, STATEMENT_KEYWORDS


def way_out(misfit: Misfit) -> str | None:
    """Return what to write instead, None where no hint knows."""
    return next(filter(None, (hint(misfit) for hint in _HINTS)), None)


def _comma(misfit: Misfit) -> str | None:
    if misfit.type != "COMMA":
        return None
    if "RSQB" in misfit.accepted:
        return "an element of a matrix is written `R[1][2]`"
    if "RPAR" in misfit.accepted:
        return "a vector is written `[a, b]`"
    digits = misfit.after[0].text if misfit.after else ""
    if misfit.last is not None and misfit.last.type == "NUMBER" and digits.isdigit():
        return f"write `{misfit.last.text}.{digits}`"
    return "a line holds one statement, a declaration one name"


def _equals(misfit: Misfit) -> str | None:
    if misfit.type == "EQUAL" and misfit.after and misfit.after[0].type == "INEQUALITY":
        return "write `<=` or `>=`"
    if misfit.type == "EQUAL" and "EQUALITY" in misfit.accepted:
        return "a comparison is written `==`"
    if misfit.type in ("EQUALITY", "INEQUALITY") and "EQUAL" in misfit.accepted:
        return "a value is given, and an equation written, with `=`"
    return "write `=`" if misfit.type == "COLON" and "EQUAL" in misfit.accepted else None


def _comparison(misfit: Misfit) -> str | None:
    if misfit.type not in ("EQUALITY", "INEQUALITY"):
        return None
    if misfit.follows_operand:
        return "comparisons do not chain: write `a < b and b < c`"
    if misfit.last is not None and misfit.last.type == "UNIT":
        return "bounds belong to a `parameter` or an `input`; elsewhere write `assume a >= 0`"
    return None


def _conditional(misfit: Misfit) -> str | None:
    if "THEN" in misfit.accepted or "ELSE" in misfit.accepted:
        return "a choice is written `if c then a else b`, and always has its `else`"
    if misfit.type == "IF" and misfit.follows_operand:
        return "the condition comes first: `if c then a else b`"
    if misfit.type == "IF" and misfit.before:
        return "inside an expression `if c then a else b` stands in parentheses"
    return None


def _power(misfit: Misfit) -> str | None:
    if misfit.text == "*" and misfit.last is not None and misfit.last.text == "*":
        return "a power is written `^`"
    return None


def _comment(misfit: Misfit) -> str | None:
    slash = misfit.text == "/" and (misfit.last is None or misfit.last.text == "/")
    star = misfit.text == "*" and misfit.last is not None and misfit.last.text == "/"
    return "a comment begins with `#`" if slash or star else None


def _run(misfit: Misfit) -> str | None:
    if misfit.first.type != "SIMULATE" or misfit.type != "NAME":
        return None
    return suggest(misfit.text, ("step", "every", "method"))


def _unit(misfit: Misfit) -> str | None:
    if misfit.type == "UNIT" and misfit.first.type == "CONSTANT":
        return "a `constant` is a plain number; a quantity with a unit is a `parameter`"
    if misfit.type == "UNIT":
        return "a unit ends a declaration or a setting; for use in a formula declare a `parameter`"
    if misfit.last is None:
        return None
    if misfit.last.type == "UNIT" and misfit.type in OPERATORS:
        return "a unit never stands inside an expression, only at its end"
    if misfit.last.type == "NUMBER" and misfit.type == "NAME":
        return _unit_or_product(misfit, misfit.last)
    return None


def _unit_or_product(misfit: Misfit, number: Token) -> str:
    if misfit.after and misfit.after[0].type == "EQUAL":
        return "settings are separated by `,`, statements by new lines"
    if "UNIT" in misfit.accepted:
        return f"a unit stands in braces: `{{{misfit.text}}}`; a product needs its `*`"
    return f"a product needs its `*`: `{number.text}*{misfit.text}`"


def _application(misfit: Misfit) -> str | None:
    last = misfit.last
    if last is None:
        return None
    if misfit.type == "LPAR" and "EQUAL" in misfit.accepted and not misfit.follows_operand:
        return "functions cannot be defined; a function of time is a `let`: `let f = sin(2*t)`"
    if misfit.follows_operand and last.text in FUNCTION_NAMES and misfit.type in ("NAME", "NUMBER"):
        return f"write `{last.text}({misfit.text})`"
    if misfit.follows_operand and misfit.type == "NUMBER" and misfit.text[1:].isdigit():
        return (
            f"an element is written `{last.text}[{misfit.text[1:]}]`"
            if misfit.text[0] == "."
            else None
        )
    return None


def _loop(misfit: Misfit) -> str | None:
    if misfit.first.type != "FOR":
        each = misfit.first.type == "ASSUME" and misfit.text in ("for", "in")
        return "write `for i in 1..n: assume x[i] >= 0`" if each else None
    if misfit.bad is None or misfit.text in ("=", ":", "in"):
        return "write `for i in 1..n: der(x[i]) = v[i]`, all on one line"
    if misfit.text in STATEMENT_KEYWORDS and misfit.text != "assume":
        return "a declared family has its range in brackets: `let y[i in 1..n] = 2*i`"
    return "a `:` stands behind the range" if "COLON" in misfit.accepted else None


def _range(misfit: Misfit) -> str | None:
    if misfit.type == "COLON" and "_RANGE" in misfit.accepted:
        return "a range is written `1..n`"
    return "an element is selected by one index" if misfit.type == "_RANGE" else None


def _settings(misfit: Misfit) -> str | None:
    if misfit.first.type == "APPROXIMATE" and misfit.type == "LSQB" and misfit.last is not None:
        return f"a family has one set of constants: `approximate {misfit.last.text}: ...`"
    if misfit.first.type == "APPROXIMATE" and "COLON" in misfit.accepted:
        return "write `approximate N: K = 1e5, beta = 4e-3`"
    return None


def _product(misfit: Misfit) -> str | None:
    if misfit.follows_operand and misfit.type in ("NAME", "NUMBER", "LPAR"):
        return "a product needs its `*`, and each statement its own line"
    return None


def _keyword(misfit: Misfit) -> str | None:
    if misfit.text in KEYWORDS and misfit.wants_operand and misfit.before:
        return f"`{misfit.text}` is a word of the language and has no value"
    if misfit.text in STATEMENT_KEYWORDS:
        return "each statement begins on its own line"
    return None


def _plus(misfit: Misfit) -> str | None:
    return "leave out the `+`" if misfit.type == "PLUS" and misfit.wants_operand else None


def _ends(misfit: Misfit) -> str | None:
    if misfit.bad is not None or misfit.last is None:
        return None
    if misfit.first.type in ("STATE", "PARAMETER") and "EQUAL" in misfit.accepted:
        when = " at the start" if misfit.first.type == "STATE" else ""
        return f"give it a value{when}: `{misfit.first.text} {misfit.last.text} = 0`"
    if misfit.last.type in OPERATORS | {"EQUAL"}:
        return "a statement goes on in the next line only inside ( and ["
    if misfit.first.text == "end":
        return "leave it out: a model ends with its file"
    if misfit.follows_operand and misfit.first.type not in map(str.upper, STATEMENT_KEYWORDS):
        return "an equation has two sides: `M*der(v) = F`"
    return None


_HINTS: tuple[Callable[[Misfit], str | None], ...] = (
    _comma,
    _equals,
    _comparison,
    _conditional,
    _power,
    _comment,
    _run,
    _unit,
    _application,
    _loop,
    _range,
    _settings,
    _product,
    _keyword,
    _plus,
    _ends,
)
