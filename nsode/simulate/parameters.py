"""The parameters of one run: defaults, overrides, and what must hold of them."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import replace
from itertools import islice
from numbers import Real

import numpy as np
from numpy.typing import NDArray

from nsode.diagnostics import Diagnostic, Label, ModelError, quoted, suggest
from nsode.evaluate import evaluate, position
from nsode.expr import Expr, Name, names
from nsode.ode import AugmentedODE, Check, Parameter, element, element_names, layout, size
from nsode.simulate.observe import settled

#: What the index of a family is.
Sample = Mapping[str, int]
#: A number, or one for each element of a family.
Value = float | Sequence[float] | NDArray[np.float64]


def parameters(ode: AugmentedODE, given: Mapping[str, Value]) -> NDArray[np.float64]:
    """Return the vector p with some values overridden, all of it known and sound.

    Raises
    ------
    ModelError
        NS101 for an unknown name, NS105 for a wrong number of values, NS501 for one that
        is not finite, NS503 for constants without a value, NS307 for an override that
        breaks what was proved with it.
    """
    values = _Values(ode, _overrides(ode, given))
    vector = np.array([v for item in ode.parameters for v in values.of(item)], dtype=np.float64)
    lacking = [
        name
        for item in ode.parameters
        if item.formula is None
        for name, value in zip(element_names([item]), values.of(item), strict=True)
        if math.isnan(value)
    ]
    if lacking:
        raise ModelError([_lacking(lacking)], ode.source)
    _check(ode, values)
    return vector


def replaced(ode: AugmentedODE, given: Mapping[str, Value]) -> AugmentedODE:
    """Return the ODE with other values of parameters; formulas of these follow.

    Raises
    ------
    ModelError
        As :func:`parameters`.
    """
    vector = iter(parameters(ode, given).tolist())
    changed = (
        replace(
            item,
            values=tuple(islice(vector, size(item))),
            formula=None if item.name in given else item.formula,
        )
        for item in ode.parameters
    )
    return replace(ode, parameters=tuple(changed))


def states(ode: AugmentedODE, start: NDArray[np.float64], given: Mapping[str, float]) -> None:
    """Put values that a person chose for the start into the vector x.

    Raises
    ------
    ModelError
        NS101 for an unknown name, NS501 for a value that is not finite.
    """
    places = {name: place for place, name in enumerate(element_names(ode.states))}
    for name, value in given.items():
        if name not in places:
            raise ModelError([_unknown("state", name, places)])
        start[places[name]] = _finite(name, value)


class _Values:
    """The value of every parameter, formulas computed from what was overridden."""

    def __init__(self, ode: AugmentedODE, overrides: Mapping[str, list[float]]) -> None:
        self.items = {item.name: item for item in ode.parameters}
        self.known = dict(overrides)

    def of(self, item: Parameter) -> list[float]:
        """Return one value for each element."""
        if item.name not in self.known:
            self.known[item.name] = list(item.values)  # the end of a loop, if there were one
            if item.formula is not None:
                self.known[item.name] = self.each(item.formula, item)
        return self.known[item.name]

    def each(self, expr: Expr, over: Parameter | Check) -> list[float]:
        """Return the value of an expression at each index of a range."""
        return [evaluate(expr, self._lookup, at) for at in _indices(over)]

    def breaks(self, check: Check) -> Sample | None:
        """Return an index at which a check does not hold, None where it holds at each."""
        for at, held in zip(_indices(check), self.each(check.condition, check), strict=True):
            if not held:
                return at
        return None

    def shown(self, name: Name, at: Sample) -> str:
        """Return the name of a scalar or of an element, with its value."""
        k = None if name.at is None else position(name.at, at)
        shown = name.id if k is None else element(name.id, k)
        return f"`{shown}` = {self._lookup(name.id, k):g}"

    def _lookup(self, name: str, at: int | None) -> float:
        item = self.items[name]
        first = 0 if item.range is None else item.range.first
        return self.of(item)[0 if at is None else at - first]


def _overrides(ode: AugmentedODE, given: Mapping[str, Value]) -> dict[str, list[float]]:
    """Return whole families, where single elements or all of them were given."""
    slots = layout(ode.parameters)
    elements = {
        name: (item, place)
        for item in ode.parameters
        for place, name in enumerate(element_names([item]))
    }
    found: dict[str, list[float]] = {}
    for name, value in given.items():
        numbers = [_finite(name, number) for number in np.ravel(np.asarray(value, dtype=object))]
        if name in slots:
            item = next(item for item in ode.parameters if item.name == name)
            found[name] = _spread(name, numbers, size(item))
        elif name in elements:
            item, place = elements[name]
            whole = found.setdefault(item.name, list(item.values))
            [whole[place]] = _spread(name, numbers, 1)
        else:
            raise ModelError([_unknown("parameter", name, [*slots, *elements])])
    return found


def _spread(name: str, numbers: list[float], count: int) -> list[float]:
    if len(numbers) == 1:
        return numbers * count
    if len(numbers) != count:
        message = f"`{name}` takes {count} number{'s' * (count != 1)}, not {len(numbers)}"
        raise ModelError([Diagnostic("NS105", message)])
    return numbers


def _finite(name: str, value: object) -> float:
    if not (isinstance(value, Real) and math.isfinite(value)):
        raise ModelError([Diagnostic("NS501", f"`{name}` must be a finite number, not {value!r}")])
    return float(value)


def _unknown(what: str, name: str, known: Iterable[str]) -> Diagnostic:
    distinct = list(dict.fromkeys(known))
    listed = quoted(distinct[:12])
    more = ", ..." if len(distinct) > 12 else ""
    parts = [other for other in distinct if other.startswith(f"{name}.")]
    whole = f"its components are {', '.join(f'`{part}`' for part in parts)}" if parts else None
    return Diagnostic(
        "NS101",
        f"there is no {what} `{name}`",
        notes=(f"the {what}s are {listed}{more}" if distinct else f"the model has no {what}",),
        help=whole or suggest(name, distinct),
    )


def _lacking(names: Sequence[str]) -> Diagnostic:
    flags = " ".join(f"-p {name}=..." for name in names[:8]) + (" ..." if len(names) > 8 else "")
    listed = quoted(names[:8]) + (", ..." if len(names) > 8 else "")
    return Diagnostic(
        "NS503",
        f"{'constants have' if len(names) > 1 else 'a constant has'} no value: {listed}",
        help=f"give {flags}, or write them into the model with `approximate`",
    )


def _check(ode: AugmentedODE, values: _Values) -> None:
    """Refuse values that break a check; a factor breaks only where what proves it does too."""
    broken = [
        (check, at)
        for check in ode.checks
        if settled(check, ode) and (at := values.breaks(check)) is not None
    ]
    if broken:
        causes = [one for one in broken if one[0].kind != "factor"] or broken
        raise ModelError([_broken(*cause, ode, values) for cause in causes], ode.source)


def _broken(check: Check, at: Sample, ode: AugmentedODE, values: _Values) -> Diagnostic:
    shown = ", ".join(dict.fromkeys(values.shown(name, at) for name in names(check.condition)))
    text = ode.source.on_one_line(check.span)
    why = check.reason
    if check.kind == "assume":
        why = f"`{text}` is assumed"
    elif check.kind == "factor":
        why += " is negative"
    elif why == "declared":
        why = f"it is declared `{text}`"
    return Diagnostic(
        "NS307",
        f"the model does not hold with {shown}",
        (Label(check.span),),
        notes=(why,),
        help="choose values for which it holds",
    )


def _indices(item: Parameter | Check) -> list[Sample]:
    """Return each value of an index, or none where there is no index."""
    if item.range is None:
        return [{}]
    variable, first, last = item.range
    return [{variable: k} for k in range(first, last + 1)]
