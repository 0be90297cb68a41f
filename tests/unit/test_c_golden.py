"""The C of the shipped models as it was when somebody last read it."""

import pytest

import nsode
from support import MODELS
from support.golden import GOLDEN, assert_recorded


@pytest.mark.parametrize("suffix", ["h", "c"])
@pytest.mark.parametrize("model", MODELS, ids=lambda path: path.stem)
def test_the_c_of_a_shipped_model_is_the_recorded_one(model, suffix):
    name = f"{model.stem}.{suffix}"
    assert_recorded(f"c/{name}", nsode.load(model).emit("c")[name])


def test_no_record_is_without_its_model():
    recorded = {path.stem for path in (GOLDEN / "c").iterdir()}
    assert recorded == {path.stem for path in MODELS}
