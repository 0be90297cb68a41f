"""What the analysis says of scenes whose answers are known by hand."""

from __future__ import annotations

import itertools
import json
import math
from contextlib import suppress
from dataclasses import replace

import numpy as np
import pytest
from click.testing import CliRunner
from scipy.optimize import linprog, nnls

import nsode
from nsode.analysis import Analysis, analyze, warnings
from nsode.analysis.mass import effective_mass
from nsode.analysis.reach import conflicts, nonnegative_least_squares
from nsode.analysis.scene import Scene
from nsode.analysis.sets import MOST_SETS, matrix
from nsode.analysis.stability import bound, half_disc, radius
from nsode.analysis.steps import reachable, stable_steps
from nsode.diagnostics import ModelError
from nsode.integrators import REGISTRY
from nsode.ode import DifferentialInclusion
from nsode.rewrite import rewrite
from tests.support import MODELS, inclusions

BY_NAME = {path.stem: path for path in MODELS}
COLUMN = BY_NAME["granular_column"].read_text()


def of(inclusion: DifferentialInclusion) -> Analysis:
    return analyze(inclusion, rewrite(inclusion))


def of_text(text: str) -> Analysis:
    model = nsode.loads(text)
    return analyze(model.inclusion, model.ode)


def w_of(inclusion: DifferentialInclusion) -> np.ndarray:
    scene = Scene(inclusion)
    return effective_mass(scene, scene.at(scene.start)).array


def test_the_effective_inverse_mass_of_the_sphere_is_three_and_a_half_along_the_floor():
    assert w_of(inclusions.rolling_sphere()).tolist() == [[1, 0, 0], [0, 3.5, 0], [0, 0, 3.5]]


def test_that_of_the_two_blocks_is_the_one_of_the_paper_with_its_masses():
    w = w_of(inclusions.two_blocks())
    assert w[3:5, 3:5].tolist() == [[2, 2], [2, 3]]
    assert w[5, 5] == 1
    assert w[:3, :3].tolist() == [[2, -2, 0], [-2, 3, 0], [0, 0, 1]]
    np.testing.assert_array_equal(w, w.T)


BY_HAND = {
    "bouncing_mass": inclusions.bouncing_mass,
    "rolling_sphere": inclusions.rolling_sphere,
    "two_blocks_conveyor": inclusions.two_blocks,
    "belt_oscillator": inclusions.belt_oscillator,
}


@pytest.mark.parametrize("name", BY_HAND)
def test_the_models_and_the_equations_by_hand_have_one_effective_mass(name):
    by_hand = BY_HAND[name]()
    np.testing.assert_allclose(w_of(nsode.load(BY_NAME[name]).inclusion), w_of(by_hand), rtol=1e-15)


def test_small_scenes_show_it_in_symbols():
    found = of_text(BY_NAME["rolling_sphere"].read_text())
    assert found.mass.formulas == (("1/M", "0", "0"), ("0", "7/(2*M)", "0"), ("0", "0", "7/(2*M)"))
    assert not found.mass.varies


TILTED = """model tilted
parameter M = 1
parameter J = 0.4
parameter b = 0.5
parameter h = 1
state y = 1.1
state phi = 0.1
state v = 0
state w = 0
force L = dio(y - b*sin(phi) - h*cos(phi))
force R = dio(y + b*sin(phi) - h*cos(phi))
der(y) = v
der(phi) = w
M*der(v) = L + R - M*9.81
J*der(w) = L*(h*sin(phi) - b*cos(phi)) + R*(h*sin(phi) + b*cos(phi))
approximate default dio: K = 1e6, beta = 2e-3, alpha = 1e-3
"""


def test_formulas_wider_than_a_terminal_stand_in_the_json_and_numbers_in_their_place():
    found = of_text(TILTED)
    lines = str(found).splitlines()
    assert max(map(len, lines)) <= 100
    lever = math.sin(0.1) - 0.5 * math.cos(0.1)
    [row] = (line.split() for line in lines if line.split()[:1] == ["L"] and len(line.split()) == 3)
    assert float(row[1]) == pytest.approx(1 / 1 + lever**2 / 0.4, rel=1e-3)
    assert "cos(phi)" in found.as_json()["effective_mass"]["formulas"][0][0]


def test_a_mass_matrix_makes_it_depend_on_the_state():
    found = of_text(BY_NAME["cart_pole"].read_text())
    assert found.mass.varies
    assert found.mass.asymmetric() == ()


def test_the_relative_degree_of_a_diode_is_one_and_of_a_contact_two():
    diode = of_text(BY_NAME["diode_circuit"].read_text())
    assert diode.mass.degrees == (1,)
    assert diode.contacts == ()
    assert diode.steps[0].step > 0
    assert of(inclusions.bouncing_mass()).mass.degrees == (2,)
    assert of(inclusions.sliding_mass()).mass.degrees == (1,)


FEEDS = """\
model feeds
parameter M = 1
state p = 0
state v = 1
force F = 0.5*sgn(v)
der(p) = v
M*der(v) = F
approximate F: K = 5e3, beta = 2e-3
simulate 1 {s} step 1e-4 {s}
"""


def test_friction_that_drives_is_named():
    model = nsode.loads(FEEDS)
    (warning,) = (d for d in warnings(model.inclusion) if d.code == "NS402")
    assert "`F`" in warning.message
    start, end = warning.labels[0].span
    assert "sgn(v)" in FEEDS[start:end]
    assert not of_text(FEEDS).passive
    assert not warnings(nsode.loads(FEEDS.replace("= F\n", "= -F\n")).inclusion)


def test_a_force_that_does_not_enter_through_the_jacobian_shows_in_w():
    text = BY_NAME["gripper"].read_text()
    assert of_text(text).mass.asymmetric() == ()
    other = FEEDS.replace("M*der(v) = F", "M*der(v) = -F + dio(p - 1)").replace(
        "approximate F:", "approximate dio1: K = 1e5, alpha = 1e-3, beta = 2e-3\napproximate F:"
    )
    found = of_text(other)
    assert found.mass.asymmetric() == ()
    skewed = other.replace("der(p) = v", "der(p) = 2*v")
    assert of_text(skewed).mass.asymmetric() == (("F", "dio1"),)
    assert not of_text(skewed).passive


def test_rk4_takes_7e_4_s_in_example_two_where_the_diagonal_would_allow_1_18e_3():
    found = {step.method: step for step in of(inclusions.two_blocks()).steps}["rk4"]
    assert found.step == pytest.approx(7.0e-4, rel=5e-3)
    assert dict(found.modes)["F1"] == dict(found.modes)["F2"] == "stick"
    stiffness, beta = 5e5, 2e-3
    w = stiffness * 3.0  # the largest diagonal entry of W
    slowest = (beta * w + np.sqrt((beta * w) ** 2 - 4 * w)) / 2
    assert radius(REGISTRY["rk4"], np.pi) / slowest == pytest.approx(1.18e-3, rel=5e-3)


def test_with_block_two_standing_the_eigenvalue_is_3965_per_second():
    scene = Scene(inclusions.two_blocks())
    place = reachable(scene, scene.at(scene.start, np.ones(6)))
    modes = place.modes(place.sets or ())
    standing = [
        values
        for values, active in zip(modes.values, modes.sets, strict=True)
        if [str(m) for m in active[:5]] == ["contact", "contact", "contact", "stick", "stick"]
    ]
    assert np.min(np.real(standing)) == pytest.approx(-3965, abs=0.5)


def test_stick_in_example_three_limits_rk4_to_5_6e_5_s():
    found = {step.method: step for step in of(inclusions.belt_oscillator()).steps}["rk4"]
    assert found.step == pytest.approx(5.6e-5, rel=1e-2)
    assert found.modes == (("F", "stick"),)
    assert found.damping == 1.0
    assert found.change == (("F.K", -1.0), ("F.beta", -1.0))


def test_the_own_modes_of_a_spring_leave_heun_and_euler_no_margin():
    found = of(inclusions.two_blocks())
    steps = {step.method: step for step in found.steps}
    assert abs(found.own_modes[0] - 1j * np.sqrt(100 / 0.5)) < 1e-6
    assert steps["heun"].own == steps["euler"].own == 0
    assert steps["rk4"].own == pytest.approx(2 * np.sqrt(2) / np.sqrt(200), rel=1e-6)
    assert steps["heun"].step > 0


def test_slip_alone_limits_by_beta():
    found = {step.method: step for step in of(inclusions.sliding_mass(stiffness=10.0)).steps}
    assert found["rk4"].step == pytest.approx(2.785 * 2e-3, rel=1e-3)
    assert found["heun"].step == pytest.approx(2 * 2e-3, rel=1e-9)


def test_the_radii_of_the_methods_are_the_known_ones():
    assert radius(REGISTRY["euler"], np.pi) == pytest.approx(2.0)
    assert radius(REGISTRY["heun"], np.pi) == pytest.approx(2.0)
    assert radius(REGISTRY["rk4"], np.pi) == pytest.approx(2.785293563405282)
    assert radius(REGISTRY["rk4"], np.pi / 2) == pytest.approx(2 * np.sqrt(2))
    assert radius(REGISTRY["euler"], np.pi / 2) == radius(REGISTRY["heun"], np.pi / 2) == 0
    assert 2.6 < half_disc(REGISTRY["rk4"]) < 2.79


class Implicit:
    """The implicit Euler method: a scheme without a tableau here."""

    name, title, order = "implicit", "implicit Euler", 1

    def stability(self, z: complex) -> complex:
        return 1 / (1 - z)


def test_a_method_that_is_a_stable_has_no_limit():
    scene = Scene(inclusions.two_blocks())
    place = reachable(scene, scene.at(scene.start, np.ones(6)))
    found = stable_steps([place], {"implicit": Implicit()})
    assert found["implicit"].step == np.inf


FLOOR_AND_CEILING = """\
model between
parameter L = 1
state z = 0.5
state v = 0
force A = dio(z)
force B = dio(L - z)
der(z) = v
der(v) = A - B - 9.8
approximate A, B: K = 1e5, alpha = 2e-3, beta = 4e-3
"""


def test_floor_and_ceiling_never_press_together():
    found = of_text(FLOOR_AND_CEILING)
    assert found.sets == 3
    pinched = of_text(FLOOR_AND_CEILING.replace("L = 1", "L = -1e-3"))
    assert pinched.sets == 4
    assert pinched.stable_step["rk4"] < found.stable_step["rk4"]


@pytest.mark.parametrize("seed", range(30))
def test_the_conflicts_are_the_smallest_sets_that_linear_programming_cannot_close(seed):
    rng = np.random.default_rng(seed)
    slope = rng.integers(-1, 2, size=(5, 2)).astype(float)
    gaps = rng.integers(-2, 4, size=5).astype(float)
    found = set(conflicts(slope, gaps))

    def closes(members: tuple[int, ...]) -> bool:
        rows = list(members)
        answer = linprog([0, 0], A_ub=slope[rows], b_ub=-gaps[rows], bounds=[(None, None)] * 2)
        return answer.status == 0

    wanted: set[frozenset[int]] = set()
    for size in range(1, 6):
        for members in itertools.combinations(range(5), size):
            smaller = any(bad <= set(members) for bad in wanted)
            if not smaller and not closes(members):
                wanted.add(frozenset(members))
    assert found == wanted


@pytest.mark.parametrize("seed", range(20))
def test_nonnegative_least_squares_is_that_of_scipy(seed):
    rng = np.random.default_rng(seed)
    a, b = rng.normal(size=(7, 4)), rng.normal(size=7)
    np.testing.assert_allclose(nonnegative_least_squares(a, b), nnls(a, b)[0], atol=1e-9)


def test_the_bound_holds_for_every_set_and_is_not_far():
    for inclusion in (inclusions.two_blocks(), inclusions.rolling_sphere()):
        scene = Scene(inclusion)
        local = scene.at(scene.start, np.ones(len(scene.at(scene.start).argument)))
        place = reachable(scene, local)
        largest = max(
            np.abs(np.linalg.eigvals(matrix(local, scene.elements, scene.constants, s))).max()
            for s in place.sets or ()
        )
        limit = bound(local, scene.elements, scene.constants)
        assert largest <= limit <= 3 * largest


def test_more_sets_than_can_be_listed_get_a_bound_that_is_proven():
    found = of_text(COLUMN.replace("constant n = 10", "constant n = 20"))
    assert found.sets is None
    rk4 = next(step for step in found.steps if step.method == "rk4")
    assert rk4.proven
    assert rk4.step <= rk4.found
    assert all(mode == "contact" for _, mode in rk4.modes)
    assert MOST_SETS < 2**20


def test_a_step_beyond_the_limit_is_announced_with_the_set_and_the_way_out():
    text = BY_NAME["two_blocks_conveyor"].read_text()
    assert not warnings(nsode.loads(text).inclusion)
    (warning,) = warnings(nsode.loads(text.replace("step 5e-4", "step 1e-3")).inclusion)
    assert warning.code == "NS407"
    assert "F2 stick" in warning.notes[0]
    assert "6.9e-04" in (warning.help or "") or "0.00069" in (warning.help or "")


@pytest.mark.parametrize(
    ("name", "change", "into"),
    [
        ("dry_friction", "beta = 2e-3", "beta = 3e-4"),  # 41 % off, and no NaN
        ("bouncing_mass", "K = 1e5", "K = 5e6"),  # throws a ball from 1 m to 12.7 m
    ],
)
def test_what_ends_finite_and_wrong_is_announced(name, change, into):
    text = BY_NAME[name].read_text()
    assert change in text
    assert "step 1e-3" in text
    assert not warnings(nsode.loads(text).inclusion)
    assert {d.code for d in warnings(nsode.loads(text.replace(change, into)).inclusion)} == {
        "NS407"
    }


@pytest.mark.parametrize("method", ["euler", "heun"])
def test_a_method_that_feeds_an_elastic_contact_can_take_no_step(method):
    text = BY_NAME["bouncing_mass"].read_text().replace("alpha = 5e-3", "alpha = 1e-2")
    [found] = warnings(nsode.loads(text.replace("rk4", method)).inclusion)
    assert (found.code, found.severity) == ("NS407", "warning")
    assert f"{method} can take no step" in found.message
    assert "such as rk4" in found.help


def test_lightly_damped_stick_is_announced_with_its_frequency():
    found = of(inclusions.sliding_mass())
    (friction,) = found.frictions
    assert friction.frequency == pytest.approx(70.7, abs=0.02)
    assert friction.damping == pytest.approx(0.07, abs=1e-3)
    assert friction.presliding == pytest.approx(0.5 / 5e3)
    assert [d.code for d in found.diagnostics] == ["NS408"]


def test_what_nothing_reads_and_what_coincides_is_told():
    sphere = of_text(BY_NAME["rolling_sphere"].read_text())
    assert set(sphere.unread) == {"q[1]", "q[2]", "q[3]", "q[4]"}
    assert of_text(BY_NAME["gripper"].read_text()).coinciding == (("FL", "FR"),)


def test_states_along_a_run_are_looked_at_too():
    model = nsode.load(BY_NAME["cart_pole"])
    alone = analyze(model.inclusion, model.ode)
    x = np.zeros(4)
    x[1] = np.pi / 2
    along = analyze(model.inclusion, model.ode, along=[x])
    assert along.stable_step["rk4"] <= alone.stable_step["rk4"]


def test_a_contact_that_stays_open_along_a_run_is_idle():
    model = nsode.loads(FLOOR_AND_CEILING)
    found = analyze(model.inclusion, model.ode, along=[[0.5, 0.0], [-1e-4, 0.0]])
    assert found.idle == ("B",)


def test_a_model_without_constants_has_a_mass_and_no_steps():
    text = "\n".join(
        line for line in FLOOR_AND_CEILING.splitlines() if not line.startswith("approximate")
    )
    found = of_text(text + "\n")
    assert found.steps == ()
    assert found.mass.matrix == ((1.0, -1.0), (-1.0, 1.0))


@pytest.mark.parametrize(
    "law",
    ["der(v) = -F/v", "der(v) = -F + log(v - 1)", "v*v*der(v) = -F"],
)
def test_a_start_without_finite_rates_is_refused_by_the_analysis_and_no_warning(law):
    text = f"model m\nstate v = 0\nforce F = sgn(v)\n{law}\napproximate F: K = 1e3, beta = 1e-2\n"
    model = nsode.loads(text)
    assert warnings(model.inclusion) == ()
    with pytest.raises(ModelError, match="not finite at the start"):
        model.analyze()


def test_a_scene_too_large_is_refused_before_minutes_pass():
    model = nsode.loads(COLUMN.replace("constant n = 10", "constant n = 5000"))
    assert warnings(model.inclusion) == ()
    with pytest.raises(ModelError, match="too many to analyze"):
        model.analyze()


def test_an_element_with_another_law_has_no_step_that_is_known():
    inclusion = inclusions.sliding_mass()
    (term,) = inclusion.terms
    other = replace(term, approximation=replace(term.approximation, law="lugre"))
    found = analyze(replace(inclusion, bindings=(other,)), rewrite(inclusion))
    assert found.steps == ()
    assert found.frictions == ()
    assert found.mass.matrix == ((1.0,),)


def test_a_model_without_set_valued_terms_has_nothing_to_limit():
    found = of_text("model free\nstate x = 1\nder(x) = -x\n")
    assert found.steps == ()
    assert found.mass.names == ()


def test_changed_parameters_are_those_that_are_analyzed():
    model = nsode.load(BY_NAME["belt_oscillator"]).with_parameters({"Fc.K": 1e3, "M": 2.0})
    found = model.analyze()
    assert found.mass.matrix == ((0.5,),)
    assert found.frictions[0].frequency == pytest.approx(np.sqrt(1e3 / 2))


@pytest.mark.parametrize("path", MODELS, ids=lambda path: path.stem)
def test_every_model_has_a_report_in_text_html_and_json(path):
    found = nsode.load(path).analyze()
    plain = json.loads(json.dumps(found.as_json(), allow_nan=False))
    assert plain["schema_version"] == 1
    assert plain["stable_step"] == found.stable_step
    bundle = found._repr_mimebundle_()
    assert str(found).startswith(found.name)
    assert bundle["text/html"].count("<table>") == len(found.tables())
    assert max(map(len, str(found).splitlines())) < 160


def test_the_command_prints_the_table_or_json():
    from nsode.cli.analyze import command

    model = str(BY_NAME["bouncing_mass"])
    shown = CliRunner().invoke(command, [model], standalone_mode=False)
    assert "rk4" in shown.stdout
    plain = CliRunner().invoke(command, [model, "--format", "json"], standalone_mode=False)
    assert json.loads(plain.stdout)["stable_step"]["rk4"] == pytest.approx(0.0067777, rel=1e-4)


@pytest.mark.parametrize(
    ("change", "into", "why"),
    [
        ("approximate", "# approximate", "no constants"),
        ("K = 1e5", "K = 1e70", "no number that is of use"),
    ],
)
def test_where_there_are_no_steps_the_reason_stands_in_their_place(change, into, why):
    text = BY_NAME["bouncing_mass"].read_text()
    assert change in text
    found = nsode.loads(text.replace(change, into)).analyze()
    assert found.steps == ()
    assert why in found.unknown
    assert f"not known: {found.unknown}" in str(found)
    assert found.as_json()["unknown"] == found.unknown


def test_constants_too_far_apart_for_their_numbers_leave_no_warning_of_the_machine():
    text = BY_NAME["bouncing_mass"].read_text().replace("K = 1e5", "K = 1e59")
    [contact] = nsode.loads(text).analyze().contacts
    assert np.isnan(contact.mapped_restitution) or 0 <= contact.mapped_restitution <= 1


def test_huge_loads_leave_no_warning_of_the_machine():
    text = """model heavy
state p = 0
state v = 0
force N = dio(1e100*p)
der(p) = v
der(v) = 1e100*N - 1e200
approximate N: K = 1, alpha = 0.1, beta = 0.2
"""
    np.testing.assert_allclose(nsode.loads(text).analyze().mass.array, [[1e200]])


@pytest.mark.parametrize("method", ["rk4", "verlet"])
@pytest.mark.parametrize("mass", ["1e-300", "1e-200", "1e150", "1e300"])
@pytest.mark.parametrize("stiffness", ["1e-300", "1e5", "1e59"])
@pytest.mark.parametrize("beta", ["1e-300", "4e-3", "1e59"])
def test_no_size_of_the_numbers_breaks_it(mass, stiffness, beta, method):
    text = BY_NAME["frictional_contact"].read_text()
    changes = {"M  = 1 ": mass, "K = 1e5": stiffness, "alpha = 2.8e-3": beta, "beta = 4e-3": beta}
    for old, value in changes.items():
        text = text.replace(old, f"{old.split('=')[0]}= {value} ")
    model = nsode.loads(text.replace("method rk4", f"method {method}"))
    with suppress(ModelError):  # NS406, where the rates have no number of use
        assert "effective inverse mass" in str(model.analyze())


def test_a_run_tells_where_else_the_step_was_looked_at(tmp_path):
    from nsode.cli.analyze import command

    text = """model crank
state th = 0
state w = 1
force N = dio(1.2 - th^2)
der(th) = w
der(w) = -2*th*N
approximate N: K = 1e6, alpha = 2.8e-3, beta = 4e-3
simulate 0.5 step 1e-4
"""
    model = nsode.loads(text)
    assert "at the start" in str(model.analyze())
    (tmp_path / "crank.di").write_text(text)
    model.simulate(every=100).save(tmp_path / "run.npz")
    args = [str(tmp_path / "crank.di"), "--format", "json"]
    shown = CliRunner().invoke(command, args, standalone_mode=False)
    along = [*args, "--along", str(tmp_path / "run.npz")]
    looked = CliRunner().invoke(command, along, standalone_mode=False)
    here, there = json.loads(shown.stdout), json.loads(looked.stdout)
    assert here["at"] == "the start"
    assert there["at"] == "the start and 51 states"
    assert there["stable_step"]["rk4"] < here["stable_step"]["rk4"]


def test_a_limit_that_there_is_not_has_no_unit() -> None:
    text = """model falling
state z = 1
state v = 0
der(z) = v
der(v) = 2*z - sgn(v)
approximate default sgn: K = 1e5, beta = 4e-3
"""
    rows = str(nsode.loads(text).analyze()).splitlines()
    [own] = [row.split()[-1] for row in rows if row.split()[:1] == ["verlet"]]
    assert own == "none"  # z grows by itself, and no step can change that
