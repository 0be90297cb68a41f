"""What ``der(...)`` of a function of time alone is, wherever an expression may stand."""

from __future__ import annotations

from dataclasses import dataclass, field, replace

from nsode.derivative import Motion
from nsode.diagnostics import ModelError, refuse
from nsode.expr import TIME, Call, Expr, Name, names
from nsode.inclusion.elaborate import elaborate
from nsode.inclusion.kinds import number
from nsode.inclusion.order import deepest_first
from nsode.inclusion.review import Review
from nsode.inclusion.symbols import Kind, Scope, Symbols
from nsode.inclusion.values import Value, each
from nsode.limits import either
from nsode.ode import Binding
from nsode.syntax.depth import beyond


@dataclass(slots=True)
class FunctionsOfTime:
    """Derives functions of time; the derivative of a let joins the ``bindings`` under a name."""

    symbols: Symbols
    review: Review
    bindings: dict[str, Binding]
    _motion: Motion = field(default_factory=Motion)
    _movers: dict[str, Name | None] = field(default_factory=dict)

    def der(self, call: Call, scope: Scope) -> Value:
        """Return what ``der(...)`` is outside an equation.

        Raises
        ------
        ModelError
            NS112 for what is no function of time alone, NS011 for what grows too large.
        """
        return self.derivative(elaborate(call.args[0], scope), call, scope)

    def derivative(self, value: Value, call: Call, scope: Scope) -> Value:
        """Return the derivative of a value that ``call`` asks for.

        Raises
        ------
        ModelError
            As :meth:`der` does.
        """
        return each(lambda part: self._derived(number(part), call, scope), value)

    def _derived(self, expr: Expr, call: Call, scope: Scope) -> Expr:
        mover = self._mover(expr)
        if mover is not None:
            raise _no_function_of_time(mover, self._kind(mover), call)
        before = len(self._motion.emitted)
        found = self._motion.derivative(expr, frozenset(scope.indices))
        for item in self._motion.emitted[before:]:
            assert isinstance(item, Binding)
            self._check(item.value, call)
            self.bindings[item.name] = replace(item, span=call.span)
        self._check(found, call)
        return replace(found, span=call.span)

    def _mover(self, expr: Expr) -> Name | None:
        """Return what a value rests on that is neither time nor a parameter."""

        def reads(value: Expr) -> list[str]:
            return [name.id for name in names(value) if name.id in self.bindings]

        for key in deepest_first(
            reads(expr), lambda k: reads(self.bindings[k].value), self._movers
        ):
            self._movers[key] = self._first_mover(self.bindings[key].value)
            self._motion.define(self.bindings[key])
        return self._first_mover(expr)

    def _first_mover(self, expr: Expr) -> Name | None:
        for name in names(expr):
            if name.id in self._movers:
                if (mover := self._movers[name.id]) is not None:
                    return mover
            elif name.id != TIME and self._kind(name) != "parameter":
                return name
        return None

    def _kind(self, name: Name) -> Kind | None:
        symbol = self.symbols.known.get(name.id.partition(".")[0].partition("[")[0])
        return None if symbol is None else symbol.kind

    def _check(self, value: Expr, call: Call) -> None:
        self.review.check(replace(value, span=call.span))
        limits = self.review.limits
        if (deep := beyond(value, limits.depth)) is not None:
            raise refuse(
                "NS011",
                f"this derivative is nested {deep.deepest:,} levels deep, "
                f"and {limits.depth} are the limit",
                call.span,
                help=either(
                    "name parts of what it derives with `let`",
                    limits.raised("depth", deep.deepest),
                ),
            )


def _no_function_of_time(mover: Name, kind: Kind | None, call: Call) -> ModelError:
    match kind:
        case "term" | "force":
            label = "holds a set-valued term"
            way_out = "a force that is filtered has a derivative: `der(f) = (F - f)/tau`"
        case "input":
            label = f"depends on the input `{mover.id}`"
            way_out = "a function of time that is known is a `let` of `t`"
        case _:
            label = f"depends on the state `{mover.id}`"
            way_out = "write it out, by the chain rule and what the equations of the states say"
    return refuse(
        "NS112",
        "`der` takes a function of time alone, or in an equation a state",
        call.span,
        label,
        help=way_out,
    )
