"""What a person finds who types ``nsode.`` and ``help(nsode)``."""

from __future__ import annotations

import pickle
import pydoc

import numpy as np
import pytest

import nsode
from support import MODELS

SPHERE = next(path for path in MODELS if path.stem == "rolling_sphere")


def test_dir_shows_what_is_public_and_nothing_else():
    assert dir(nsode) == sorted(nsode.__all__)


@pytest.mark.parametrize("name", [name for name in nsode.__all__ if name != "__version__"])
def test_what_is_public_is_there_and_explained(name):
    assert pydoc.getdoc(getattr(nsode, name))


def test_help_shows_functions_that_load_only_when_they_are_used():
    told = pydoc.plain(pydoc.render_doc(nsode))
    assert "model.simulate(step=1e-3)" in told
    assert "\n    load(" in told
    assert "class ModelError" in told


def test_names_stand_in_the_order_of_the_vectors():
    model = nsode.load(SPHERE)
    assert dict(zip(model.p_names, model.p0, strict=True))["N.K"] == 1e5
    assert dict(zip(model.x_names, model.x0, strict=True))["v.x"] == 5.5
    assert model.x_names[-3:] == ("N.e", "F.a.x", "F.a.y")
    assert (model.u_names, model.y_names) == ((), ("depth", "N", "F.x", "F.y"))


def test_an_unknown_target_is_named_with_those_that_there_are(tmp_path):
    with pytest.raises(ValueError, match="no target `fortran`: choose from `c`, "):
        nsode.load(SPHERE).compile("fortran", tmp_path)


def test_a_trajectory_shows_itself_on_one_line():
    run = nsode.load(SPHERE).simulate(duration=0.01)
    assert repr(run) == "<nsode.Trajectory rolling_sphere: 11 rows of 16 states and 4 outputs>"


def test_what_a_sweep_hands_over_between_processes_arrives_whole():
    model = nsode.load(SPHERE)
    run = pickle.loads(pickle.dumps(model)).simulate(0.1)
    assert np.array_equal(pickle.loads(pickle.dumps(run)).x, run.x)
    with pytest.raises(nsode.ModelError) as refused:
        model.with_parameters({"mu": -1})
    assert str(pickle.loads(pickle.dumps(refused.value))) == str(refused.value)
    growing = nsode.loads("model m\nstate x = 1\nder(x) = x^2\n")
    with pytest.raises(nsode.RunError) as failed:
        growing.simulate(2, step=1e-3)
    arrived = pickle.loads(pickle.dumps(failed.value))
    assert str(arrived) == str(failed.value)
    assert np.array_equal(arrived.trajectory.x, failed.value.trajectory.x)
