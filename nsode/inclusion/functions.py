"""The functions that a person may write, and how many arguments each takes."""

from __future__ import annotations

from math import inf

from nsode.diagnostics import Diagnostic, Label, ModelError, quoted, refuse, suggest
from nsode.expr import FUNCTIONS, Call

#: Functions of the ODE that no person writes.
_INTERNAL = {"neg", "and", "or", "not", "shrink", "sat"}
SET_VALUED = {"dio", "sgn"}
#: The least and the greatest number of arguments of each function of the language.
ARITY: dict[str, tuple[int, float]] = {
    **{
        name: (function.arity, function.arity)
        for name, function in FUNCTIONS.items()
        if name.isalnum() and name not in _INTERNAL and function.arity is not None
    },
    "min": (2, inf),
    "max": (2, inf),
    "norm": (1, 1),
    "transpose": (1, 1),
    "dot": (2, 2),
    "cross": (2, 2),
    "qmul": (2, 2),
    "dio": (1, 1),
    "sgn": (1, 1),
    "der": (1, 1),
}
#: What functions of other languages, whose names are near to none or to a wrong one, are here.
_ELSEWHERE = {
    "ddt": "der(x)",
    "hypot": "norm([a, b])",
    "ln": "log(x)",
    "log10": "log(x)/log(10)",
    "pow": "a^b",
    "sign": "sgn(x)",
    "signum": "sgn(x)",
}


def check_call(call: Call) -> None:
    """Refuse a function that there is not, and a wrong number of arguments.

    Raises
    ------
    ModelError
        NS104 or NS110.
    """
    if call.function not in ARITY:
        if not _is_operator(call):
            raise unknown_function(call)
        return
    least, most = ARITY[call.function]
    if not least <= len(call.args) <= most:
        count = f"{least} argument" if least == 1 else f"{least} arguments"
        wanted = count if least == most else f"{count} or more"
        message = f"`{call.function}` takes {wanted}"
        raise refuse("NS110", message, call.span, f"here it has {len(call.args)}")


def _is_operator(call: Call) -> bool:
    """Tell an operator from a function that a person gave its internal name."""
    if call.function == "neg":  # a sign ends where its operand does, a call behind it
        return call.span.end == call.args[-1].span.end
    return call.function in FUNCTIONS and call.function not in {"shrink", "sat"}


def unknown_function(call: Call) -> ModelError:
    """Return the error for a function that there is not."""
    ours = _ELSEWHERE.get(call.function)
    return ModelError(
        [
            Diagnostic(
                "NS104",
                f"there is no function `{call.function}`",
                (Label(call.span, "unknown function"),),
                notes=("the functions are " + quoted(sorted(ARITY)),),
                help=f"write `{ours}`" if ours else suggest(call.function, ARITY),
            )
        ]
    )
