"""Which law stands for which term, with which constants, and what is refused."""

from __future__ import annotations

import math

import pytest

import nsode
from nsode.analysis import ledger
from nsode.cli import run
from nsode.diagnostics import ModelError
from nsode.expr import Number
from nsode.ode import Approximation, SetValuedTerm
from nsode.regularizations import LAWS, law
from nsode.simulate import RunWarning
from support.models import MODELS, PATHS

BALL = """model ball
parameter g = 9.8
state p = 1
state v = 0
force N = dio(p)
der(p) = v
der(v) = N - g
"""
BLOCK = """model block
parameter mu = 0.3
parameter load = 2
let level = mu*load
state v = 1
force F = level*sgn(v)
der(v) = -F
"""


def constants(model):
    return {p.name: p.values[0] for p in model.ode.parameters if p.constant_of}


def refusal(text, **laws):
    with pytest.raises(ModelError) as caught:
        nsode.loads(text).with_law(**laws)
    [error] = caught.value.diagnostics
    return error, str(caught.value)


@pytest.mark.parametrize("name", LAWS)
def test_every_law_replaces_each_kind_that_it_names(name):
    for kind in LAWS[name].kinds:
        for size in (1,) if kind == "dio" else (1, 2, 3):
            parts = tuple(Number(float(k)) for k in range(size))
            multiplier = ("T",) if size == 1 else tuple(f"T.{c}" for c in "xyz"[:size])
            factor = None if kind == "dio" else Number(2.0)
            term = SetValuedTerm("T", kind, parts, factor, multiplier)
            found = law(name).replace(term, "text", Number(1.0))
            defined = [binding.name for binding in found.bindings]
            assert defined[-size:] == list(multiplier)
            assert len(set(defined)) == len(defined)
            assert all(constant.conditions for constant in law(name).constants(term))


def test_there_is_no_law_by_another_name():
    with pytest.raises(KeyError):
        law("coulomb")


def test_lugre_takes_its_reference_force_from_a_constant_factor_and_follows_it():
    model = nsode.loads(BLOCK + "approximate F with lugre: K = 1e4, B = 20\n")
    assert constants(model) == {"F.K": 1e4, "F.B": 20, "F.D": 0, "F.F0": 0.6}
    assert constants(model.with_parameters({"load": 3}))["F.F0"] == pytest.approx(0.9)


def test_lugre_under_a_moving_factor_wants_a_reference_force_by_name(capsys):
    sphere = str(MODELS / "rolling_sphere.di")
    assert math.isnan(constants(nsode.load(sphere).with_law(friction="lugre"))["F.F0"])
    assert run(["simulate", sphere, "--friction", "lugre"]) == 1
    assert "a constant has no value: `F.F0`" in capsys.readouterr().err


@pytest.mark.parametrize(
    ("text", "message"),
    [
        (BALL + "approximate N with lugre: K = 1", "`lugre` cannot stand for `dio`"),
        (BALL + "approximate N with kelvin: K = 1", "there is no law `kelvin`"),
        (BALL + "approximate N with kelvin_voigt: alpha = 1", "`kelvin_voigt` has no constant"),
        (BALL + "approximate N with kelvin_voigt: K = 1, B = -1", "`N.B` must be at least 0"),
        (BALL + "approximate N with hunt_crossley: K = 1, c = 0, n = 0.5", "must be at least 1"),
        (BLOCK + "approximate F with smoothing: epsilon = 0", "must be greater than 0"),
        (BLOCK.replace("mu = 0.3", "mu = 0") + "approximate F with lugre: K = 1", "`F.F0` must be"),
    ],
)
def test_what_a_law_cannot_use_is_refused_at_its_place(text, message):
    error, shown = refusal(text)
    assert message in error.message
    assert "-->" in shown


def test_a_gap_of_first_order_is_refused_by_laws_that_read_its_rate():
    text = "model valve\nstate x = 1\nforce N = dio(x)\nder(x) = N - 1\n"
    error, shown = refusal(text, contact="kelvin_voigt")
    assert error.code == "NS306"
    assert "the rate of this gap depends on the force itself" in shown
    assert "dio(x)" in shown


def test_a_gap_that_moves_with_an_input_is_refused_even_behind_a_let():
    text = BALL.replace("dio(p)", "dio(gap)").replace(
        "force", "input wall = 0\nlet gap = p - wall\nforce"
    )
    error, _ = refusal(text, contact="hunt_crossley")
    assert error.code == "NS306"
    assert error.labels[0].text == "this gap moves with the input `wall`"


def test_a_state_that_an_input_moves_is_no_hindrance():
    text = BALL.replace("dio(p)", "dio(p - wall)").replace(
        "force", "input u = 0\nstate wall = 0\nder(wall) = u\nforce"
    )
    assert nsode.loads(text).with_law(contact="kelvin_voigt").ode.auxiliary == ()


def test_a_law_that_pulls_cannot_load_friction():
    error, shown = refusal((MODELS / "rolling_sphere.di").read_text(), contact="kelvin_voigt")
    assert error.code == "NS306"
    assert "the factor of this term would be negative" in shown


def test_what_psi_reads_on_the_way_stands_before_the_force():
    text = """model late
state q = -0.1
state v = 2
force N = dio(sin(q))
let speed = 3*v*q
der(q) = speed
der(v) = N
approximate N with kelvin_voigt: K = 10, B = 4
"""
    model = nsode.loads(text)
    seen = {p.name for p in model.ode.parameters} | {"q", "v"}
    for item in model.ode.bindings:
        seen.add(item.name)
    names = [item.name for item in model.ode.bindings]
    assert names.index("speed") < names.index("N")
    q, v = -0.1, 2.0
    force = -10 * math.sin(q) - 4 * math.cos(q) * 3 * v * q
    shut = pytest.warns(RunWarning, match="pulls its gap shut")  # q < 0 turns its sign
    with pytest.warns(RunWarning, match="starts inside the contact"), shut:
        found = model.simulate(1e-6, 1e-6)
    assert found["N"][0] == pytest.approx(force, rel=1e-14)


def test_two_contacts_of_one_body_share_what_their_rates_read():
    text = """model box
state p = 0.5
state v = 0
force L = dio(p)
force R = dio(1 - p)
force S = dio(p - 0.2)
der(p) = v - 0.1*p
der(v) = L - R + S
approximate L, R with clipped_kelvin_voigt: K = 10, B = 4
approximate S: K = 10, beta = 1e-2, alpha = 1e-3
"""
    model = nsode.loads(text)
    for ode in (model.ode, ledger(model.ode, model.inclusion)):
        names = [item.name for item in ode.bindings]
        assert len(set(names)) == len(names)


def test_another_law_takes_over_k_and_a_damper():
    ball = nsode.loads(BALL + "approximate N: K = 1e5, beta = 4e-3, alpha = 2e-3")
    assert constants(ball.with_law(contact="kelvin_voigt")) == {"N.K": 1e5, "N.B": 400}
    hunt = constants(ball.with_law(contact="hunt_crossley"))
    assert hunt.pop("N.n") == 1
    assert math.isnan(hunt.pop("N.c"))
    assert hunt == {"N.K": 1e5}
    block = nsode.loads(BLOCK + "approximate F: K = 1e5, beta = 4e-3")
    assert constants(block.with_law(friction="lugre"))["F.B"] == 400


def test_a_changed_constant_is_what_another_law_takes_over():
    ball = nsode.loads(BALL + "approximate N: K = 1e5, beta = 4e-3, alpha = 2e-3")
    softer = ball.with_parameters({"N.K": 1e3}).with_law(contact="kelvin_voigt")
    assert constants(softer) == {"N.K": 1e3, "N.B": 4}
    assert constants(softer.with_parameters({"N.K": 1e4}))["N.B"] == 40


def test_a_stiffness_per_metre_to_the_n_is_not_taken_for_a_spring():
    ball = nsode.loads(BALL + "approximate N with hunt_crossley: K = 1e8, c = 0.1, n = 1.5")
    assert math.isnan(constants(ball.with_law(contact="kelvin_voigt"))["N.K"])


def test_there_and_back_again_is_the_model_that_it_was():
    block = nsode.loads(BLOCK + "approximate F: K = 1e5, beta = 4e-3")
    back = block.with_law(friction="lugre").with_law(friction="xiong2013")
    assert constants(back) == constants(block)
    assert back.ode.rates == block.ode.rates
    assert block.with_law() is block


def test_what_reads_a_constant_that_goes_keeps_its_value():
    text = (
        BALL.replace("p = 1", "p = N.beta*10") + "approximate N: K = 1e5, beta = 0.1, alpha = 0.1"
    )
    assert nsode.loads(text).with_law(contact="kelvin_voigt").x0[0] == 1
    without = BALL.replace("p = 1", "p = N.beta*10")
    error, _ = refusal(without, contact="kelvin_voigt")
    assert error.code == "NS306"


def test_constants_of_every_law_can_be_read_and_those_that_are_not_there_are_refused():
    text = BALL.replace("p = 1", "p = N.B/100")
    model = nsode.loads(text + "approximate N with kelvin_voigt: K = 1e5, B = N.K/1e3")
    assert model.x0[0] == 1
    error, _ = refusal(text + "approximate N: K = 1e5, beta = 4e-3, alpha = 1e-3")
    assert error.message == "there is no constant `N.B`"


def test_warnings_of_the_old_law_go_with_it():
    text = BALL + "approximate N: K = 1e5, beta = 4e-3, alpha = 1e-5\nsimulate 1 step 1e-3\n"
    model = nsode.loads(text)
    assert [d.code for d in model.diagnostics] == ["NS407"]
    assert model.with_law(contact="kelvin_voigt").diagnostics == ()


def under(model, kind, name):
    """Return a model under another law, None where that is refused for its reason."""
    try:
        return model.with_law(**{{"dio": "contact", "sgn": "friction"}[kind]: name})
    except ModelError as error:
        if {d.code for d in error.diagnostics} == {"NS306"} and LAWS[name].reads_velocity:
            return None
        raise


@pytest.mark.parametrize("path", PATHS, ids=lambda path: path.stem)
def test_each_shipped_model_is_explained_or_refused_under_every_law(path):
    model = nsode.load(path)
    for name, kind in ((name, kind) for name, entry in LAWS.items() for kind in entry.kinds):
        changed = under(model, kind, name)
        if changed is not None:
            terms = (t for t in changed.inclusion.terms if t.kind == kind)
            assert all(t.approximation.law == name for t in terms)
            assert changed.explain().text()
    assert under(model, "sgn", "lugre") is not None


def test_an_override_that_a_law_cannot_use_names_what_it_breaks(capsys):
    ball = str(MODELS / "bouncing_mass.di")
    assert run(["simulate", ball, "--contact", "kelvin_voigt", "-p", "f.B=-1"]) == 1
    assert "a negative damper creates energy" in capsys.readouterr().err


def test_the_command_line_changes_the_law(tmp_path, capsys):
    ball = str(MODELS / "bouncing_mass.di")
    laws = ["--contact", "hunt_crossley"]
    assert run(["simulate", ball, *laws, "-p", "f.c=0.1", "--for", "0.1"]) == 0
    assert run(["compile", ball, *laws, "-o", str(tmp_path)]) == 0
    assert "2 states, 1 set-valued term (f: dio)" in capsys.readouterr().out
    assert "f.c" in (tmp_path / "bouncing_mass.json").read_text()
    assert run(["explain", ball, *laws]) == 0
    assert "hunt_crossley" in capsys.readouterr().out
    assert run(["simulate", ball, "--contact", "lugre"]) == 2
    assert "`lugre` is not one of `xiong2013`" in capsys.readouterr().err


def test_a_name_that_is_no_law_is_refused_though_nothing_would_change():
    error, _ = refusal(BALL, friction="lugr")
    assert error.code == "NS306"
    assert error.help == "did you mean `lugre`?"


def test_the_usual_law_is_the_papers():
    assert Approximation().law == next(iter(LAWS)) == "xiong2013"
