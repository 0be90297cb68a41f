"""PREFIX.json: what the generated code computes, for programs and for people.

The text is a function of the model and of nsode alone: no time, no machine.
"""

from __future__ import annotations

import json
from collections.abc import Sequence
from hashlib import sha256
from math import isfinite
from typing import TypeVar

from nsode import __version__
from nsode.backends import Options
from nsode.expr import IndexRange, names
from nsode.integrators import REGISTRY
from nsode.ode import (
    AugmentedODE,
    AuxiliaryState,
    Check,
    Input,
    Output,
    Parameter,
    Slot,
    State,
    layout,
    size,
)
from nsode.source import NOWHERE

SCHEMA_VERSION = 1

#: The paper's equation for the state that a law gives a term.
_EQUATIONS = {
    ("xiong2013", "e"): "(24)",
    ("xiong2013", "a"): "(18a)",
    ("lugre", "a"): "(12)",
}

Record = dict[str, object]
_Item = TypeVar("_Item", State, Input, Parameter, Output)


def describe(ode: AugmentedODE, options: Options) -> Record:
    """Return the description of a model as plain data."""
    auxiliary = {item.name for item in ode.auxiliary}
    return {
        "schema_version": SCHEMA_VERSION,
        "generator": {"name": "nsode", "version": __version__},
        "model": {"name": ode.name, "sha256": sha256(ode.source.text.encode()).hexdigest()},
        "prefix": options.prefix or ode.name,
        "real": options.real,
        "states": [_state(item, slot, auxiliary) for item, slot in _placed(ode.states)],
        "inputs": [_input(item, slot) for item, slot in _placed(ode.inputs)],
        "parameters": [_parameter(item, slot) for item, slot in _placed(ode.parameters)],
        "outputs": [_output(item, slot) for item, slot in _placed(ode.outputs)],
        "auxiliary_states": [_auxiliary(item) for item in ode.auxiliary],
        "checks": [_check(check, number, ode) for number, check in enumerate(ode.checks)],
        "run": {
            "duration": ode.run.duration,
            "step": ode.run.step,
            "every": ode.run.every,
            "method": ode.run.method,
        },
        "integrators": [
            {"name": scheme.name, "title": scheme.title, "order": scheme.order}
            for scheme in REGISTRY.values()
        ],
    }


def render(ode: AugmentedODE, options: Options) -> str:
    """Return the description as JSON text, with a line for each item of a list."""
    entries = (f'  "{key}": {_lines(value)}' for key, value in describe(ode, options).items())
    return "{\n" + ",\n".join(entries) + "\n}\n"


def _lines(value: object) -> str:
    if not isinstance(value, list) or not value:
        return _on_one_line(value)
    return "[\n    " + ",\n    ".join(map(_on_one_line, value)) + "\n  ]"


_on_one_line = json.JSONEncoder(allow_nan=False).encode


def _placed(items: Sequence[_Item]) -> list[tuple[_Item, Slot]]:
    slots = layout(items)
    return [(item, slots[item.name]) for item in items]


def _place(item: State | Input | Parameter | Output, slot: Slot) -> Record:
    return {
        "name": item.name,
        "index": slot.offset,
        "size": size(item),
        "range": _range(item.range),
        "unit": item.unit,
    }


def _range(over: IndexRange | None) -> Record | None:
    if over is None:
        return None
    return {"variable": over.variable, "first": over.first, "last": over.last}


def _state(item: State, slot: Slot, auxiliary: set[str]) -> Record:
    return {**_place(item, slot), "auxiliary": item.name in auxiliary}


def _input(item: Input, slot: Slot) -> Record:
    return {**_place(item, slot), "default": item.default}


def _parameter(item: Parameter, slot: Slot) -> Record:
    values = [value if isfinite(value) else None for value in item.values]
    return {
        **_place(item, slot),
        "default": values[0] if item.range is None else values,
        "computed": item.formula is not None,
        "constant_of": item.constant_of,
    }


def _output(item: Output, slot: Slot) -> Record:
    return _place(item, slot)


def _auxiliary(item: AuxiliaryState) -> Record:
    element = item.name.removeprefix(f"{item.term}.").partition(".")[0]
    return {
        "name": item.name,
        "term": item.term,
        "replaces": item.replaces,
        "law": item.law,
        "equation": _EQUATIONS.get((item.law, element)),
        "range": _range(item.range),
    }


def _check(item: Check, number: int, ode: AugmentedODE) -> Record:
    return {
        "number": number,
        "kind": item.kind,
        "names": list(dict.fromkeys(name.id for name in names(item.condition))),
        "line": None if item.span == NOWHERE else ode.source.position(item.span.start).line,
        "text": ode.source.on_one_line(item.span),
        "reason": item.reason,
    }
