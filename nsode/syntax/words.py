"""The words of the language that no declaration may take."""

from __future__ import annotations

#: Words that begin a statement, and so end an unclosed bracket.
STATEMENT_KEYWORDS = (
    "model",
    "parameter",
    "constant",
    "input",
    "state",
    "let",
    "force",
    "output",
    "assume",
    "for",
    "approximate",
    "simulate",
)
KEYWORDS = frozenset(STATEMENT_KEYWORDS) | {
    "and",
    "at",
    "default",
    "else",
    "equilibrium",
    "every",
    "if",
    "in",
    "method",
    "not",
    "or",
    "step",
    "sum",
    "then",
    "with",
}
#: Words of other languages that would read a file; here they are refused.
FILE_KEYWORDS = frozenset({"import", "include", "use"})
RESERVED = KEYWORDS | FILE_KEYWORDS

#: What can be applied to arguments; stage 2 knows what each is.
FUNCTION_NAMES = frozenset(
    (
        *("abs", "acos", "asin", "atan", "atan2", "cos", "cosh", "cross", "der", "dio", "dot"),
        *("exp", "log", "max", "min", "mod", "norm", "qmul", "sgn", "sin", "sinh", "sqrt"),
        *("tan", "tanh", "transpose"),
    )
)
#: Names that always have a value.
CONSTANT_NAMES = frozenset({"pi", "t"})
