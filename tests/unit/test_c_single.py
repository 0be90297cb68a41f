"""Numbers that a float cannot hold are refused before they become infinite or zero."""

from __future__ import annotations

import numpy as np
import pytest

import nsode
from nsode.backends import Options
from nsode.diagnostics import ModelError

LARGEST, LEAST = float(np.finfo(np.float32).max), float(np.finfo(np.float32).smallest_subnormal)


def emitted(line: str, value: float, real: str) -> None:
    text = f"model m\nstate x = 1\n{line.format(repr(value))}\n"
    nsode.loads(text).emit("c", Options(real=real))


EVERYWHERE = pytest.mark.parametrize(
    "line",
    [
        "parameter a = {}\nder(x) = -a*x",
        "parameter a[i in 1..2] = [1, {}]\nder(x) = -a[2]*x",
        "input u = {}\nder(x) = -u*x",
        "state y = {}\nder(y) = 0\nder(x) = -x",
        "let y = {}*x\nder(x) = -y",
        "der(x) = -x/{}",
        "der(x) = -x\noutput y = max(x, {})",
        "der(x) = -x\nassume x < {}",
    ],
)


@EVERYWHERE
@pytest.mark.parametrize("value", [1.001 * LARGEST, 1e300, LEAST / 4, 1e-300])
def test_a_number_that_no_float_holds_is_refused(line: str, value: float) -> None:
    emitted(line, value, "double")
    with pytest.raises(ModelError, match="does not fit into a float") as refusal:
        emitted(line, value, "float")
    assert [d.code for d in refusal.value.diagnostics] == ["NS116"]


@EVERYWHERE
@pytest.mark.parametrize("value", [LARGEST, LEAST, 0.1, 1e-30])
def test_a_number_that_a_float_holds_is_written(line: str, value: float) -> None:
    emitted(line, value, "float")
