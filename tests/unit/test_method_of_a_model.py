"""A method that a model asks for is looked at with the model, not first when it runs."""

from __future__ import annotations

import pytest

import nsode
from nsode.diagnostics import ModelError
from nsode.simulate.settings import methods

TEXT = "model m\nstate x = 1\nder(x) = -x\nsimulate 1 step 0.1 method {}\n"


@pytest.mark.parametrize("method", methods())
def test_every_method_of_a_run_may_stand_in_a_model(method: str) -> None:
    assert nsode.loads(TEXT.format(method)).ode.run.method == method


def test_a_method_that_there_is_not_is_refused_with_its_place() -> None:
    with pytest.raises(ModelError, match="there is no method `rk5`") as refusal:
        nsode.loads(TEXT.format("rk5"))
    [found] = refusal.value.diagnostics
    assert found.code == "NS501"
    assert found.help == "did you mean `rk4`?"
    assert refusal.value.source is not None
